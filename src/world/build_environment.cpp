// The part of WorldBuilder that makes environments.
#include "world/world_builder.h"

namespace weft::world {

namespace {

using Grid = lights::EnvironmentGrid;

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
Grid brightness(shading::Textures const& textures, scene::Scene const& scene,
                scene::Input<Color> const& map) {
    Vec2i size = map.texture ? textures.resolution(map.texture) : Vec2i(1, 1);
    scene::ImageTexture const* image = plain_image(scene, map);
    bool const exact = !map.texture || (image && size.x <= kMostColumns);
    int const step = (size.x + kMostColumns - 1) / kMostColumns;
    size = Vec2i((size.x + step - 1) / step, (size.y + step - 1) / step);
    bool const nearest = exact && image && image->filter == scene::TextureFilter::nearest;

    Grid grid{nearest || !map.texture ? Grid::Filter::nearest : Grid::Filter::bilinear,
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
                value = luminance(textures.radiance(map, uv));
                continue;
            }
            for (int k = 0; k < 4 * step * step; ++k) {
                Vec2 at(float(k % (2 * step)) + 0.5f, float(k / (2 * step)) + 0.5f);
                at = uv + half_cell * (at / float(step) - Vec2(1));
                at.y = std::clamp(at.y, 0.f, 1.f);
                value += luminance(textures.radiance(map, at)) / float(4 * step * step);
            }
            sum += double(value);
        }
    float const even = kEvenPart * float(sum / double(grid.values.size()));
    for (float& value : grid.values) value += even;
    return grid;
}

/// The linear part of a map between directions, of determinant 1 or -1.
Affine directions_of(Affined const& m) {
    double const s = 1 / std::cbrt(std::abs(m.determinant()));
    return Affine(Affined(m.x * s, m.y * s, m.z * s, Vec3d(0)));
}

} // namespace

void WorldBuilder::prepare_environment(scene::EnvironmentLight const& light,
                                       SourceLocation const& where) {
    world_.textures_.prepare(compiler_, light.texture.texture, where);
    if (!within(world_.textures_.needs(light.texture.texture), shading::Needs::uv))
        throw InputError(where, "'texture' of <light type=\"envmap\"> expects nodes that depend on "
                                "uv alone, found one that depends on a surface");
}

void WorldBuilder::add_light(scene::EnvironmentLight const& light, SourceLocation const& where,
                             LightList& list) {
    prepare_environment(light, where);
    Affine const to_world = directions_of(light.transform);
    lights::EnvironmentSampler sampler(brightness(world_.textures_, scene_, light.texture),
                                       options_.compensate);
    float const power = list.cross_section * sampler.total();
    list.add(EnvironmentLight{light.texture, to_world, to_world.inverse(), std::move(sampler)},
             at_infinity(), power, light.controls);
}

} // namespace weft::world
