#include "world/lints.h"

#include <fmt/format.h>

#include "lobes/dielectric_boundary.h"

namespace weft::world {

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

std::vector<std::string> lint_warnings(World const& world, scene::Integrator const& integrator,
                                       SourceLocation const& where) {
    std::vector<std::string> warnings;
    scene::Scene const& scene = world.scene();
    bool emits = world.statistics().lights > 0;
    for (uint32_t i = 0; i < world.statistics().objects; ++i) {
        Object const& o = world.object(i);
        std::string const at = to_string(location_of(scene, scene::InstanceId{o.source_instance}));
        emits |= bool(o.emission);
        if (o.emission && o.light < 0)
            warnings.push_back(at + ": emits light but is no <light type=\"area\">: only rays "
                                    "that hit it by chance find it, which is noisy");
        if (!o.material && !o.emission && !o.is_null && emits)
            warnings.push_back(at + ": has no <bsdf> and will be black");
    }
    for (size_t i = 0; i < scene.materials.size(); ++i)
        if (std::string const lint = match(scene.materials[i], MaterialLint{scene}); !lint.empty())
            warnings.push_back(to_string(location_of(scene, scene::MaterialId{int32_t(i)})) + ": " +
                               lint);
    if (!scene::outputs_of(integrator)) return warnings;
    if (!emits)
        warnings.push_back(to_string(where) +
                           ": the scene has no light: the picture will be black; add a <light>");
    for (std::string& warning : light_warnings(world)) warnings.push_back(std::move(warning));
    return warnings;
}

} // namespace weft::world
