#include "image/hdr_file.h"

#include <cerrno>
#include <cmath>
#include <cstring>
#include <string_view>

#include "base/error.h"

namespace weft::image {

namespace {

constexpr int kMostPixels = 1 << 20; ///< along an axis
constexpr int kMostHeaderLines = 10000, kMostLineLength = 1 << 16;

/// Reads numbers behind "NAME=", with as many as there is room for. Returns whether all are there.
template <size_t n>
bool read_numbers(std::string const& line, std::array<float, n>& to) {
    char const* at = line.c_str() + line.find('=') + 1;
    for (float& x : to) {
        char* end = nullptr;
        x = std::strtof(at, &end);
        if (end == at || !std::isfinite(x)) return false;
        at = end;
    }
    return true;
}

} // namespace

bool HdrFile::has_signature(std::string const& path) {
    std::unique_ptr<std::FILE, int (*)(std::FILE*)> const file(std::fopen(path.c_str(), "rb"),
                                                               &std::fclose);
    char start[2] = {};
    return file && std::fread(start, 1, 2, file.get()) == 2 && start[0] == '#' && start[1] == '?';
}

HdrFile::HdrFile(std::string const& path)
    : path_(path), file_(std::fopen(path.c_str(), "rb"), &std::fclose) {
    if (!file_)
        throw InputError({path}, std::string("cannot open the image: ") + std::strerror(errno));
    read_header();
}

void HdrFile::fail(std::string const& what) const { throw InputError({path_}, what); }

std::string HdrFile::header_line() {
    std::string line;
    for (int c; (c = std::fgetc(file_.get())) != '\n';) {
        if (c == EOF || int(line.size()) == kMostLineLength)
            fail("truncated: expected a Radiance picture, found no end of its header");
        line.push_back(char(c));
    }
    if (!line.empty() && line.back() == '\r') line.pop_back();
    return line;
}

void HdrFile::read_header() {
    if (!header_line().starts_with("#?")) fail("expected a Radiance picture, found none");
    int count = 0;
    // Older files name no format.
    for (std::string line; !(line = header_line()).empty();) {
        if (++count > kMostHeaderLines) fail("expected the end of a Radiance picture's header");
        std::array<float, 3> color;
        std::array<float, 1> exposure;
        std::array<float, 8> primaries;
        if (line.starts_with("FORMAT=")) {
            std::string_view const format = std::string_view(line).substr(7);
            is_xyz_ = format.starts_with("32-bit_rle_xyze");
            bool const known = is_xyz_ || format.starts_with("32-bit_rle_rgbe");
            if (!known)
                fail("expected the FORMAT 32-bit_rle_rgbe or 32-bit_rle_xyze, found '" +
                     std::string(format) + "'");
        } else if (line.starts_with("EXPOSURE=") && read_numbers(line, exposure)) {
            if (exposure[0] > 0)
                for (float& m : multiplied_) m *= exposure[0];
        } else if (line.starts_with("COLORCORR=") && read_numbers(line, color)) {
            for (size_t i = 0; i < 3; ++i)
                if (color[i] > 0) multiplied_[i] *= color[i];
        } else if (line.starts_with("PRIMARIES=") && read_numbers(line, primaries)) {
            primaries_ = primaries;
        }
    }
    read_resolution(header_line());
}

/// For example "-Y 480 +X 640": 480 lines from the top, each of 640 pixels from the left.
void HdrFile::read_resolution(std::string const& line) {
    char sign[2], axis[2];
    int size[2];
    int const found = std::sscanf(line.c_str(), " %c%c %d %c%c %d", &sign[0], &axis[0], &size[0],
                                  &sign[1], &axis[1], &size[1]);
    auto const known = [&](int i) {
        return (sign[i] == '+' || sign[i] == '-') && (axis[i] == 'X' || axis[i] == 'Y') &&
               size[i] > 0 && size[i] <= kMostPixels;
    };
    if (found != 6 || !known(0) || !known(1) || axis[0] == axis[1])
        fail("expected a resolution as '-Y 480 +X 640', found '" + line + "'");
    lines_ = size[0];
    columns_ = size[1];
    // A line takes at least four bytes.
    long const here = std::ftell(file_.get());
    std::fseek(file_.get(), 0, SEEK_END);
    long const rest = std::ftell(file_.get()) - here;
    std::fseek(file_.get(), here, SEEK_SET);
    if (rest < 4l * lines_)
        fail("truncated: expected " + std::to_string(lines_) + " scan lines, found " +
             std::to_string(rest) + " bytes");
    if (int64_t(lines_) * columns_ > (int64_t(1) << 32) / 3)
        fail("expected at most 16 GiB of floats, found " + std::to_string(columns_) + " x " +
             std::to_string(lines_) + " pixels");
    bool const by_rows = axis[0] == 'Y';
    bool const up = (by_rows ? sign[0] : sign[1]) == '+',
               left = (by_rows ? sign[1] : sign[0]) == '-';
    if (by_rows)
        orientation_ = up ? (left ? 3 : 4) : (left ? 2 : 1);
    else
        orientation_ = up ? (left ? 7 : 8) : (left ? 6 : 5);
    pixels_.resize(size_t(columns_));
}

uint8_t HdrFile::byte() {
    int const c = std::fgetc(file_.get());
    if (c == EOF)
        fail("truncated: expected " + std::to_string(lines_) + " scan lines, found " +
             std::to_string(next_line_));
    return uint8_t(c);
}

/// Each component by itself: a length over 128 repeats a byte, others count bytes that follow.
void HdrFile::read_new_runs() {
    for (size_t k = 0; k < 4; ++k)
        for (int x = 0; x < columns_;) {
            int const code = byte();
            int const length = code > 128 ? code - 128 : code;
            if (length == 0 || x + length > columns_)
                fail("found a damaged run in scan line " + std::to_string(next_line_));
            uint8_t const value = byte();
            for (int i = 0; i < length; ++i, ++x)
                pixels_[size_t(x)][k] = code > 128 || i == 0 ? value : byte();
        }
}

/// Pixels, of which (1, 1, 1, n) repeats the one before n times, and following ones n << 8 times.
void HdrFile::read_old_runs(std::array<uint8_t, 4> const& first) {
    std::array<uint8_t, 4> pixel = first;
    int shift = 0;
    for (int x = 0;;) {
        if (pixel[0] == 1 && pixel[1] == 1 && pixel[2] == 1) {
            int const length = shift < 24 ? pixel[3] << shift : columns_ + 1;
            if (x == 0 || x + length > columns_)
                fail("found a damaged run in scan line " + std::to_string(next_line_));
            for (int i = 0; i < length; ++i, ++x) pixels_[size_t(x)] = pixels_[size_t(x) - 1];
            shift += 8;
        } else {
            pixels_[size_t(x++)] = pixel;
            shift = 0;
        }
        if (x == columns_) return;
        for (uint8_t& component : pixel) component = byte();
    }
}

void HdrFile::read_line(float* to) {
    std::array<uint8_t, 4> first;
    for (uint8_t& component : first) component = byte();
    bool const new_runs = first[0] == 2 && first[1] == 2 && first[2] < 128;
    if (new_runs && (first[2] << 8 | first[3]) == columns_)
        read_new_runs();
    else
        read_old_runs(first);
    ++next_line_;
    for (auto const& [r, g, b, e] : pixels_) {
        float const scale = e > 0 ? std::ldexp(1.f, int(e) - 136) : 0;
        *to++ = float(r) * scale;
        *to++ = float(g) * scale;
        *to++ = float(b) * scale;
    }
}

} // namespace weft::image
