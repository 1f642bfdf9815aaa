// The part of LightBuilder that makes environments and skies.
#include "lights/light_builder.h"
#include "lights/solar_position.h"

namespace weft::lights {

namespace {

using Grid = EnvironmentGrid;

/// Larger maps are sampled by the means over several of their texels.
constexpr int kMostColumns = 8192;
/// Of the light that is sampled evenly, where the grid only resembles what is looked up.
constexpr float kEvenPart = 0.02f;

/// The image that a map is, looked up at the map's own uv; null where it is anything else.
scene::ImageTexture const* plain_image(scene::Scene const& scene, scene::Input<Color> const& map) {
    if (!map.texture) return nullptr;
    auto const* image =
        std::get_if<scene::ImageTexture>(&scene.textures[size_t(map.texture.index)]);
    bool const tiles = image && image->filename.path.find(scene::kUdim) != std::string::npos;
    return image && !image->texcoord.texture && !tiles ? image : nullptr;
}

/// How bright `map` is, as far as sampling wants to know. An image alone is known texel by texel.
/// Networks are looked up at four places per texel; as something may be between them, and larger
/// images are taken as networks, everything else is sampled a little as well.
/// `image`: as of `plain_image`.
Grid brightness_of(NetworkMap const& map, scene::ImageTexture const* image) {
    Vec2i size = resolution(map.program);
    bool const constant = map.program.result.reg < 0;
    bool const exact = constant || (image && size.x <= kMostColumns);
    int const step = (size.x + kMostColumns - 1) / kMostColumns;
    size = Vec2i((size.x + step - 1) / step, (size.y + step - 1) / step);
    bool const nearest = exact && image && image->filter == scene::TextureFilter::nearest;

    Grid grid{nearest || constant ? Grid::Filter::nearest : Grid::Filter::bilinear,
              uint32_t(size.x),
              uint32_t(size.y),
              {}};
    grid.values.resize(size_t(grid.width) * grid.rows());
    Vec2 const half_cell(0.5f / float(size.x), 0.5f / float(size.y));
    double sum = 0;
    for (uint32_t y = 0; y < grid.rows(); ++y)
        for (uint32_t x = 0; x < grid.width; ++x) {
            Vec2 const uv = grid.uv(x, y);
            float& value = grid.values[size_t(y) * grid.width + x];
            if (exact) {
                value = luminance(map.at(uv));
                continue;
            }
            for (int k = 0; k < 4 * step * step; ++k) {
                Vec2 at(float(k % (2 * step)) + 0.5f, float(k / (2 * step)) + 0.5f);
                at = uv + half_cell * (at / float(step) - Vec2(1));
                at.y = std::clamp(at.y, 0.f, 1.f);
                value += luminance(map.at(at)) / float(4 * step * step);
            }
            sum += double(value);
        }
    float const even = kEvenPart * float(sum / double(grid.values.size()));
    for (float& value : grid.values) value += even;
    return grid;
}

/// A sky, texel by texel, without noise around the sun: half a degree is finer than it varies.
constexpr Vec2i kSkySize(768, 384);

Grid brightness_of(SkyTable const& sky) {
    Grid grid{Grid::Filter::bilinear, uint32_t(sky.width), uint32_t(sky.height), {}};
    for (uint32_t y = 0; y < grid.rows(); ++y)
        for (uint32_t x = 0; x < grid.width; ++x)
            grid.values.push_back(luminance(sky.at(grid.uv(x, y))));
    return grid;
}

/// The linear part of a map between directions, of determinant 1 or -1.
Affine directions_of(Affined const& m) {
    double const s = 1 / std::cbrt(std::abs(m.determinant()));
    return Affine(Affined(m.x * s, m.y * s, m.z * s, Vec3d(0)));
}

Portal portal_of(scene::Portal const& portal) {
    Affined const& m = portal.transform;
    Vec3d const n = normalize(cross(m.x, m.y));
    Vec3d const inwards = dot(n, m.z) > 0 ? n : -n;
    return {Vec3(m.origin), Vec3(normalize(m.x)), Vec3(normalize(m.y)),
            Vec3(-inwards), float(length(m.x)),   float(length(m.y))};
}

/// The part of samples over the whole sphere where portals are seen and nothing but light sampling
/// finds light.
constexpr float kWholePart = 0.125f;
constexpr uint32_t kPortalCells = 512; ///< along either axis
/// Of a portal's light that is looked for where its map, as it was looked up, is dark.
constexpr float kEvenPortalPart = 0.01f;

/// Where the sun is, in the space of its light.
Vec3 sun_direction(scene::SkyLight const& light) {
    double elevation = double(radians(light.elevation)), azimuth = double(radians(light.azimuth));
    if (auto const date = scene::parse_date(light.date)) {
        auto const p = solar_position(date->year, date->month, date->day, double(light.time),
                                      double(light.time_zone), double(radians(light.latitude)),
                                      double(radians(light.longitude)));
        elevation = p.elevation;
        azimuth = p.azimuth;
    } else if (length_squared(light.direction) > 0) {
        return normalize(light.direction);
    }
    double const r = std::cos(elevation);
    return Vec3(Vec3d(r * std::sin(azimuth), std::sin(elevation), -r * std::cos(azimuth)));
}

} // namespace

NetworkMap LightBuilder::make_map(scene::EnvironmentLight const& light,
                                  SourceLocation const& where) {
    NetworkMap map;
    map.tint = scene::scale_of(light.color, light.unit);
    Color const& constant = light.texture.value;
    map.program.result.value = {constant.r, constant.g, constant.b};
    if (light.texture.texture) map.program = map_compiler_.compile(light.texture.texture, where);
    if (!within(map.program.needs, shading::Needs::uv))
        throw InputError(where, "'texture' of <light type=\"envmap\"> expects nodes that depend on "
                                "uv alone, found one that depends on a surface");
    return map;
}

bool LightBuilder::is_compensated(scene::LightControls const& controls) const {
    // What shadow catchers catch is found by light sampling alone, too.
    bool const caught = std::any_of(world_.models().begin(), world_.models().end(),
                                    [](world::Model const& m) { return m.traits.shadow_catcher; });
    return compensate_ && !caught && !is_sampled_alone(controls);
}

void LightBuilder::add_environment(EnvironmentLight light, std::span<scene::PortalId const> portals,
                                   scene::LightControls const& controls) {
    light.to_map = light.to_world.inverse();
    std::vector<PortalMap> maps;
    auto const brightness_at = [&](Vec3 const& d) { return luminance(light.radiance(d)); };
    float const even = kEvenPortalPart * light.sampler.total() / (4 * kPi);
    uint32_t const lookups = std::min(light.sampler.columns() / (2 * kPortalCells) + 1, 8u);
    for (scene::PortalId id : portals)
        maps.emplace_back(portal_of(scene_.portals[size_t(id.index)]), kPortalCells, lookups, even,
                          brightness_at);
    light.portals = PortalSampler(std::move(maps));
    light.whole = is_compensated(controls) ? 0 : kWholePart;
    float const power = list_.cross_section * light.sampler.total();
    list_.add(std::move(light), at_infinity(), power, controls);
}

void LightBuilder::add_light(scene::EnvironmentLight const& light, SourceLocation const& where) {
    NetworkMap map = make_map(light, where);
    EnvironmentSampler sampler(brightness_of(map, plain_image(scene_, light.texture)),
                               is_compensated(light.controls));
    add_environment({std::move(map), directions_of(light.transform), {}, std::move(sampler), {}},
                    light.portals, light.controls);
}

void LightBuilder::add_light(scene::SkyLight const& light, SourceLocation const&) {
    Vec3 const sun = sun_direction(light);
    SkyTable table = make_sky_table(
        {sun, light.turbidity, light.ground, light.sky_intensity, light.sun_intensity}, kSkySize.x,
        kSkySize.y);
    EnvironmentSampler sampler(brightness_of(table), is_compensated(light.controls));
    Affine const to_world = directions_of(light.transform);
    add_environment({std::move(table), to_world, {}, std::move(sampler), {}}, light.portals,
                    light.controls);

    Color const irradiance =
        sun_irradiance(double(light.turbidity), std::asin(std::clamp(double(sun.y), -1., 1.))) *
        light.sun_intensity;
    if (is_black(irradiance)) return;
    list_.add(make_sun_disk(normalize(to_world.vector(sun)),
                            radians(0.5f * kSunDiameter * light.sun_size), irradiance, kSunLimb),
              at_infinity(), list_.cross_section * luminance(irradiance), light.controls);
}

} // namespace weft::lights
