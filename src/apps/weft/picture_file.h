// The pictures of a render as files: what goes into which kind, and what their headers say.
#pragma once

#include <string>
#include <vector>

#include "image/write.h"
#include "post/display.h"
#include "session/render.h"

namespace weft::apps {

/// What a picture's file says beside its channels: what made it, how far it got, its camera.
image::ExrHeader picture_header(session::RenderResult const& result, scene::RenderJob const& job,
                                world::World const& world, uint32_t seed);

/// An EXR gets all channels of the film and the whole header; any other file the beauty, with alpha
/// where that was asked for. Throws image::IoError.
void write_film(std::string const& path, film::Film const& film, image::ExrHeader const& header,
                post::DisplayChain const& chain);

/// The same for several files, whose names it prints: all that can be written are; then it throws
/// what the first of the others had to say.
void write_films(std::vector<std::string> const& paths, film::Film const& film,
                 image::ExrHeader const& header, post::DisplayChain const& chain);

/// The part of a header's texts that belongs into any file.
image::Metadata plain_texts(image::ExrHeader const& header);

/// A header as text, for parts of pictures that are joined later, and back; `name` is for messages.
std::string header_text(image::ExrHeader const& header);
image::ExrHeader parse_header(std::string const& text, std::string const& name);

/// What --aov says: names, separated by commas or spaces. Throws InputError.
std::vector<film::Aov> parse_aovs(std::vector<std::string> const& texts);

/// A list of all AOVs with their channels, for a terminal.
std::string aovs_text();

} // namespace weft::apps
