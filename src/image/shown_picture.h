// An image file as the picture that it stands for: rows from the top, each from the left, of the
// window that is to be shown, with colours as textures want them.
//
// Where a file holds just that, its texels pass as they are. Else they are decoded, converted to
// linear Rec. 709 floats, and put in place, for which the whole picture is kept in memory.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "image/color_words.h"
#include "image/hdr_file.h"
#include "image/input.h"
#include "image/parts.h"
#include "image/texture.h"

namespace weft::image {

/// Where the stored pixels lie in the picture.
struct Placement {
    int width = 0, height = 0; ///< of the picture
    int x = 0, y = 0;          ///< of the first stored pixel in the picture, as it is shown
    int orientation = 1;       ///< Exif's number: of eight ways to turn and mirror rows and columns
};

/// Returns which stored pixel is shown at (x, y), for pixels stored as `width` x `height`.
Vec2i stored_place(int orientation, int x, int y, int width, int height);

/// Returns the bytes of a PNG up to some of its pixels; "" for other files.
std::string png_head(ImageSource const& source);

class ShownPicture {
  public:
    /// Of an EXR file the picture, or the layer that the path names after a colon (find_channels in
    /// parts.h). Throws like `read_image`; also for a cube map, which no uv square can hold.
    ShownPicture(ImageSource const& source, Encoding encoding, Channels channels = Channels::color);
    ~ShownPicture();

    int width() const { return placement_.width; }
    int height() const { return placement_.height; }
    TexelFormat format() const { return format_; }
    /// Returns whether there are texels of that kind at all: an alpha.
    bool has_channels() const { return has_channels_; }
    /// Returns whether the file's texels are those of the picture, so that a cache of tiles may
    /// read them.
    bool is_as_stored() const { return as_stored_; }
    /// With mip levels, of which the first channels are wanted, as a cache of tiles reads them.
    bool is_in_tiles() const;
    /// What the file says and we do not follow.
    std::vector<std::string> const& warnings() const { return warnings_; }

    /// Reads the next rows, up to `end`, in order from 0.
    void read_to(int end, std::byte* to);
    /// Returns how many rows are best read at once.
    int strip() const;

  private:
    void open(ImageSource const& source);
    void take_words(ImageSource const& source, Encoding encoding, Channels channels);
    void choose_channels(std::string const& layer, Channels channels);
    void place(OIIO::ImageSpec const& spec);
    std::vector<float> stored_floats();
    std::vector<std::byte> stored_texels();
    void read_stored(OIIO::TypeDesc type, int begin, int end, void* to);
    void check_end();
    void make_picture();

    std::string path_;
    std::unique_ptr<OIIO::Filesystem::IOMemReader> memory_;
    std::unique_ptr<OIIO::ImageInput> input_; ///< or else
    std::unique_ptr<HdrFile> hdr_;
    int stored_width_ = 0, stored_height_ = 0;
    ChannelRange channels_; ///< those that are wanted
    TexelFormat stored_, format_;
    Placement placement_;
    ColorConversion convert_;
    bool as_stored_ = true, has_channels_ = true;
    std::vector<std::string> warnings_;
    std::vector<std::byte> picture_; ///< where not as stored: all of it, once a row is read
    int next_row_ = 0;
};

} // namespace weft::image
