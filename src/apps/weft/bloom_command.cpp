// weft bloom IN -o OUT: the `bloom` postprocess on a picture that is there already.
#include <fmt/format.h>
#include <memory>

#include "apps/weft/commands.h"
#include "apps/weft/display_options.h"
#include "apps/weft/picture_file.h"
#include "image/layers.h"
#include "image/rewrite.h"
#include "post/bloom.h"

namespace weft::apps {

namespace {

struct BloomArguments {
    std::string picture, layer;
    std::vector<std::string> outputs;
    OptionTexts bloom, display;
};

scene::Bloom bloom_of(OptionTexts const& texts) {
    scene::Bloom bloom;
    apply_options(texts, bloom);
    std::string_view const useless = scene::settle_kind(
        bloom, [&](std::string_view name) { return texts.contains(std::string(name)); });
    if (!useless.empty())
        throw InputError(option_name(useless) + " is an option of another kind than '" +
                         schema::TextForm<scene::BloomKind>::write(bloom.kind) + "'");
    return bloom;
}

/// Returns the picture with bloom on its colours, all other channels as they were.
image::Image with_bloom(BloomArguments const& a, scene::Bloom const& bloom,
                        image::Image const& light) {
    auto const colors =
        a.layer.empty() ? image::find_colors(light.names) : image::find_layer(light.names, a.layer);
    if (!colors && a.layer.empty()) return post::apply_bloom(bloom, light);
    if (!colors) layer_of(a.picture, light, a.layer); // tells which there are
    image::Image result = light;
    image::put_channels(post::apply_bloom(bloom, image::take_channels(light, colors.value())),
                        *colors, result);
    return result;
}

int run(BloomArguments const& a) {
    scene::Bloom const bloom = bloom_of(a.bloom);
    post::DisplayChain const chain = display_chain(a.display);
    print_warning(chain);
    for (std::string const& path : a.outputs) image::check_writable(path);
    image::Image const light = read_picture(a.picture);
    if (light.is_srgb_encoded)
        throw InputError({a.picture},
                         "expected a picture of light (.exr, .hdr), found screen colours, in which "
                         "what is bright is clipped");
    image::Image const bloomed = with_bloom(a, bloom, light);
    image::Metadata metadata = image::read_metadata(a.picture);
    std::erase_if(metadata, [](auto const& m) { return !m.first.starts_with("weft:"); });
    metadata["Software"] = "Weft " WEFT_VERSION;
    std::string& how = metadata["weft:postprocess"];
    how += (how.empty() ? "" : ", ") + std::string("bloom (") +
           schema::TextForm<scene::BloomKind>::write(bloom.kind) + ")";
    for (std::string const& path : a.outputs) {
        // What the bloom does not touch stays as it was: other channels, windows, header.
        if (image::is_exr(path) && image::is_exr(a.picture))
            image::rewrite_exr(path, a.picture, bloomed, {{"weft:postprocess", how}});
        else
            post::write_picture(path, bloomed, chain, metadata);
        fmt::print("{}\n", path);
    }
    return kDone;
}

} // namespace

void add_bloom_command(CLI::App& app, Command& chosen) {
    auto a = std::make_shared<BloomArguments>();
    CLI::App* c = app.add_subcommand(
        "bloom", "Add the light that the eye or a lens scatters around what is bright");
    c->add_option("picture", a->picture, "The picture, scene-linear: .exr, .hdr")
        ->required()
        ->type_name("IN");
    c->add_option(
         "--layer", a->layer,
         "Layer or part of IN that is the picture; without it R, G and B, or what is called "
         "as a picture usually is: Combined, rgba, beauty")
        ->type_name("LAYER");
    c->add_option("-o,--output", a->outputs,
                  "Picture to write: .exr, .hdr, .png, .jpg, .tif; may be given several times")
        ->required()
        ->type_name("OUT")
        ->take_all();
    add_described_options<scene::Bloom>(*c, a->bloom, "Bloom");
    add_display_options(*c, a->display);
    c->callback([a, &chosen] { chosen = [a] { return run(*a); }; });
}

} // namespace weft::apps
