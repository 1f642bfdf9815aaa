// What several commands let the user say about textures: memory, and where converted ones are kept.
#pragma once

#include <CLI/CLI.hpp>
#include <memory>
#include <string>

#include "image/texture_cache.h"

namespace weft::apps {

struct TextureArguments {
    image::TextureCacheOptions cache;
    /// A long conversion tells on stderr how far it is.
    bool show_conversion = true;
};

void add_texture_options(CLI::App& command, TextureArguments& arguments);

std::shared_ptr<image::TextureCache> make_texture_cache(TextureArguments const& arguments);

/// Tells on stderr how far the conversion of `path` is: a line that grows on a terminal, and
/// elsewhere one line when it begins.
void print_conversion(std::string const& path, double fraction);

} // namespace weft::apps
