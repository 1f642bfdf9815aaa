// weft display IN -o OUT: a linear picture through the display chain.
#include <fmt/format.h>
#include <memory>

#include "apps/weft/commands.h"
#include "apps/weft/display_options.h"
#include "apps/weft/picture_file.h"

namespace weft::apps {

namespace {

struct DisplayArguments {
    std::string picture, layer;
    std::vector<std::string> outputs;
    bool list_views = false;
    OptionTexts display;
};

/// Weft's views and those of the configuration that the options or $OCIO name.
int list_views(OptionTexts const& texts) {
    scene::Display display;
    apply_options(texts, display);
    fmt::print("Weft's own, for sRGB:\n  standard\n  agx\n  aces\n");
    char const* const variable = std::getenv("OCIO");
    std::string const config = !display.ocio.path.empty() ? display.ocio.path
                               : variable                 ? variable
                                                          : "";
    if (config.empty()) {
        fmt::print("No OpenColorIO configuration: --ocio or $OCIO names one.\n");
        return kDone;
    }
    fmt::print("{}, the defaults first:\n", config);
    for (post::OcioDisplay const& d : post::ocio_displays(config)) {
        fmt::print("  --display '{}'\n", d.name);
        for (std::string const& view : d.views) fmt::print("    --view '{}'\n", view);
    }
    return kDone;
}

/// Screen colours become the light that they stand for.
void decode(image::Image& image) {
    bool const has_alpha = image.channels == 2 || image.channels == 4;
    int const colors = has_alpha ? image.channels - 1 : image.channels;
    for (size_t i = 0; i < image.pixels.size(); i += size_t(image.channels)) {
        float* const p = &image.pixels[i];
        for (int c = 0; c < colors; ++c) p[c] = srgb_to_linear(p[c]) * (has_alpha ? p[colors] : 1);
    }
    image.is_srgb_encoded = false;
}

int run(DisplayArguments const& a) {
    if (a.list_views) return list_views(a.display);
    if (a.picture.empty()) throw InputError("expected a picture to show, found none");
    if (a.outputs.empty()) throw InputError("expected -o OUT, where to write it, found none");
    post::DisplayChain const chain = display_chain(a.display);
    print_warning(chain);
    for (std::string const& path : a.outputs) image::check_writable(path);
    image::Image image = read_picture(a.picture);
    if (image.is_srgb_encoded) decode(image);
    if (!a.layer.empty()) image = layer_of(a.picture, image, a.layer);
    for (std::string const& path : a.outputs) {
        post::write_picture(path, image, chain, {{"Software", "Weft " WEFT_VERSION}});
        fmt::print("{}\n", path);
    }
    return kDone;
}

} // namespace

post::DisplayChain display_chain(OptionTexts const& texts, scene::Display display,
                                 SourceLocation const& where) {
    apply_options(texts, display);
    return post::make_display_chain(display, texts.empty() ? where : SourceLocation{});
}

void print_warning(post::DisplayChain const& chain) {
    if (!chain.warning.empty()) fmt::print(stderr, "warning: {}\n", chain.warning);
}

void add_display_command(CLI::App& app, Command& chosen) {
    auto a = std::make_shared<DisplayArguments>();
    CLI::App* c = app.add_subcommand(
        "display",
        "Show a linear picture: exposure, white balance, and a view (a tone curve or any "
        "view of an OpenColorIO configuration)");
    c->add_option("picture", a->picture, "The picture: .exr, .hdr; others are decoded from sRGB")
        ->type_name("IN");
    c->add_option(
         "--layer", a->layer,
         "Layer or part of IN to show; without it R, G and B, or what is called as a picture "
         "usually is: Combined, rgba, beauty")
        ->type_name("LAYER");
    c->add_option("-o,--output", a->outputs,
                  "Picture to write: .png, .jpg, .tif; may be given several times")
        ->type_name("OUT")
        ->take_all();
    c->add_flag("--list-views", a->list_views,
                "Print Weft's views, and the displays and views of --ocio or $OCIO");
    add_display_options(*c, a->display);
    c->callback([a, &chosen] { chosen = [a] { return run(*a); }; });
}

} // namespace weft::apps
