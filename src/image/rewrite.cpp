#include "image/rewrite.h"

#include <cassert>
#include <cstring>

#include "image/input.h"
#include "image/output_file.h"
#include "image/parts.h"
#include "image/write.h"

namespace weft::image {

namespace {

/// Returns the pixels of a part as the file has them, each channel of its own type.
std::vector<std::byte> stored_pixels(OIIO::ImageInput& input, int part, OIIO::ImageSpec const& spec,
                                     std::string const& path) {
    std::vector<std::byte> pixels(size_t(spec.image_bytes(true)));
    check_read(input, path,
               input.read_image(part, 0, 0, spec.nchannels, OIIO::TypeUnknown, pixels.data()));
    return pixels;
}

/// Puts channels of the image, from `first` on, in the place of those that are floats or halves.
void put_floats(Image const& image, size_t first, OIIO::ImageSpec const& spec,
                std::vector<std::byte>& pixels) {
    size_t const stride = spec.pixel_bytes(true);
    size_t offset = 0;
    for (int c = 0; c < spec.nchannels; ++c) {
        OIIO::TypeDesc const type = spec.channelformat(c);
        bool const fits = type == OIIO::TypeFloat || type == OIIO::TypeHalf;
        for (size_t i = 0; fits && i < pixels.size() / stride; ++i)
            OIIO::convert_pixel_values(
                OIIO::TypeFloat, &image.pixels[i * size_t(image.channels) + first + size_t(c)],
                type, &pixels[i * stride + offset]);
        offset += type.size();
    }
}

} // namespace

void rewrite_exr(std::string const& path, std::string const& original, Image const& image,
                 Metadata const& more) {
    if (!is_exr(path)) throw InputError({path}, "expected the extension '.exr'");
    auto const input = open_image(original);
    if (std::string_view(input->format_name()) != "openexr")
        throw InputError({original}, "expected an EXR file, found another format");
    FileParts const parts = parts_of(*input);
    std::vector<OIIO::ImageSpec> specs = parts.specs;
    for (size_t i = 0; i < specs.size(); ++i) {
        if (specs[i].deep)
            throw InputError({original},
                             "expected flat parts, found '" + parts.names[i] + "', which is deep");
        if (image.is_converted && parts.joins(i)) specs[i].erase_attribute("chromaticities");
    }
    for (auto const& [name, value] : more) specs[0].attribute(name, value);
    int const count = int(specs.size());
    write_file(
        path, "",
        [&](OIIO::ImageOutput& output, std::string const& name) {
            bool written =
                count == 1 ? output.open(name, specs[0]) : output.open(name, count, specs.data());
            size_t first = 0;
            for (int i = 0; written && i < count; ++i) {
                OIIO::ImageSpec const& spec = parts.specs[size_t(i)];
                std::vector<std::byte> pixels = stored_pixels(*input, i, spec, original);
                if (parts.joins(size_t(i))) {
                    put_floats(image, first, spec, pixels);
                    first += size_t(spec.nchannels);
                }
                if (i > 0)
                    written =
                        output.open(name, specs[size_t(i)], OIIO::ImageOutput::AppendSubimage);
                written = written && output.write_image(OIIO::TypeUnknown, pixels.data());
            }
            assert(!written || first == size_t(image.channels));
            return written;
        },
        count > 1);
}

} // namespace weft::image
