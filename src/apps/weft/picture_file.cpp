#include "apps/weft/picture_file.h"

#include <cstdlib>
#include <filesystem>
#include <fmt/format.h>

#include "film/cryptomatte.h"
#include "image/write.h"
#include "scene/scene_hash.h"

namespace weft::apps {

image::Metadata render_metadata(session::RenderResult const& r, uint32_t seed) {
    return {{"Software", "Weft " WEFT_VERSION},
            {"weft:seed", std::to_string(seed)},
            {"weft:samplesPerPixel", std::to_string(r.least_samples)},
            {"weft:complete", r.cancelled ? "false" : "true"}};
}

namespace {

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

image::ExrHeader make_header(session::RenderResult const& r, scene::Scene const& scene,
                             Vec2i full_size, uint32_t seed) {
    image::ExrHeader header;
    header.texts = render_metadata(r, seed);
    header.texts["weft:sceneHash"] = fmt::format("{:016x}", scene::scene_hash(scene));
    // As builds do, for whoever wants the same bytes from the same input.
    if (!std::getenv("SOURCE_DATE_EPOCH"))
        header.texts["weft:renderSeconds"] = fmt::format("{:.3f}", r.seconds);
    scene::Camera const& camera = scene.cameras[size_t(scene.contents.camera.index)];
    header.texts["weft:camera"] = match(camera, [](auto const& c) {
        return fmt::format("<camera type=\"{}\"{}/>", c.info.type, schema::write_attributes(c));
    });
    for (size_t i = 0; i < film::kCryptomattes; ++i) {
        auto const aov = film::Aov(size_t(film::Aov::crypto_object) + i);
        if (!r.film.layout().has(aov)) continue;
        header.texts.merge(film::cryptomatte_metadata(film::cryptomatte_name(aov),
                                                      r.tags.cryptomattes[i].manifest));
    }
    header.chromaticities = image::kRec709;
    header.world_to_camera = world_to_camera(camera);
    header.x = r.region.from.x;
    header.y = r.region.from.y;
    header.full_width = full_size.x;
    header.full_height = full_size.y;
    return header;
}

/// The channels of `image` by these names.
image::Image select(image::Image const& image, std::vector<std::string> const& names) {
    image::Image result = image::make_image(image.width, image.height, int(names.size()));
    for (size_t c = 0; c < names.size(); ++c) {
        auto const at = std::find(image.names.begin(), image.names.end(), names[c]);
        size_t const from = size_t(at - image.names.begin());
        for (size_t i = 0; i < result.pixels.size() / names.size(); ++i)
            result.pixels[i * names.size() + c] = image.pixels[i * size_t(image.channels) + from];
    }
    return result;
}

} // namespace

void write_render(std::string const& path, session::RenderResult const& result,
                  io::RenderJob const& job, world::World const& world, uint32_t seed,
                  post::DisplayChain const& chain) {
    if (std::filesystem::path(path).extension() == ".exr")
        image::write_described_exr(path, result.film.image(),
                                   make_header(result, *job.scene, world.camera().size(), seed));
    else if (result.film.layout().has(film::Aov::alpha))
        post::write_picture(path, select(result.film.image(), {"R", "G", "B", "A"}), chain,
                            render_metadata(result, seed));
    else
        post::write_picture(path, result.image, chain, render_metadata(result, seed));
}

std::vector<film::Aov> parse_aovs(std::vector<std::string> const& texts) {
    auto const names = choices(film::Aov());
    std::vector<std::string> const known(names.begin(), names.end());
    std::vector<film::Aov> aovs;
    for (std::string const& text : texts)
        for (std::string_view const word : schema::split_words(text))
            if (!schema::TextForm<film::Aov>::read(word, aovs.emplace_back()))
                throw InputError("--aov expects names of AOVs, found '" + std::string(word) + "'" +
                                 suggestion(word, known) + "; `weft help aov` lists them");
    return aovs;
}

std::string aovs_text() {
    std::string text = "AOVs: further pictures of the same samples, all in one EXR file.\n"
                       "`weft render SCENE --aov albedo,depth`, or aovs=\"albedo, depth\" of an "
                       "integrator.\n\n";
    for (scene::AovInfo const& aov : scene::kAovs)
        text += fmt::format("  {:<22} {}\n  {:<22} {}\n", aov.name, aov.channels, "", aov.help);
    return text;
}

} // namespace weft::apps
