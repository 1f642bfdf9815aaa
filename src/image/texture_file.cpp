#include "image/texture_file.h"

#include <OpenImageIO/parallel.h>

#include <algorithm>
#include <vector>

#include "image/mip_levels.h"
#include "image/output_file.h"
#include "image/shown_picture.h"

namespace weft::image {

namespace {

constexpr int kTile = 64; ///< texels

OIIO::ImageSpec tile_spec(TexelFormat format, int width, int height) {
    OIIO::ImageSpec spec(width, height, format.channels, oiio_type(format.type));
    spec.tile_width = spec.tile_height = kTile;
    spec.tile_depth = 1;
    spec.attribute("compression", "zip");
    spec.attribute("textureformat", "Plain Texture");
    spec.attribute("DateTime", "1970:01:01 00:00:00"); // equal input, equal bytes
    return spec;
}

/// Rows of an image, read as they are asked for, strip by strip.
class RowSource {
  public:
    RowSource(std::string const& path, Encoding encoding)
        : file_(path, encoding), row_bytes_(size_t(file_.width()) * file_.format().bytes()) {}

    int width() const { return file_.width(); }
    int height() const { return file_.height(); }
    TexelFormat format() const { return file_.format(); }
    size_t row_bytes() const { return row_bytes_; }

    /// Reads all rows up to `end`, and forgets those before `keep`.
    void read_to(int end, int keep) {
        rows_.erase(rows_.begin(), rows_.begin() + ptrdiff_t(size_t(keep - first_) * row_bytes_));
        first_ = keep;
        while (end_ < end) {
            int const strip = std::min(file_.strip(), height() - end_);
            size_t const old = rows_.size();
            rows_.resize(old + size_t(strip) * row_bytes_);
            file_.read_to(end_ + strip, &rows_[old]);
            end_ += strip;
        }
    }
    std::byte const* row(int y) const { return rows_.data() + size_t(y - first_) * row_bytes_; }

  private:
    ShownPicture file_;
    size_t row_bytes_;
    std::vector<std::byte> rows_; ///< [first_, end_)
    int first_ = 0, end_ = 0;
};

struct Level {
    int width, height;
    std::vector<std::byte> texels;
};

/// Rows [from, to) of the smaller level.
template <class Row>
void reduce_rows(LevelReducer const& reducer, TexelFormat format, int from, int to, Row const& row,
                 Level& smaller) {
    size_t const bytes = size_t(smaller.width) * format.bytes();
    OIIO::parallel_for(int64_t(from), int64_t(to), [&](int64_t y) {
        reducer.reduce_row(int(y), row, &smaller.texels[size_t(y) * bytes]);
    });
}

Level make_level(LevelReducer const& reducer, TexelFormat format) {
    int const w = reducer.width(), h = reducer.height();
    return {w, h, std::vector<std::byte>(size_t(w) * size_t(h) * format.bytes())};
}

/// Writes level 0 strip by strip; the level after it is made on the way.
bool write_first(RowSource& source, OIIO::ImageOutput& output, Level& smaller,
                 ConversionProgress const& progress) {
    int const width = source.width(), height = source.height();
    TexelFormat const format = source.format();
    LevelReducer const reducer(format, width, height);
    smaller = make_level(reducer, format);
    int reduced = 0;
    for (int y = 0; y < height; y += kTile) {
        int const end = std::min(y + kTile, height);
        int const needed = std::min(y, reduced < smaller.height ? reducer.first_row(reduced) : y);
        source.read_to(end, needed);
        if (!output.write_tiles(0, width, y, end, 0, 1, oiio_type(format.type), source.row(y)))
            return false;
        int to = reduced;
        while (to < smaller.height && reducer.end_row(to) <= end) ++to;
        reduce_rows(
            reducer, format, reduced, to, [&](int r) { return source.row(r); }, smaller);
        reduced = to;
        if (progress) progress(0.75 * end / height);
    }
    return true;
}

bool write_level(OIIO::ImageOutput& output, std::string const& name, TexelFormat format,
                 Level const& level) {
    return output.open(
               name, tile_spec(format, level.width, level.height),
               // OpenImageIO takes the parts of a TIFF that says it is a texture for levels.
               output.supports("mipmap") ? OIIO::ImageOutput::AppendMIPLevel
                                         : OIIO::ImageOutput::AppendSubimage) &&
           output.write_tiles(0, level.width, 0, level.height, 0, 1, oiio_type(format.type),
                              level.texels.data());
}

} // namespace

void make_texture_file(std::string const& from, std::string const& to, Encoding encoding,
                       ConversionProgress const& progress) {
    RowSource source(from, encoding);
    TexelFormat const format = source.format();
    bool const integers = format.type == TexelType::u8 || format.type == TexelType::u16;
    int const width = source.width(), height = source.height();
    write_file(
        to, integers ? "tiff" : "openexr",
        [&](OIIO::ImageOutput& output, std::string const& name) {
            Level level;
            if (!output.open(name, tile_spec(format, width, height)) ||
                !write_first(source, output, level, progress))
                return false;
            for (int i = level_count(width, height) - 1; i > 0; --i) {
                if (!write_level(output, name, format, level)) return false;
                if (i == 1) break;
                LevelReducer const reducer(format, level.width, level.height);
                Level smaller = make_level(reducer, format);
                size_t const row = size_t(level.width) * format.bytes();
                reduce_rows(
                    reducer, format, 0, smaller.height,
                    [&](int y) { return &level.texels[size_t(y) * row]; }, smaller);
                level = std::move(smaller);
            }
            if (progress) progress(1);
            return true;
        },
        true);
}

} // namespace weft::image
