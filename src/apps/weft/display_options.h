// How the user asks a command to show its pictures: the parameters of `<display>` as options, which
// go before those of a scene file.
#pragma once

#include "apps/weft/described_options.h"
#include "post/display.h"
#include "scene/display.h"

namespace weft::apps {

inline void add_display_options(CLI::App& command, OptionTexts& texts) {
    add_described_options<scene::Display>(command, texts, "Display (PNG, JPEG and TIFF alone)");
}

/// Returns the display chain of a picture: what the options do not say is as in `display`, which
/// comes from a scene file. Throws InputError, at the picture's <display> unless options replace a
/// part of it.
post::DisplayChain display_chain(OptionTexts const& texts, scene::Display display = {},
                                 SourceLocation const& where = {});

/// Prints what the user should know about a chain to stderr.
void print_warning(post::DisplayChain const& chain);

} // namespace weft::apps
