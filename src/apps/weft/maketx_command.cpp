// weft maketx IN... [-o OUT]: images to tiled, mip-mapped ones, ahead of the renders that would
// convert them.
#include <filesystem>
#include <fmt/format.h>
#include <memory>

#include "apps/weft/commands.h"
#include "apps/weft/texture_options.h"
#include "base/error.h"
#include "image/image.h"
#include "image/texture_file.h"
#include "scene/color_space.h"
#include "schema/text.h"

namespace weft::apps {

namespace fs = std::filesystem;

namespace {

struct MaketxArguments {
    std::vector<std::string> images;
    std::string output, color_space = schema::TextForm<scene::ColorSpace>::write({});
};

/// Beside the image, or in the folder or under the name that the user gave.
std::string output_path(MaketxArguments const& a, std::string const& image) {
    fs::path const beside = fs::path(image).replace_extension(".tx");
    if (a.output.empty()) return beside.string();
    if (fs::is_directory(a.output)) return (fs::path(a.output) / beside.filename()).string();
    if (a.images.size() > 1)
        throw InputError("-o expects a folder for several images, found '" + a.output + "'");
    return a.output;
}

int run(MaketxArguments const& a) {
    scene::ColorSpace color_space{};
    schema::TextForm<scene::ColorSpace>::read(a.color_space, color_space); // one of the names
    for (std::string const& image : a.images) {
        std::string const to = output_path(a, image);
        if (fs::exists(to) && fs::exists(image) && fs::equivalent(to, image))
            throw InputError(image + ": the image and its conversion are the same file; -o names "
                                     "another");
        try {
            image::make_texture_file(image, to, scene::encoding_of(color_space),
                                     [&](double fraction) { print_conversion(image, fraction); });
        } catch (image::IoError const& e) {
            throw InputError(e.what());
        }
        fmt::print("{}\n", to);
    }
    return kDone;
}

} // namespace

void add_maketx_command(CLI::App& app, Command& chosen) {
    auto a = std::make_shared<MaketxArguments>();
    auto const names = choices(scene::ColorSpace{});
    CLI::App* c = app.add_subcommand(
        "maketx", "Convert images to tiled, mip-mapped textures (.tx), of which a render reads "
                  "only what it sees; large images are otherwise converted when first rendered");
    c->add_option("images", a->images, "The images")->required()->type_name("IN...");
    c->add_option("-o,--output", a->output,
                  "Where to: a file, or a folder for several images; "
                  "else beside each image")
        ->type_name("OUT.tx");
    c->add_option("--color-space", a->color_space,
                  "How 8 and 16 bit images encode colours, as the texture will say; lin_rec709 for "
                  "data such as normals")
        ->check(CLI::IsMember(std::vector<std::string>(names.begin(), names.end())));
    c->callback([a, &chosen] { chosen = [a] { return run(*a); }; });
}

} // namespace weft::apps
