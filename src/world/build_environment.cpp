// The part of WorldBuilder that makes environments.
#include "world/world_builder.h"

namespace weft::world {

namespace {

/// A rotation: the map's axes of length 1, without translation.
Affine rotation_of(Affined const& m) {
    return Affine(Affined(normalize(m.x), normalize(m.y), normalize(m.z), Vec3d(0)));
}

/// For each cell of a lat-long grid the mean luminance over the footprint of the bilinear filter:
/// positive wherever a lookup in the cell can be, so that no light goes unsampled.
std::vector<float> environment_cells(shading::Textures const& textures,
                                     scene::Input<Color> const& input, Color const& tint,
                                     Vec2i size) {
    std::vector<float> values(size_t(size.x) * size_t(size.y)), cells(values.size());
    auto at = [&](int x, int y) -> float& {
        return values[size_t(y) * size_t(size.x) + size_t(x)];
    };
    for (int y = 0; y < size.y; ++y)
        for (int x = 0; x < size.x; ++x) {
            Vec2 const uv((float(x) + 0.5f) / float(size.x), (float(y) + 0.5f) / float(size.y));
            at(x, y) = luminance(textures.radiance(input, uv) * tint);
        }
    for (int y = 0; y < size.y; ++y)
        for (int x = 0; x < size.x; ++x) {
            float sum = 0, weight = 0;
            for (int j = std::max(y - 1, 0); j <= std::min(y + 1, size.y - 1); ++j)
                for (int i = -1; i <= 1; ++i) {
                    float const w = (j == y ? 2.f : 1.f) * (i == 0 ? 2.f : 1.f);
                    sum += w * at((x + i + size.x) % size.x, j);
                    weight += w;
                }
            cells[size_t(y) * size_t(size.x) + size_t(x)] = sum / weight;
        }
    return cells;
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
    Affine const to_world = rotation_of(light.transform);
    Color const tint = scene::scale_of(light.color, light.unit);
    Vec2i const size =
        light.texture.texture ? world_.textures_.resolution(light.texture.texture) : Vec2i(1, 1);
    auto const cells = environment_cells(world_.textures_, light.texture, tint, size);
    lights::EnvironmentSampler sampler(cells, uint32_t(size.x), uint32_t(size.y));
    float const power = list.cross_section * sampler.total();
    list.add(
        EnvironmentLight{light.texture, to_world, to_world.inverse(), std::move(sampler), tint},
        at_infinity(), power, light.controls);
}

} // namespace weft::world
