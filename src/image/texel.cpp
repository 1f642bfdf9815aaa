#include "image/texel.h"

#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <array>
#include <vector>

namespace weft::image {

namespace {

/// OpenImageIO's own conversion of integers to floats, then the curve, in steps of 1 / 65535: the
/// numbers that an image read as floats and decoded would have.
template <class Code, size_t codes>
std::vector<float> make_table(OIIO::TypeDesc type, Transfer transfer) {
    std::vector<Code> all(codes);
    for (size_t i = 0; i < codes; ++i) all[i] = Code(i);
    std::vector<float> table(codes);
    OIIO::convert_types(type, all.data(), OIIO::TypeDesc::FLOAT, table.data(), int(codes));
    if (transfer == Transfer::linear) return table;
    for (float& v : table) {
        float const step = float(size_t(std::clamp(v, 0.f, 1.f) * 65535 + 0.5f)) / 65535;
        v = decoded(transfer, step);
    }
    return table;
}

template <class Code, size_t codes>
std::span<float const> shared_table(OIIO::TypeDesc type, Transfer transfer) {
    static std::array<std::vector<float>, 3> const tables{
        make_table<Code, codes>(type, Transfer::linear),
        make_table<Code, codes>(type, Transfer::gamma22),
        make_table<Code, codes>(type, Transfer::srgb)};
    return tables[size_t(transfer)];
}

} // namespace

std::span<float const> decode_table(TexelFormat format) {
    switch (format.type) {
    case TexelType::u8:
        return shared_table<uint8_t, 256>(OIIO::TypeDesc::UINT8, format.transfer);
    case TexelType::u16:
        return shared_table<uint16_t, 65536>(OIIO::TypeDesc::UINT16, format.transfer);
    default:
        return {};
    }
}

} // namespace weft::image
