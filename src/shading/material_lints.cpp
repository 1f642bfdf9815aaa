#include "shading/material_lints.h"

#include <fmt/format.h>

#include "lobes/dielectric_boundary.h"

namespace weft::shading {

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

std::vector<std::string> material_warnings(scene::Scene const& scene) {
    std::vector<std::string> warnings;
    for (size_t i = 0; i < scene.materials.size(); ++i)
        if (std::string const lint = match(scene.materials[i], MaterialLint{scene}); !lint.empty())
            warnings.push_back(to_string(location_of(scene, scene::MaterialId{int32_t(i)})) + ": " +
                               lint);
    return warnings;
}

} // namespace weft::shading
