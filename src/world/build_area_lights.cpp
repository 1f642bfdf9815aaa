// The part of WorldBuilder that makes lights of emissive objects.
#include "base/warp.h"
#include "world/world_builder.h"

namespace weft::world {

namespace {

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
        return luminance(input.color.value * input.tint * input.strength.value);
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

void WorldBuilder::add_area_lights(LightList& list) {
    for (auto const& [index, scene_light] : area_objects_) {
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
        object.light = int32_t(list.lights.size());
        lights::LightBounds const bounds =
            match(light.emitter, [](auto const& e) { return lights::bounds_of(e); });
        float const power = kPi * area * mean_luminance(light);
        auto const& from = std::get<scene::AreaLight>(scene_.lights[size_t(scene_light.index)]);
        list.where = scene_.light_locations[size_t(scene_light.index)];
        list.add(std::move(light), bounds, power, from.controls);
    }
}

} // namespace weft::world
