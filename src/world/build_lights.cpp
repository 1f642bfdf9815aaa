// The part of WorldBuilder that makes lights: those without a surface here, emissive objects in
// build_area_lights.cpp, what is all around in build_environment.cpp.
#include "world/world_builder.h"

namespace weft::world {

Color WorldBuilder::brightness(scene::Input<Color> const& input, std::string const& title) {
    if (!input.texture) return input.value;
    SourceLocation const where = location_of(scene_, input.texture);
    world_.textures_.prepare(compiler_, input.texture, where);
    if (world_.textures_.needs(input.texture) != shading::Needs::nothing)
        throw InputError(where, title + " expects one color, found nodes that vary from point to "
                                        "point");
    return world_.textures_.radiance(input, Vec2(0));
}

void WorldBuilder::add_lamp(Lamp lamp, float power, scene::LightControls const& controls,
                            LightList& list) {
    auto const where = lights::bounds_of(lamp.luminaire);
    list.add_lamp(std::move(lamp), where, power, controls);
}

void WorldBuilder::add_light(scene::PointLight const& light, SourceLocation const&,
                             LightList& list) {
    std::string const of = " of <light type=\"point\">";
    Color const scale = scene::scale_of(light.color, light.unit);
    Color const power = brightness(light.power, "'power'" + of) * scale,
                intensity = brightness(light.intensity, "'intensity'" + of) * scale;
    lights::PointLight const point{light.position, power / (4 * kPi) + intensity};
    add_lamp({lights::make_luminaire(point, light.radius), {}},
             luminance(power + intensity * (4 * kPi)), light.controls, list);
}

void WorldBuilder::add_light(scene::DirectionalLight const& light, SourceLocation const&,
                             LightList& list) {
    Color const irradiance =
        brightness(light.intensity, "'intensity' of <light type=\"directional\">") *
        scene::scale_of(light.color, light.unit);
    Vec3 const direction = normalize(light.direction);
    float const power = list.cross_section * luminance(irradiance);
    if (radians(0.5f * light.angle) >= lights::kLeastSunRadius)
        list.add_lamp(lights::make_sun_disk(direction, radians(0.5f * light.angle), irradiance),
                      at_infinity(), power, light.controls);
    else
        list.add_lamp(lights::DirectionalLight{direction, irradiance}, at_infinity(), power,
                      light.controls);
}

std::pair<std::optional<Gobo>, float> WorldBuilder::make_gobo(scene::SpotLight const& light,
                                                              lights::SpotLight const& spot) {
    if (!light.gobo.texture) return {std::nullopt, 1.f};
    SourceLocation const where = location_of(scene_, light.gobo.texture);
    world_.textures_.prepare(compiler_, light.gobo.texture, where);
    if (!within(world_.textures_.needs(light.gobo.texture), shading::Needs::uv))
        throw InputError(where, "'gobo' of <light type=\"spot\"> expects nodes that depend on uv "
                                "alone, found one that depends on a surface");
    Gobo gobo{{spot.axis, light.up, spot.angle + spot.falloff}, light.gobo};
    constexpr int n = 64;
    double sum = 0, all = 0;
    for (int i = 0; i < n * n; ++i) {
        Vec2 const uv((float(i % n) + 0.5f) / n, (float(i / n) + 0.5f) / n);
        Vec3 const d = gobo.projection.direction(uv);
        // The solid angle that a cell of the image is seen under.
        double const weight =
            double(spot.attenuation(d)) / std::pow(double(length_squared(d)), 1.5);
        sum += weight * double(luminance(world_.textures_.radiance(light.gobo, uv)));
        all += weight;
    }
    return {std::move(gobo), all > 0 ? float(sum / all) : 1.f};
}

void WorldBuilder::add_light(scene::SpotLight const& light, SourceLocation const&,
                             LightList& list) {
    std::string const of = " of <light type=\"spot\">";
    lights::SpotLight spot{light.position,
                           normalize(light.direction),
                           Color(1),
                           radians(light.angle),
                           radians(light.falloff),
                           light.falloff_shape == scene::Falloff::smooth};
    Color const scale = scene::scale_of(light.color, light.unit);
    Color const power = brightness(light.power, "'power'" + of),
                intensity = brightness(light.intensity, "'intensity'" + of);
    spot.intensity = (is_black(power) ? intensity : intensity + power / spot.power()) * scale;
    if (!light.gobo.texture) spot.intensity *= light.gobo.value;
    auto [gobo, passed] = make_gobo(light, spot);
    add_lamp({lights::make_luminaire(spot, light.radius), std::move(gobo)},
             passed * luminance(spot.power()), light.controls, list);
}

void WorldBuilder::add_light(scene::IesLight const& light, SourceLocation const&, LightList& list) {
    Color const tint = brightness(light.tint, "'tint' of <light type=\"ies\">");
    lights::PhotometricLight const lamp{
        light.position, lights::lamp_frame(normalize(light.direction), light.c0),
        tint * scene::scale_of(light.color, scene::LightUnit::photometric),
        scene_.photometries[size_t(light.filename.resource)]};
    add_lamp({lights::make_luminaire(lamp, light.radius), {}}, luminance(lamp.power()),
             light.controls, list);
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
                       [&](auto const& light) { add_light(light, location_of(scene_, id), list); },
                       [](scene::AreaLight const&) {}, // by the objects that it lets shine
                   },
                   scene_.lights[size_t(id.index)]);
    }
    add_area_lights(list);
    link_lights(list);
    world_.lights_ = LightTable(std::move(list), world_);
    world_.lights_.commit_lamps(world_.device_);
}

} // namespace weft::world
