#include "apps/weft/scene_loading.h"
#include "apps/weft/picture_file.h"

#include <cmath>
#include <fmt/format.h>

#include "image/texel.h"
#include "integrator/pixel_renderer.h"
#include "schema/text.h"

namespace weft::apps {

Vec2i parse_size(std::string const& text, scene::Scene const& scene) {
    if (text.empty()) return {0, 0};
    auto const fail = [&] {
        return InputError("--size expects WxH in pixels or P%, found '" + text + "'");
    };
    auto in_range = [](double v) { return v >= 1 && v <= 65536; };
    if (text.back() == '%') {
        auto const p = schema::read_components(text.substr(0, text.size() - 1), 1);
        if (!p || !(p->front() > 0)) throw fail();
        auto const& view = match(
            scene.cameras[size_t(scene.contents.camera.index)],
            [](auto const& c) -> auto& { return c.view; });
        double const w = std::round(view.width * p->front() / 100),
                     h = std::round(view.height * p->front() / 100);
        if (!in_range(w) || !in_range(h)) throw fail();
        return {int(w), int(h)};
    }
    size_t const x = text.find('x');
    int w = 0, h = 0;
    if (x == std::string::npos || !schema::TextForm<int>::read(text.substr(0, x), w) ||
        !schema::TextForm<int>::read(text.substr(x + 1), h) || !in_range(w) || !in_range(h))
        throw fail();
    return {w, h};
}

std::unique_ptr<lights::Stage const> commit_stage(scene::RenderJob const& job,
                                                  std::string const& isa, std::string const& size) {
    return lights::Stage::commit(job.scene, {isa, parse_size(size, *job.scene)},
                                 integrator::combines_strategies(job.integrator));
}

void print_messages(io::SceneFile const& file) {
    for (std::string const& warning : file.warnings) fmt::print(stderr, "warning: {}\n", warning);
    for (std::string const& note : file.notes) fmt::print(stderr, "note: {}\n", note);
}

void read_picture_files(io::SceneFile const& file, scene::PostprocessJob const& job,
                        post::Pictures& pictures) {
    for (auto const& [name, id] : scene::pictures_of(job.postprocess).inputs) {
        scene::PictureName const& picture = file.pictures[size_t(id.index)];
        if (picture.file.empty() || pictures.contains(id.index)) continue;
        image::Image image = read_picture(picture.file);
        // As lightwave reads them, and textures here.
        if (image.is_srgb_encoded && !picture.linear)
            for (float& v : image.pixels) v = image::decoded(image::Transfer::gamma22, v);
        image.is_srgb_encoded = false;
        post::Picture& read = pictures[id.index];
        read.image = std::move(image);
        read.original = picture.file;
    }
}

} // namespace weft::apps
