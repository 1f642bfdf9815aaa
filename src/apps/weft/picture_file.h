// The pictures of a render as files: what goes into which kind, and what their headers say.
#pragma once

#include <string>
#include <vector>

#include "image/write.h"
#include "post/display.h"
#include "post/run.h"
#include "session/render.h"

namespace weft::apps {

/// Reads a picture and tells on stderr what of its file's words is not followed. Throws InputError.
image::Image read_picture(std::string const& path);

/// Returns a layer of a picture that was read from `path` (image::take_layer). Throws InputError.
image::Image layer_of(std::string const& path, image::Image const& image, std::string const& layer);

/// Tells on stderr what of a file's words is not followed.
void warn_of_words(std::string const& path, image::Image const& image);

/// Returns what a picture's file says beside its channels: what made it, how far it got, its
/// camera. `scene_hash` is that of the job's scene.
image::ExrHeader picture_header(session::RenderResult const& result, session::Plan const& plan,
                                uint64_t scene_hash, uint32_t seed);

/// Writes a picture. An EXR gets all channels and the whole header; any other file the colours,
/// with alpha where it is there. Throws image::IoError.
void write_picture(std::string const& path, post::Picture const& picture,
                   post::DisplayChain const& chain);

/// Writes a picture to several files and prints their names. All files that can be written are;
/// then it throws the error of the first that could not.
void write_pictures(std::vector<std::string> const& paths, post::Picture const& picture,
                    post::DisplayChain const& chain);

/// Returns the header as text, for parts of pictures that are joined later.
std::string header_text(image::ExrHeader const& header);
/// Reads such a text. Throws InputError that names `name` where it is none.
image::ExrHeader parse_header(std::string const& text, std::string const& name);

/// Reads the texts of --aov: names, separated by commas or spaces. Throws InputError.
std::vector<film::Aov> parse_aovs(std::vector<std::string> const& texts);

/// Returns a list of all AOVs with their channels, for a terminal.
std::string aovs_text();

} // namespace weft::apps
