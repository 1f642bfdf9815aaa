// weft denoise IN.exr -o OUT.exr: takes the noise out of a picture that is there already.
#include <chrono>
#include <filesystem>
#include <fmt/format.h>
#include <memory>

#include "apps/weft/commands.h"
#include "apps/weft/picture_file.h"
#include "apps/weft/progress_line.h"
#include "base/color.h"
#include "image/layers.h"
#include "image/rewrite.h"
#include "image/write.h"
#include "post/denoise_parts.h"
#include "schema/text.h"

namespace weft::apps {

namespace fs = std::filesystem;

namespace {

struct DenoiseArguments {
    std::string input, output;
    std::string layer, albedo, normal;
    std::vector<std::string> parts, keep;
    std::string backend = "auto", quality = "high";
    post::DenoiseOptions options;
};

std::string list(std::vector<std::string> const& names) {
    return names.empty() ? "none" : fmt::format("{}", fmt::join(names, ", "));
}

image::Image read_linear(std::string const& path) {
    image::Image image = read_picture(path);
    if (image.is_srgb_encoded)
        for (float& x : image.pixels) x = srgb_to_linear(x);
    image.is_srgb_encoded = false;
    return image;
}

image::ChannelTriple colors_of(std::string const& path, image::Image const& image) {
    if (auto const found = image::find_colors(image.names)) return *found;
    throw InputError({path}, "expected the channels R, G and B, found " + list(image.names));
}

image::ChannelTriple channels_of(std::string const& path, image::Image const& image,
                                 std::string const& layer, char const* what = "layer") {
    if (auto const found = image::find_layer(image.names, layer)) return *found;
    auto const layers = image::layer_names(image.names);
    throw InputError({path},
                     std::string("expected a ") + what + " '" + layer + "' of three channels" +
                         (layers.empty() ? ", found no layers" : suggestion(layer, layers)));
}

/// A guide: a layer of the picture or a file, by the option's text; without one, the layer `usual`.
/// Empty where there is none.
image::Image guide(DenoiseArguments const& a, image::Image const& image, char const* what,
                   std::string const& text, std::string const& usual) {
    if (text == "none" || (text.empty() && usual.empty())) return {};
    if (text.empty() || image::find_layer(image.names, text) || !fs::exists(text))
        return image::take_channels(
            image, channels_of(a.input, image, text.empty() ? usual : text, "file or a layer"));
    image::Image const file = read_linear(text);
    if (file.width != image.width || file.height != image.height)
        throw InputError({text},
                         fmt::format("the {} expects the size of the picture, {} x {}, "
                                     "found {} x {}",
                                     what, image.width, image.height, file.width, file.height));
    return image::take_channels(file, colors_of(text, file));
}

/// With "light_*" as all layers that begin so.
std::vector<std::string> expanded(std::vector<std::string> const& parts,
                                  std::vector<std::string> const& channels) {
    std::vector<std::string> layers;
    for (std::string const& part : parts) {
        size_t const before = layers.size();
        if (part.ends_with('*'))
            for (std::string const& layer : image::layer_names(channels))
                if (layer.starts_with(part.substr(0, part.size() - 1))) layers.push_back(layer);
        if (layers.size() == before) layers.push_back(part);
    }
    return layers;
}

/// Empty without layers.
image::Image sum_of(DenoiseArguments const& a, image::Image const& image,
                    std::vector<std::string> const& layers) {
    image::Image sum;
    for (std::string const& layer : layers) {
        image::Image const one = image::take_channels(image, channels_of(a.input, image, layer));
        if (sum.pixels.empty()) sum = image::make_image(image.width, image.height, 3);
        for (size_t i = 0; i < sum.pixels.size(); ++i) sum.pixels[i] += one.pixels[i];
    }
    return sum;
}

/// The layers that stay as they are: those of --keep, or else the one that is made for it.
std::vector<std::string> kept_layers(DenoiseArguments const& a, image::Image const& image) {
    if (a.keep == std::vector<std::string>{"none"}) return {};
    if (!a.keep.empty()) return expanded(a.keep, image.names);
    std::string const usual = image::find_kept_layer(image.names);
    return usual.empty() ? std::vector<std::string>() : std::vector{usual};
}

/// Parts that are to be denoised beside the whole must sum to it.
void check_sum(DenoiseArguments const& a, image::Image const& color,
               std::vector<image::Image> const& parts) {
    constexpr double kRounding = 0.01; // that of halves, and of a few samples that were not finite
    double difference = 0, total = 0;
    for (size_t i = 0; i < color.pixels.size(); ++i) {
        double sum = 0;
        for (image::Image const& part : parts) sum += double(part.pixels[i]);
        double const whole = double(color.pixels[i]);
        if (!std::isfinite(whole) || !std::isfinite(sum)) continue;
        difference += std::abs(whole - sum);
        total += std::abs(whole);
    }
    if (difference > kRounding * total)
        throw InputError({a.input}, fmt::format("expected layers that sum to the picture, found {} "
                                                "whose sum is off by {:.3g}% on the average",
                                                list(a.parts), 100 * difference / total));
}

/// Writes the channels back where they come from, all else as it was.
void write(DenoiseArguments const& a, image::Image const& image, image::ChannelTriple const& colors,
           post::Backend backend) {
    image::Metadata const more{
        {"weft:postprocess", fmt::format("denoising ({})", post::backend_name(backend))}};
    bool const exr = image::is_exr(a.output) && image::is_exr(a.input);
    if (exr) {
        image::rewrite_exr(a.output, a.input, image, more);
    } else {
        // What else a header says, of its numbers as light, is not true of another kind of file.
        image::Metadata metadata = image::read_metadata(a.input);
        std::erase_if(metadata, [](auto const& m) { return !m.first.starts_with("weft:"); });
        metadata["Software"] = "Weft " WEFT_VERSION;
        metadata.insert(more.begin(), more.end());
        image::write_image(
            a.output, image.channels <= 4 ? image : image::take_channels(image, colors), metadata);
    }
    fmt::print("{}\n", a.output);
}

int run(DenoiseArguments& a) {
    image::check_writable(a.output);
    schema::TextForm<post::Backend>::read(a.backend, a.options.backend);
    schema::TextForm<post::Quality>::read(a.quality, a.options.quality);
    image::Image image = read_linear(a.input);
    auto const colors =
        a.layer.empty() ? colors_of(a.input, image) : channels_of(a.input, image, a.layer);
    image::Image const color = image::take_channels(image, colors);
    image::Image const albedo =
        guide(a, image, "albedo", a.albedo, image::find_albedo_layer(image.names));
    image::Image const normal = post::unpack_normals(
        guide(a, image, "normal", a.normal, image::find_normal_layer(image.names)));
    image::Image const kept = sum_of(a, image, kept_layers(a, image));
    post::DenoiseInput const input{&color, albedo.pixels.empty() ? nullptr : &albedo,
                                   normal.pixels.empty() ? nullptr : &normal,
                                   kept.pixels.empty() ? nullptr : &kept};
    a.parts = expanded(a.parts, image.names);
    std::vector<image::Image> parts;
    for (std::string const& layer : a.parts)
        parts.push_back(image::take_channels(image, channels_of(a.input, image, layer)));
    if (!parts.empty()) check_sum(a, color, parts);

    auto const start = std::chrono::steady_clock::now();
    post::Backend backend;
    bool lacks_weights;
    if (parts.empty()) {
        post::Denoised const result = post::denoise(input, a.options);
        backend = result.backend;
        lacks_weights = result.lacks_weights;
        image::put_channels(result.image, colors, image);
    } else {
        post::DenoisedParts const result = post::denoise_parts(parts, input, a.options);
        backend = result.backend;
        lacks_weights = result.lacks_weights;
        image::put_channels(result.whole, colors, image);
        for (size_t i = 0; i < parts.size(); ++i)
            image::put_channels(result.parts[i], channels_of(a.input, image, a.parts[i]), image);
    }
    std::chrono::duration<double> const seconds = std::chrono::steady_clock::now() - start;
    write(a, image, colors, backend);
    if (lacks_weights)
        fmt::print(stderr, "warning: the network's weights for high quality are not there; this is "
                           "balanced quality: tools/setup denoise downloads them\n");
    fmt::print(stderr, "denoised by {}{}{}{} in {}\n", post::backend_name(backend),
               input.albedo ? ", with albedo" : "", input.normal ? ", with normals" : "",
               input.kept ? ", without light in view" : "", duration_text(seconds.count()));
    return kDone;
}

} // namespace

void add_denoise_command(CLI::App& app, Command& chosen) {
    auto a = std::make_shared<DenoiseArguments>();
    CLI::App* c = app.add_subcommand("denoise", "Take the noise out of a rendered picture");
    c->add_option("picture", a->input,
                  "The picture; layers of an EXR that are called as albedo and normals usually are "
                  "guide the denoiser, and denoise_kept stays as it is")
        ->required()
        ->type_name("IN");
    c->add_option("-o,--output", a->output,
                  "File to write; as EXR it has all layers and the header of IN")
        ->required()
        ->type_name("OUT");
    c->add_option(
         "--layer", a->layer,
         "Layer or part of IN that is the picture; without it R, G and B, or what is called "
         "as a picture usually is: Combined, rgba, beauty")
        ->type_name("LAYER");
    c->add_option("--albedo", a->albedo, "Layer of IN, or another file, with the albedo; or none")
        ->type_name("LAYER|FILE");
    c->add_option("--normal", a->normal, "Layer of IN, or another file, with normals; or none")
        ->type_name("LAYER|FILE");
    c->add_option(
         "--parts", a->parts,
         "Layers that sum to the picture, as the light of each lamp: denoised so that they "
         "still do; 'light_*' stands for all that begin so")
        ->type_name("LAYER,...")
        ->delimiter(',');
    c->add_option("--keep", a->keep,
                  "Layers with light that stays as it is, as emission,background, or none; without "
                  "it denoise_kept, where that is there: lamps and sky in focus")
        ->type_name("LAYER,...")
        ->delimiter(',');
    c->add_option("--backend", a->backend, "What denoises; `weft help denoising` says more")
        ->check(CLI::IsMember({"auto", "oidn", "network", "nlm"}));
    c->add_option("--quality", a->quality,
                  "high: guides are denoised first, and the network is the larger one; balanced: a "
                  "quarter of the time")
        ->check(CLI::IsMember({"high", "balanced"}));
    c->add_option("--memory", a->options.memory, "Memory to take beside the pictures, in MB")
        ->check(CLI::Range(256, 1048576));
    c->add_option("--weights", a->options.weights, "Folder with the network's weights")
        ->type_name("FOLDER");
    c->callback([a, &chosen] { chosen = [a] { return run(*a); }; });
}

} // namespace weft::apps
