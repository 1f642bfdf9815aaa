#include "apps/weft/picture_file.h"

#include <cstdlib>
#include <exception>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "film/cryptomatte.h"
#include "image/layers.h"
#include "image/rewrite.h"
#include "image/write.h"
#include "schema/text.h"

namespace weft::apps {

namespace {

char const* text_of(session::StoppedBy why) {
    switch (why) {
    case session::StoppedBy::noise:
        return "noise";
    case session::StoppedBy::time:
        return "time";
    case session::StoppedBy::user:
        return "user";
    case session::StoppedBy::samples:
        break;
    }
    return "samples";
}

/// What is written beside the pixels of any file.
image::Metadata metadata(session::RenderResult const& r, uint32_t seed) {
    image::Metadata m{{"Software", "Weft " WEFT_VERSION},
                      {"weft:seed", std::to_string(seed)},
                      {"weft:samplesPerPixel", std::to_string(r.least_samples)},
                      {"weft:stoppedBy", text_of(r.stopped_by)},
                      {"weft:complete", r.cancelled ? "false" : "true"}};
    if (r.noise) {
        m["weft:noise"] = fmt::format("{:.4g}", *r.noise);
        m["weft:meanSamplesPerPixel"] =
            fmt::format("{:.1f}", r.pixel_samples / double(r.film.region().pixels()));
    }
    return m;
}

/// As OpenEXR wants it: y up, and row by row for row vectors.
std::array<float, 16> world_to_camera(scene::Camera const& camera) {
    Affined const m = match(camera, [](auto const& c) { return c.view.transform; }).inverse();
    std::array<float, 16> rows{};
    Vec3d const columns[]{m.x, m.y, m.z, m.origin};
    for (size_t i = 0; i < 4; ++i) {
        rows[4 * i] = float(columns[i].x);
        rows[4 * i + 1] = float(-columns[i].y);
        rows[4 * i + 2] = float(columns[i].z);
    }
    rows[15] = 1;
    return rows;
}

/// Returns the colours of a picture, and their alpha where there is one. A picture without colours
/// that are called so is all colours.
image::Image colors(image::Image const& image) {
    auto const found = image::find_colors(image.names);
    if (!found) return image;
    std::string const& red = image.names[size_t((*found)[0])];
    auto const alpha =
        std::find(image.names.begin(), image.names.end(), red.substr(0, red.rfind('.') + 1) + "A");
    image::Image const three = image::take_channels(image, *found);
    if (alpha == image.names.end()) return three;
    image::Image result = image::make_image(image.width, image.height, 4);
    image::put_channels(three, {0, 1, 2}, result);
    for (size_t i = 0; i < result.pixels.size() / 4; ++i)
        result.pixels[4 * i + 3] =
            image.pixels[i * size_t(image.channels) + size_t(alpha - image.names.begin())];
    return result;
}

/// Returns the texts of a header that belong into files of any kind.
image::Metadata plain_texts(image::ExrHeader const& header) {
    image::Metadata result;
    for (char const* key :
         {"Software", "weft:seed", "weft:samplesPerPixel", "weft:stoppedBy", "weft:complete",
          "weft:noise", "weft:meanSamplesPerPixel", "weft:postprocess"})
        if (auto const at = header.texts.find(key); at != header.texts.end()) result.insert(*at);
    return result;
}

/// Returns how the channels of an AOV are called in a file: "N.X N.Y N.Z", "albedo.R ...".
std::string channels_text(scene::AovInfo const& info) {
    std::string const layer(info.layer);
    switch (info.how) {
    case scene::Accumulation::Ids:
        return layer + "00.R ...";
    case scene::Accumulation::MeanPerLightGroup:
    case scene::Accumulation::MeanPerLayer:
        return layer + "NAME." + info.letters[0] + " ...";
    case scene::Accumulation::Beauty:
    case scene::Accumulation::Mean:
    case scene::Accumulation::Ratio:
    case scene::Accumulation::Nearest:
    case scene::Accumulation::SampleCount:
    case scene::Accumulation::Variance:
        break;
    }
    if (info.letters.empty()) return layer;
    if (layer == info.name) return layer + "." + info.letters[0] + " ...";
    std::string text;
    for (char letter : info.letters)
        text += (text.empty() ? "" : " ") + layer + (layer.empty() ? "" : ".") + letter;
    return text;
}

} // namespace

image::Image layer_of(std::string const& path, image::Image const& image,
                      std::string const& layer) {
    try {
        return image::take_layer(image, layer);
    } catch (InputError const& e) {
        throw InputError({path}, e.what());
    }
}

void warn_of_words(std::string const& path, image::Image const& image) {
    for (std::string const& warning : image.warnings)
        fmt::print(stderr, "warning: {}: {}\n", path, warning);
}

image::Image read_picture(std::string const& path) {
    image::Image image = image::read_image(path);
    warn_of_words(path, image);
    return image;
}

image::ExrHeader picture_header(session::RenderResult const& r, session::Plan const& plan,
                                uint64_t scene_hash, uint32_t seed) {
    scene::Scene const& scene = *plan.job.scene;
    image::ExrHeader header;
    header.texts = metadata(r, seed);
    header.texts["weft:sceneHash"] = fmt::format("{:016x}", scene_hash);
    // As builds do, for whoever wants the same bytes from the same input.
    if (!std::getenv("SOURCE_DATE_EPOCH"))
        header.texts["weft:renderSeconds"] = fmt::format("{:.3f}", r.seconds);
    scene::Camera const& camera = scene.cameras[size_t(scene.contents.camera.index)];
    header.texts["weft:camera"] = match(camera, [](auto const& c) {
        return fmt::format("<camera type=\"{}\"{}/>", c.info.type, schema::write_attributes(c));
    });
    for (size_t i = 0; i < film::kCryptomattes; ++i) {
        film::Aov const aov = film::kCryptomatteAovs[i];
        if (plan.layout.has(aov))
            header.texts.merge(film::cryptomatte_metadata(std::string(info_of(aov).layer),
                                                          plan.tags.cryptomattes[i].manifest));
    }
    header.chromaticities = image::kRec709;
    header.world_to_camera = world_to_camera(camera);
    header.x = plan.region.from.x;
    header.y = plan.region.from.y;
    Vec2i const full_size = plan.stage.world().camera().size();
    header.full_width = full_size.x;
    header.full_height = full_size.y;
    return header;
}

void write_picture(std::string const& path, post::Picture const& p,
                   post::DisplayChain const& chain) {
    if (!image::is_exr(path))
        post::write_picture(path, colors(p.image), chain, plain_texts(p.header));
    else if (image::is_exr(p.original))
        image::rewrite_exr(path, p.original, p.image, p.header.texts);
    else
        image::write_described_exr(path, p.image, p.header);
}

void write_pictures(std::vector<std::string> const& paths, post::Picture const& picture,
                    post::DisplayChain const& chain) {
    std::exception_ptr failure;
    for (std::string const& path : paths) {
        try {
            write_picture(path, picture, chain);
            fmt::print("{}\n", path);
        } catch (image::IoError const&) {
            if (!failure) failure = std::current_exception();
        }
    }
    if (failure) std::rethrow_exception(failure);
}

std::string header_text(image::ExrHeader const& h) {
    nlohmann::json j{{"texts", h.texts}, {"window", {h.x, h.y, h.full_width, h.full_height}}};
    if (h.chromaticities) j["chromaticities"] = *h.chromaticities;
    if (h.world_to_camera) j["worldToCamera"] = *h.world_to_camera;
    return j.dump();
}

image::ExrHeader parse_header(std::string const& text, std::string const& name) {
    try {
        auto const j = nlohmann::json::parse(text);
        image::ExrHeader h;
        j.at("texts").get_to(h.texts);
        auto const& window = j.at("window");
        h.x = window.at(0);
        h.y = window.at(1);
        h.full_width = window.at(2);
        h.full_height = window.at(3);
        if (j.contains("chromaticities")) h.chromaticities = j.at("chromaticities");
        if (j.contains("worldToCamera")) h.world_to_camera = j.at("worldToCamera");
        return h;
    } catch (nlohmann::json::exception const&) {
        throw InputError(name + ": expected a part of a render, found a checkpoint");
    }
}

std::vector<film::Aov> parse_aovs(std::vector<std::string> const& texts) {
    auto const names = choices(film::Aov());
    std::vector<std::string> const known(names.begin(), names.end());
    std::vector<film::Aov> aovs;
    for (std::string const& text : texts)
        for (std::string_view const word : schema::split_words(text))
            if (!schema::TextForm<film::Aov>::read(word, aovs.emplace_back())) {
                std::string const why(why_missing(film::Aov(), word));
                throw InputError("--aov expects names of AOVs, found '" + std::string(word) + "'" +
                                 (why.empty() ? suggestion(word, known) : why) +
                                 "; `weft help aov` lists them");
            }
    return aovs;
}

std::string aovs_text() {
    std::string text = "AOVs: further pictures of the same samples, all in one EXR file.\n"
                       "`weft render SCENE --aov albedo,depth`, or aovs=\"albedo, depth\" of an "
                       "integrator.\n\n";
    for (scene::AovInfo const& aov : scene::kAovs)
        text +=
            fmt::format("  {:<22} {}\n  {:<22} {}\n", aov.name, channels_text(aov), "", aov.help);
    return text;
}

} // namespace weft::apps
