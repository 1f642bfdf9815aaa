#include "apps/weft/texture_options.h"

#include <cstdio>
#include <fmt/format.h>
#include <unistd.h>

namespace weft::apps {

void add_texture_options(CLI::App& command, TextureArguments& arguments) {
    command
        .add_option("--texture-memory", arguments.cache.memory,
                    "Memory for textures, such as 512M or 4G (default 2G); changes no pixel")
        ->transform(CLI::AsSizeValue(false))
        ->check(CLI::Range(uint64_t(1) << 20, uint64_t(1) << 50))
        ->type_name("SIZE");
    command
        .add_option("--texture-cache", arguments.cache.folder,
                    "Folder for the tiled copies of large textures (default "
                    "$XDG_CACHE_HOME/weft/textures or ~/.cache/weft/textures)")
        ->type_name("FOLDER");
}

std::shared_ptr<image::TextureCache> make_texture_cache(TextureArguments const& arguments) {
    image::TextureCacheOptions options = arguments.cache;
    if (arguments.show_conversion) options.on_conversion = print_conversion;
    return std::make_shared<image::TextureCache>(std::move(options));
}

void print_conversion(std::string const& path, double fraction) {
    // One conversion at a time; the whole percent that was printed last says whether one begins.
    static std::string current;
    static int printed = -1;
    bool const begins = current != path;
    int const percent = int(100 * fraction);
    if (!begins && percent == printed) return;
    current = fraction < 1 ? path : "";
    printed = percent;
    if (isatty(STDERR_FILENO))
        fmt::print(stderr, "\rconverting {} to tiles: {:3} %{}", path, percent,
                   fraction < 1 ? "" : "\n");
    else if (begins)
        fmt::print(stderr, "converting {} to tiles\n", path);
    std::fflush(stderr);
}

} // namespace weft::apps
