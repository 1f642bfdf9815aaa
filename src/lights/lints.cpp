#include "lights/lints.h"

#include "shading/material_lints.h"

namespace weft::lights {

std::vector<std::string> lint_warnings(Stage const& stage, scene::Integrator const& integrator,
                                       SourceLocation const& where) {
    std::vector<std::string> warnings;
    world::World const& world = stage.world();
    scene::Scene const& scene = world.scene();
    bool emits = stage.lights().size() > 0;
    for (uint32_t i = 0; i < world.object_count(); ++i) {
        world::Model const& m = world.model(i);
        auto const at = [&] {
            return to_string(
                location_of(scene, scene::InstanceId{world.object(i).source_instance}));
        };
        emits |= bool(m.emission);
        if (m.emission && stage.lights().of_object(i) < 0)
            warnings.push_back(at() + ": emits light but is no <light type=\"area\">: only rays "
                                      "that hit it by chance find it, which is noisy");
        if (!m.traits.bsdf && !m.emission && !m.is_null && emits)
            warnings.push_back(at() + ": has no <bsdf> and will be black");
    }
    for (std::string& warning : shading::material_warnings(scene))
        warnings.push_back(std::move(warning));
    for (std::string& warning : solid_warnings(world)) warnings.push_back(std::move(warning));
    for (std::string& warning : precision_warnings(world)) warnings.push_back(std::move(warning));
    if (!scene::outputs_of(integrator)) return warnings;
    if (!emits)
        warnings.push_back(to_string(where) +
                           ": the scene has no light: the picture will be black; add a <light>");
    for (std::string& warning : light_warnings(stage)) warnings.push_back(std::move(warning));
    return warnings;
}

} // namespace weft::lights
