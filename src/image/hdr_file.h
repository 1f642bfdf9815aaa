// Radiance pictures (.hdr, .pic) in all forms of their format: G. Ward, "Real pixels" (Graphics
// Gems II, 1991), and the manual page of Radiance's file formats. OpenImageIO reads the usual form
// alone.
#pragma once

#include <array>
#include <cstdint>
#include <cstdio>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace weft::image {

class HdrFile {
  public:
    /// Reads the header. Throws InputError where the file cannot be opened or is no such picture.
    explicit HdrFile(std::string const& path);

    /// Returns whether a file begins as such pictures do.
    static bool has_signature(std::string const& path);

    int columns() const { return columns_; } ///< pixels of a scan line
    int lines() const { return lines_; }
    /// Returns where lines and pixels lie, by Exif's numbers: 1 for lines from the top, each from
    /// the left.
    int orientation() const { return orientation_; }
    bool is_xyz() const { return is_xyz_; } ///< CIE XYZ with equal energy as white
    /// What the numbers have been multiplied by, as the lines EXPOSURE and COLORCORR say, of which
    /// there may be several.
    std::array<float, 3> const& multiplied() const { return multiplied_; }
    /// x and y of red, green, blue and white, where the file has them.
    std::optional<std::array<float, 8>> const& primaries() const { return primaries_; }

    /// Reads the next scan line: 3 floats for each pixel, as stored. Throws InputError where the
    /// file ends before or is damaged.
    void read_line(float* to);

  private:
    void read_header();
    void read_resolution(std::string const& line);
    std::string header_line();
    uint8_t byte();
    void read_new_runs();
    void read_old_runs(std::array<uint8_t, 4> const& first);
    [[noreturn]] void fail(std::string const& what) const;

    std::string path_;
    std::unique_ptr<std::FILE, int (*)(std::FILE*)> file_;
    int columns_ = 0, lines_ = 0, next_line_ = 0, orientation_ = 1;
    bool is_xyz_ = false;
    std::array<float, 3> multiplied_{1, 1, 1};
    std::optional<std::array<float, 8>> primaries_;
    std::vector<std::array<uint8_t, 4>> pixels_; ///< of the line
};

} // namespace weft::image
