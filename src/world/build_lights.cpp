// The part of WorldBuilder that makes lights: those without a surface here, emissive objects in
// build_area_lights.cpp, what is all around in build_environment.cpp.
#include "world/world_builder.h"

namespace weft::world {

void WorldBuilder::add_light(scene::PointLight const& light, SourceLocation const&,
                             LightList& list) {
    lights::PointLight const point{light.position, light.power / (4 * kPi)};
    list.add(point, lights::bounds_of(point), luminance(light.power), light.controls);
}

void WorldBuilder::add_light(scene::DirectionalLight const& light, SourceLocation const&,
                             LightList& list) {
    list.add(lights::DirectionalLight{normalize(light.direction), light.intensity}, at_infinity(),
             list.cross_section * luminance(light.intensity), light.controls);
}

void WorldBuilder::add_light(scene::SpotLight const& light, SourceLocation const&,
                             LightList& list) {
    lights::SpotLight const spot{light.position, normalize(light.direction), light.intensity,
                                 radians(light.angle), radians(light.falloff)};
    list.add(spot, lights::bounds_of(spot), luminance(spot.power()), light.controls);
}

void WorldBuilder::build_lights() {
    RTCBounds box;
    rtcGetSceneBounds(world_.embree_scene_, &box);
    Vec3 const extent(box.upper_x - box.lower_x, box.upper_y - box.lower_y,
                      box.upper_z - box.lower_z);
    float const radius = is_finite(extent) && extent.x >= 0 ? 0.5f * length(extent) : 1;

    LightList list;
    list.cross_section = kPi * square(std::max(radius, 1e-6f));
    for (scene::LightId id : scene_.contents.lights) {
        list.source = id.index;
        std::visit(Overloaded{
                       [&](auto const& light) {
                           add_light(light, scene_.light_locations[size_t(id.index)], list);
                       },
                       [](scene::AreaLight const&) {}, // by the objects that it lets shine
                   },
                   scene_.lights[size_t(id.index)]);
    }
    add_area_lights(list);
    link_lights(list);
    world_.lights_ = LightTable(std::move(list), world_);
}

} // namespace weft::world
