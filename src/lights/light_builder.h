// Makes the table of lights of a committed world: the lights of its scene that are no objects, and
// the objects that its area lights hold.
//
// One `add_light` per kind of light in a scene: build_lights.cpp has those without a surface,
// build_environment.cpp what is all around, build_area_lights.cpp the emissive objects.
#pragma once

#include "lights/light_list.h"
#include "lights/light_table.h"
#include "shading/graph_compiler.h"
#include "world/world.h"

namespace weft::lights {

class LightBuilder {
  public:
    /// `compensate`: see Stage::commit. The world is changed in one thing alone: the emission of
    /// what belongs to an area light of a given power is scaled to it.
    LightBuilder(world::World& world, bool compensate)
        : world_(world), scene_(world.scene()), compensate_(compensate),
          compiler_(scene_, {.origin = Vec3(world.origin())}),
          map_compiler_(scene_, {.directions = true}), textures_(scene_.textures.size()) {}
    /// Throws InputError for what a scene's light cannot be (a varying colour, ...).
    LightTable build();

  private:
    /// Returns a light's brightness, at least 0. Throws InputError where it varies.
    Color brightness(scene::Input<Color> const& input, std::string const& title);
    /// The gobo of a spot, if there is one, and how much it lets through: the mean, weighted by
    /// what the spot sends there.
    std::pair<std::optional<Gobo>, float> make_gobo(scene::SpotLight const& light,
                                                    SpotLight const& spot);
    void add_lamp(Lamp lamp, float power, scene::LightControls const& controls);
    NetworkMap make_map(scene::EnvironmentLight const& light, SourceLocation const& where);
    void add_light(scene::PointLight const&, SourceLocation const&);
    void add_light(scene::DirectionalLight const&, SourceLocation const&);
    void add_light(scene::SpotLight const&, SourceLocation const&);
    void add_light(scene::IesLight const&, SourceLocation const&);
    void add_light(scene::EnvironmentLight const&, SourceLocation const&);
    void add_light(scene::SkyLight const&, SourceLocation const&);
    /// Area lights are added by the objects that they hold.
    void add_light(scene::AreaLight const&, SourceLocation const&) {}
    void add_area_lights();
    AreaLight make_area_light(uint32_t object) const;
    /// Returns whether rays find what sampling of the light leaves.
    bool is_compensated(scene::LightControls const& controls) const;
    /// `light` without its portals and `to_map`.
    void add_environment(EnvironmentLight light, std::span<scene::PortalId const> portals,
                         scene::LightControls const& controls);
    /// Completes the rules of all lights by what the world knows of sets and objects.
    void link_lights();

    world::World& world_;
    scene::Scene const& scene_;
    bool compensate_;
    shading::GraphCompiler compiler_;
    shading::GraphCompiler map_compiler_; ///< of environments
    shading::Textures textures_;          ///< of gobos
    LightList list_;
};

} // namespace weft::lights
