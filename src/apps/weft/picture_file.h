// The pictures of a render as files: what goes into which kind, and what their headers say.
#pragma once

#include <string>
#include <vector>

#include "post/display.h"
#include "session/render.h"

namespace weft::apps {

/// An EXR gets all channels of the film and says how it was made; any other file the beauty, with
/// alpha where that was asked for. Throws image::IoError.
void write_render(std::string const& path, session::RenderResult const& result,
                  io::RenderJob const& job, world::World const& world, uint32_t seed,
                  post::DisplayChain const& chain);

/// What is written beside the pixels of any file.
image::Metadata render_metadata(session::RenderResult const& result, uint32_t seed);

/// What --aov says: names, separated by commas or spaces. Throws InputError.
std::vector<film::Aov> parse_aovs(std::vector<std::string> const& texts);

/// A list of all AOVs with their channels, for a terminal.
std::string aovs_text();

} // namespace weft::apps
