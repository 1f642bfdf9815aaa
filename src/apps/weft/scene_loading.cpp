#include "apps/weft/scene_loading.h"

#include <cmath>
#include <fmt/format.h>

#include "lobes/dielectric_boundary.h"
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

namespace {

/// What is legal in a material and hardly meant; "" if nothing.
struct MaterialLint {
    scene::Scene const& scene;

    std::string operator()(scene::Microfacet const& m) const {
        bool const constant = !m.ior.texture && !m.reflection_ior.texture;
        if (!constant || m.metal != scene::Metal::none || m.reflection_ior.value <= 0) return "";
        float const gain = lobes::energy_gain(m.ior.value, m.reflection_ior.value);
        if (gain <= 0.03f) return "";
        return fmt::format(
            "reflectionIor {} and ior {} would give out up to {:.0f} % more light than comes in; "
            "what is refracted is dimmed by that",
            m.reflection_ior.value, m.ior.value, 100 * gain);
    }
    std::string operator()(scene::Layered const& m) const {
        if (m.layers.empty()) return "";
        scene::Input<float> const& opacity = scene.layers[size_t(m.layers.back().index)].opacity;
        if (opacity.texture || opacity.value >= 1) return "";
        return fmt::format("the last <layer> has opacity {}: what it does not cover is black; put "
                           "a layer that covers everything below it",
                           opacity.value);
    }
    template <class M>
    std::string operator()(M const&) const {
        return "";
    }
};

} // namespace

std::vector<std::string> lint_warnings(world::World const& world) {
    std::vector<std::string> warnings;
    scene::Scene const& scene = world.scene();
    bool emits = world.statistics().lights > 0;
    for (uint32_t i = 0; i < world.statistics().objects; ++i) {
        world::Object const& o = world.object(i);
        std::string const where = to_string(scene.instance_locations[size_t(o.source_instance)]);
        emits |= bool(o.emission);
        if (o.emission && o.light < 0)
            warnings.push_back(where + ": emits light but is no <light type=\"area\">: only rays "
                                       "that hit it by chance find it, which is noisy");
        if (!o.material && !o.emission && !o.is_null && emits)
            warnings.push_back(where + ": has no <bsdf> and will be black");
    }
    for (size_t i = 0; i < scene.materials.size(); ++i)
        if (std::string const lint = match(scene.materials[i], MaterialLint{scene}); !lint.empty())
            warnings.push_back(to_string(scene.material_locations[i]) + ": " + lint);
    if (!emits)
        warnings.push_back("the scene has no light: the picture will be black; add a <light>");
    return warnings;
}

} // namespace weft::apps
