// Opening image files and telling what is wrong with them, for the parts of this room that read.
#pragma once

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <memory>
#include <string>

#include "image/texel.h"

namespace weft::image {

/// Throws InputError where there is no file, or no image in it. Colours stay as stored, not
/// multiplied by alpha.
std::unique_ptr<OIIO::ImageInput> open_image(std::string const& path);

/// As `open_image`; throws InputError also for a deep image, one of several slices, or one larger
/// than 16 GiB as floats.
std::unique_ptr<OIIO::ImageInput> open_flat_image(std::string const& path);

/// The same for a PNG or JPEG file in memory, which has to outlive the result. `name` stands in for
/// its path in messages.
std::unique_ptr<OIIO::ImageInput> open_flat_image(OIIO::Filesystem::IOMemReader& memory,
                                                  std::string const& name);

/// Throws InputError for a deep image, one of several slices, or one larger than 16 GiB as floats.
void check_flat(OIIO::ImageSpec const& spec, std::string const& name);

/// To be called after each read, with whether it succeeded. Throws InputError where it did not.
void check_read(OIIO::ImageInput& input, std::string const& path, bool succeeded);
/// To be called after the last read: throws InputError where the file lacks its end and the
/// format's library did not mind.
void check_end(OIIO::ImageInput const& input, std::string const& path);
void check_end(OIIO::ImageInput const& input, OIIO::Filesystem::IOMemReader& memory,
               std::string const& name);

/// Integers meant for a screen, unless the file says that they are linear.
bool is_srgb_encoded(OIIO::ImageSpec const& spec);

/// What lookups read of such a file.
TexelFormat texel_format(OIIO::ImageSpec const& spec, Transfer transfer,
                         Channels channels = Channels::color);
OIIO::TypeDesc oiio_type(TexelType type);

} // namespace weft::image
