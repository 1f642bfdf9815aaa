#include "image/shown_picture.h"

#include <algorithm>
#include <cstring>

#include "base/error.h"

namespace weft::image {

namespace {

constexpr int kStrip = 64;                   ///< rows
constexpr uint64_t kMostTexels = 1ull << 31; ///< of a picture that has to be put together

} // namespace

std::string png_head(ImageSource const& source) {
    std::string head;
    if (source.bytes) {
        head = source.bytes->substr(0, size_t(1) << 22);
    } else {
        OIIO::Filesystem::IOFile file(source.path, OIIO::Filesystem::IOProxy::Read);
        head.resize(8);
        if (file.pread(head.data(), 8, 0) != 8 || head != "\x89PNG\r\n\x1a\n") return "";
        head.resize(std::min(file.size(), size_t(1) << 22));
        head.resize(file.pread(head.data(), head.size(), 0));
    }
    return head.starts_with("\x89PNG\r\n\x1a\n") ? head : "";
}

Vec2i stored_place(int orientation, int x, int y, int width, int height) {
    switch (orientation) {
    case 2:
        return {width - 1 - x, y};
    case 3:
        return {width - 1 - x, height - 1 - y};
    case 4:
        return {x, height - 1 - y};
    case 5:
        return {y, x};
    case 6:
        return {y, height - 1 - x};
    case 7:
        return {width - 1 - y, height - 1 - x};
    case 8:
        return {width - 1 - y, x};
    default:
        return {x, y};
    }
}

ShownPicture::ShownPicture(ImageSource const& source, Encoding encoding, Channels channels) {
    LayerPath const path = source.bytes ? LayerPath{source.path, ""} : split_layer(source.path);
    path_ = path.file;
    open(source);
    if (input_) choose_channels(path.layer, channels);
    if (has_channels_ && channels == Channels::alpha) has_channels_ = input_ != nullptr;
    if (has_channels_) take_words(source, encoding, channels);
}
ShownPicture::~ShownPicture() = default;

void ShownPicture::open(ImageSource const& source) {
    if (source.bytes) {
        memory_ = std::make_unique<OIIO::Filesystem::IOMemReader>(source.bytes->data(),
                                                                  source.bytes->size());
        input_ = open_flat_image(*memory_, source.path);
    } else if (HdrFile::has_signature(path_)) {
        hdr_ = std::make_unique<HdrFile>(path_);
    } else {
        input_ = open_image(path_);
    }
}

void ShownPicture::choose_channels(std::string const& layer, Channels channels) {
    FileParts const parts = parts_of(*input_);
    channels_ = find_channels(parts, layer, path_);
    input_->seek_subimage(channels_.part, 0);
    check_flat(input_->spec(), path_);
    if (channels == Channels::color) return;
    // The alpha of the same layer, or of the picture.
    auto const& names = parts.channels[size_t(channels_.part)];
    auto const alpha = std::find(names.begin(), names.end(), layer + ".A");
    channels_.first =
        alpha != names.end() ? int(alpha - names.begin()) : input_->spec().alpha_channel;
    channels_.count = 1;
    has_channels_ = channels_.first >= 0;
}

void ShownPicture::take_words(ImageSource const& source, Encoding encoding, Channels channels) {
    ColorWords words;
    if (hdr_) {
        stored_width_ = hdr_->columns();
        stored_height_ = hdr_->lines();
        stored_ = {TexelType::f32, 3, Transfer::linear};
        placement_ = {stored_width_, stored_height_, 0, 0, hdr_->orientation()};
        words = color_words(hdr_->multiplied(),
                            hdr_->is_xyz() ? std::optional(kXyzPrimaries) : hdr_->primaries(),
                            encoding);
        if (placement_.orientation > 4) std::swap(placement_.width, placement_.height);
    } else {
        OIIO::ImageSpec const& spec = input_->spec();
        stored_width_ = spec.width;
        stored_height_ = spec.height;
        if (channels == Channels::alpha) {
            stored_ = texel_format(spec, Transfer::linear, channels);
        } else {
            words = color_words(spec, png_head(source), encoding);
            stored_ = texel_format(spec, words.transfer, channels);
            stored_.transfer = words.transfer;
        }
        stored_.channels = channels_.count;
        place(spec);
    }
    warnings_ = std::move(words.warnings);
    convert_ = std::move(words.convert);
    format_ = convert_ ? TexelFormat{TexelType::f32, 3, Transfer::linear} : stored_;
    as_stored_ = !convert_ && channels_.part == 0 && placement_.orientation == 1 &&
                 placement_.x == 0 && placement_.y == 0 && placement_.width == stored_width_ &&
                 placement_.height == stored_height_;
    if (!as_stored_ && uint64_t(placement_.width) * uint64_t(placement_.height) > kMostTexels)
        throw InputError({path_}, "expected a window of at most 2^31 pixels to be shown, found " +
                                      std::to_string(placement_.width) + " x " +
                                      std::to_string(placement_.height));
}

/// Shows what lies in the display window, and turns it.
void ShownPicture::place(OIIO::ImageSpec const& spec) {
    if (spec.get_string_attribute("textureformat") == "CubeFace Environment")
        throw InputError({path_}, "expected a picture or a map by longitude and latitude, found a "
                                  "cube map");
    bool const windows = spec.full_width > 0 && spec.full_height > 0;
    placement_ = windows ? Placement{spec.full_width, spec.full_height, spec.x - spec.full_x,
                                     spec.y - spec.full_y}
                         : Placement{spec.width, spec.height};
    int const orientation = spec.get_int_attribute("Orientation", 1);
    placement_.orientation = orientation >= 1 && orientation <= 8 ? orientation : 1;
    if (placement_.orientation > 4) std::swap(placement_.width, placement_.height);
}

bool ShownPicture::is_in_tiles() const {
    if (!input_ || channels_.part > 0 || channels_.first > 0) return false;
    OIIO::ImageSpec const& spec = input_->spec();
    return channels_.count == (spec.nchannels >= 3 ? 3 : 1) && spec.tile_width > 0 &&
           input_->spec_dimensions(0, 1).width > 0;
}

int ShownPicture::strip() const {
    return as_stored_ && input_ && input_->spec().tile_height > 0 ? input_->spec().tile_height
                                                                  : kStrip;
}

void ShownPicture::check_end() {
    if (!input_) return;
    if (memory_)
        image::check_end(*input_, *memory_, path_);
    else
        image::check_end(*input_, path_);
}

/// Rows as the file has them, of the channels that are wanted.
void ShownPicture::read_stored(OIIO::TypeDesc type, int begin, int end, void* to) {
    OIIO::ImageSpec const& spec = input_->spec();
    auto const [part, first, count] = channels_;
    int const y = spec.y + begin, last = first + count;
    bool const read =
        spec.tile_width > 0
            ? input_->read_tiles(part, 0, spec.x, spec.x + spec.width, y, spec.y + end, spec.z,
                                 spec.z + 1, first, last, type, to)
            : input_->read_scanlines(part, 0, y, spec.y + end, spec.z, first, last, type, to);
    check_read(*input_, path_, read);
    if (end == stored_height_) check_end();
}

std::vector<std::byte> ShownPicture::stored_texels() {
    size_t const row = size_t(stored_width_) * stored_.bytes();
    std::vector<std::byte> texels(row * size_t(stored_height_));
    if (hdr_)
        for (int y = 0; y < stored_height_; ++y)
            hdr_->read_line(reinterpret_cast<float*>(&texels[row * size_t(y)]));
    else
        read_stored(oiio_type(stored_.type), 0, stored_height_, texels.data());
    return texels;
}

/// The stored pixels, converted: three floats for each.
std::vector<float> ShownPicture::stored_floats() {
    std::vector<std::byte> const texels = stored_texels();
    size_t const count = size_t(stored_width_) * size_t(stored_height_);
    float const* const table = decode_table(stored_).data();
    std::vector<float> rgb(3 * count);
    match_format(stored_, [&]<TexelType type, int channels>() {
        for (size_t i = 0; i < count; ++i) {
            auto const v = load_texel<type, channels>(&texels[i * stored_.bytes()], table);
            for (size_t k = 0; k < 3; ++k) {
                if constexpr (channels == 1)
                    rgb[3 * i + k] = v;
                else
                    rgb[3 * i + k] = v[int(k)];
            }
        }
    });
    convert_(rgb);
    return rgb;
}

void ShownPicture::make_picture() {
    std::vector<std::byte> stored;
    if (convert_) {
        std::vector<float> const rgb = stored_floats();
        stored.resize(rgb.size() * sizeof(float));
        std::memcpy(stored.data(), rgb.data(), stored.size());
    } else {
        stored = stored_texels();
    }
    size_t const bytes = format_.bytes();
    bool const turned = placement_.orientation > 4;
    int const window_width = turned ? placement_.height : placement_.width,
              window_height = turned ? placement_.width : placement_.height;
    picture_.assign(size_t(placement_.width) * size_t(placement_.height) * bytes, std::byte(0));
    for (int y = 0; y < placement_.height; ++y)
        for (int x = 0; x < placement_.width; ++x) {
            Vec2i const p = stored_place(placement_.orientation, x, y, window_width, window_height);
            int const sx = p.x - placement_.x, sy = p.y - placement_.y;
            if (sx < 0 || sy < 0 || sx >= stored_width_ || sy >= stored_height_) continue;
            std::memcpy(&picture_[(size_t(y) * size_t(placement_.width) + size_t(x)) * bytes],
                        &stored[(size_t(sy) * size_t(stored_width_) + size_t(sx)) * bytes], bytes);
        }
}

void ShownPicture::read_to(int end, std::byte* to) {
    size_t const row = size_t(width()) * format_.bytes();
    if (!as_stored_) {
        if (picture_.empty()) make_picture();
        std::memcpy(to, &picture_[size_t(next_row_) * row], size_t(end - next_row_) * row);
    } else if (hdr_) {
        for (int y = next_row_; y < end; ++y, to += row)
            hdr_->read_line(reinterpret_cast<float*>(to));
    } else {
        read_stored(oiio_type(format_.type), next_row_, end, to);
    }
    next_row_ = end;
}

} // namespace weft::image
