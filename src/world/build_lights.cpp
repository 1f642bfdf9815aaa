// The half of WorldBuilder that makes lights.
#include "base/warp.h"
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
                                     scene::Input<Color> const& input, Vec2i size) {
    std::vector<float> values(size_t(size.x) * size_t(size.y)), cells(values.size());
    auto at = [&](int x, int y) -> float& {
        return values[size_t(y) * size_t(size.x) + size_t(x)];
    };
    for (int y = 0; y < size.y; ++y)
        for (int x = 0; x < size.x; ++x) {
            Vec2 const uv((float(x) + 0.5f) / float(size.x), (float(y) + 0.5f) / float(size.y));
            at(x, y) = luminance(textures.radiance(input, uv));
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

/// Whether the triangle is wound clockwise about its vertex normals, which say where the front is.
bool is_wound_inwards(TriangleData const& data, scene::Mesh::Triangle const& t) {
    auto const& [a, b, c] = t.v;
    if (!data.smooth) return false;
    Vertex const &va = data.vertices[a], &vb = data.vertices[b], &vc = data.vertices[c];
    Vec3 const normal = cross(vb.p - va.p, vc.p - va.p);
    return (dot(normal, va.n + vb.n + vc.n) < 0) != data.mirrored;
}

} // namespace

float WorldBuilder::mean_luminance(AreaLight const& light) const {
    shading::Emission const& input = light.emission;
    if (!input.color.texture && !input.strength.texture)
        return luminance(input.color.value * input.strength.value);
    constexpr int n = 32;
    double sum = 0;
    for (int i = 0; i < n * n; ++i) {
        Vec2 const uv((float(i % n) + 0.5f) / n, (float(i / n) + 0.5f) / n);
        if (light.uv_alone) {
            sum += luminance(world_.textures_.radiance(input, uv));
            continue;
        }
        // Points of the surface, as seen from some place that sees them.
        Object const& object = world_.objects_[light.object];
        Vec3 const local = lights::uv_to_direction(uv);
        Vec2 const b = square_to_triangle(uv);
        Hit hit{0, light.object, 0, b.x, b.y};
        if (object.triangles >= 0) {
            auto const& source = world_.triangles_[size_t(object.triangles)].source;
            hit.primitive = uint32_t(size_t(i) * source->triangles.size() / (n * n));
        }
        auto point = world_.point_on(hit, local, Vec3(0, 0, 1));
        point.wo = point.ng;
        sum += luminance(world_.textures_.radiance(input, point));
    }
    return float(sum / (n * n));
}

void WorldBuilder::add_area_lights(std::vector<Light>& lights,
                                   std::vector<lights::LightBounds>& bounds) {
    for (auto const& [index, weight] : area_objects_) {
        Object& object = world_.objects_[index];
        auto make = [&]() -> lights::Emitter {
            if (object.kind == ObjectKind::Sphere) return lights::SphereEmitter(object.to_world);
            TriangleData const& data = world_.triangles_[size_t(object.triangles)];
            if (data.source == rectangle_) return lights::RectangleEmitter(object.to_world);
            std::vector<Vec3> positions;
            for (Vertex const& v : data.vertices)
                positions.push_back(object.instanced ? object.to_world.point(v.p) : v.p);
            std::vector<lights::MeshEmitter::Triangle> triangles;
            std::vector<bool> turned;
            for (auto const& t : data.source->triangles) {
                triangles.push_back({t.v[0], t.v[1], t.v[2]});
                turned.push_back(is_wound_inwards(data, t));
            }
            return lights::MeshEmitter(std::move(positions), std::move(triangles), data.source->uvs,
                                       object.to_world.determinant() < 0, std::move(turned));
        };
        bool const uv_alone =
            within(world_.textures_.needs(object.emission) | world_.textures_.needs(object.opacity),
                   shading::Needs::uv);
        AreaLight light{make(), object.emission, object.opacity, 0, index, uv_alone};
        float const area = match(light.emitter, [](auto const& e) { return e.area(); });
        light.extent = std::sqrt(area);
        object.light = int32_t(lights.size());
        bounds.push_back(match(light.emitter, [](auto const& e) { return lights::bounds_of(e); }));
        bounds.back().power = weight * kPi * area * mean_luminance(light);
        lights.emplace_back(std::move(light));
    }
}

void WorldBuilder::prepare_environment(scene::EnvironmentLight const& light,
                                       SourceLocation const& where) {
    world_.textures_.prepare(compiler_, light.texture.texture, where);
    if (!within(world_.textures_.needs(light.texture.texture), shading::Needs::uv))
        throw InputError(where, "'texture' of <light type=\"envmap\"> expects nodes that depend on "
                                "uv alone, found one that depends on a surface");
}

void WorldBuilder::build_lights() {
    RTCBounds box;
    rtcGetSceneBounds(world_.embree_scene_, &box);
    Vec3 const extent(box.upper_x - box.lower_x, box.upper_y - box.lower_y,
                      box.upper_z - box.lower_z);
    float const radius = is_finite(extent) && extent.x >= 0 ? 0.5f * length(extent) : 1;
    float const cross_section = kPi * square(std::max(radius, 1e-6f));

    std::vector<Light> lights;
    std::vector<lights::LightBounds> bounds;
    lights::LightBounds far_away;
    far_away.at_infinity = true;
    auto add = [&](Light light, lights::LightBounds where, float power) {
        lights.push_back(std::move(light));
        bounds.push_back(where);
        bounds.back().power = power;
    };
    for (scene::LightId id : scene_.contents.lights) {
        std::visit(
            Overloaded{
                [&](scene::PointLight const& l) {
                    lights::PointLight const point{l.position, l.power / (4 * kPi)};
                    add(point, lights::bounds_of(point), l.weight * luminance(l.power));
                },
                [&](scene::DirectionalLight const& l) {
                    add(lights::DirectionalLight{normalize(l.direction), l.intensity}, far_away,
                        l.weight * (cross_section * luminance(l.intensity)));
                },
                [&](scene::SpotLight const& l) {
                    lights::SpotLight const spot{l.position, normalize(l.direction), l.intensity,
                                                 radians(l.angle), radians(l.falloff)};
                    add(spot, lights::bounds_of(spot), l.weight * luminance(spot.power()));
                },
                [&](scene::EnvironmentLight const& l) {
                    prepare_environment(l, scene_.light_locations[size_t(id.index)]);
                    Affine const to_world = rotation_of(l.transform);
                    Vec2i const size = l.texture.texture
                                           ? world_.textures_.resolution(l.texture.texture)
                                           : Vec2i(1, 1);
                    auto const cells = environment_cells(world_.textures_, l.texture, size);
                    lights::EnvironmentSampler sampler(cells, uint32_t(size.x), uint32_t(size.y));
                    float const power = l.weight * (cross_section * sampler.total());
                    add(EnvironmentLight{l.texture, to_world, to_world.inverse(),
                                         std::move(sampler)},
                        far_away, power);
                },
                [](scene::AreaLight const&) {},
            },
            scene_.lights[size_t(id.index)]);
    }
    add_area_lights(lights, bounds);
    world_.lights_ = LightTable(std::move(lights), bounds, world_);
}

} // namespace weft::world
