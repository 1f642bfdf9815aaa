// The part of LightBuilder that makes lights: those without a surface here, emissive objects in
// build_area_lights.cpp, what is all around in build_environment.cpp.
#include "lights/light_builder.h"

namespace weft::lights {

Color LightBuilder::brightness(scene::Input<Color> const& input, std::string const& title) {
    if (!input.texture) return input.value;
    SourceLocation const where = location_of(scene_, input.texture);
    textures_.prepare(compiler_, input.texture, where);
    if (textures_.needs(input.texture) != shading::Needs::nothing)
        throw InputError(where, title + " expects one color, found nodes that vary from point to "
                                        "point");
    return textures_.radiance(input, Vec2(0));
}

void LightBuilder::add_lamp(Lamp lamp, float power, scene::LightControls const& controls) {
    auto const where = bounds_of(lamp.luminaire);
    list_.add_lamp(std::move(lamp), where, power, controls);
}

void LightBuilder::add_light(scene::PointLight const& light, SourceLocation const&) {
    std::string const of = " of <light type=\"point\">";
    Color const scale = scene::scale_of(light.color, light.unit);
    Color const power = brightness(light.power, "'power'" + of) * scale,
                intensity = brightness(light.intensity, "'intensity'" + of) * scale;
    PointLight const point{light.position, power / (4 * kPi) + intensity};
    add_lamp({make_luminaire(point, light.radius), {}}, luminance(power + intensity * (4 * kPi)),
             light.controls);
}

void LightBuilder::add_light(scene::DirectionalLight const& light, SourceLocation const&) {
    Color const irradiance =
        brightness(light.intensity, "'intensity' of <light type=\"directional\">") *
        scene::scale_of(light.color, light.unit);
    Vec3 const direction = normalize(light.direction);
    float const power = list_.cross_section * luminance(irradiance);
    if (radians(0.5f * light.angle) >= kLeastSunRadius)
        list_.add_lamp(make_sun_disk(direction, radians(0.5f * light.angle), irradiance),
                       at_infinity(), power, light.controls);
    else
        list_.add_lamp(DirectionalLight{direction, irradiance}, at_infinity(), power,
                       light.controls);
}

std::pair<std::optional<Gobo>, float> LightBuilder::make_gobo(scene::SpotLight const& light,
                                                              SpotLight const& spot) {
    if (!light.gobo.texture) return {std::nullopt, 1.f};
    SourceLocation const where = location_of(scene_, light.gobo.texture);
    textures_.prepare(compiler_, light.gobo.texture, where);
    if (!within(textures_.needs(light.gobo.texture), shading::Needs::uv))
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
        sum += weight * double(luminance(textures_.radiance(light.gobo, uv)));
        all += weight;
    }
    return {std::move(gobo), all > 0 ? float(sum / all) : 1.f};
}

void LightBuilder::add_light(scene::SpotLight const& light, SourceLocation const&) {
    std::string const of = " of <light type=\"spot\">";
    SpotLight spot{light.position,
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
    add_lamp({make_luminaire(spot, light.radius), std::move(gobo)},
             passed * luminance(spot.power()), light.controls);
}

void LightBuilder::add_light(scene::IesLight const& light, SourceLocation const&) {
    Color const tint = brightness(light.tint, "'tint' of <light type=\"ies\">");
    PhotometricLight const lamp{light.position, lamp_frame(normalize(light.direction), light.c0),
                                tint * scene::scale_of(light.color, scene::LightUnit::photometric),
                                scene_.photometries[size_t(light.filename.resource)]};
    add_lamp({make_luminaire(lamp, light.radius), {}}, luminance(lamp.power()), light.controls);
}

void LightBuilder::link_lights() {
    for (size_t i = 0; i < list_.kinds.size(); ++i) {
        LightRules& rules = list_.rules[i];
        LightInfo const& info = list_.infos[i];
        SourceLocation const where = location_of(scene_, scene::LightId{info.source});
        rules.lit = world_.sets().find(info.controls.illuminates, "illuminates", where);
        if (world::Links const by =
                world_.sets().find(info.controls.shadowed_by, "shadowedBy", where))
            if (rules.shadow_mask != 0) rules.shadow_mask = world_.shadow_mask(by);
        if (auto const* area = std::get_if<AreaLight>(&list_.kinds[i]))
            for (RayKind kind : kAllRayKinds)
                if (!world::is_visible(world_.model(area->object).traits.visibility, kind))
                    rules.hide_from(kind);
    }
}

LightTable LightBuilder::build() {
    list_.cross_section = kPi * square(std::max(world_.radius(), 1e-6f));
    for (scene::LightId id : scene_.contents.lights) {
        list_.source = id.index;
        match(scene_.lights[size_t(id.index)],
              [&](auto const& light) { add_light(light, location_of(scene_, id)); });
    }
    add_area_lights();
    link_lights();
    return {std::move(list_), std::move(textures_), world_};
}

} // namespace weft::lights
