// The part of LightBuilder that makes lights of emissive objects, and looks at what they emit: how
// much in all, and where.
#include "base/warp.h"
#include "lights/light_builder.h"

namespace weft::lights {

namespace {

/// Whether the triangle is wound clockwise about its vertex normals, which say where the front is.
bool is_wound_inwards(world::MeshData const& data, scene::Mesh::Triangle const& t) {
    auto const& [a, b, c] = t.v;
    if (!data.smooth) return false;
    world::Vertex const &va = data.vertices[a], &vb = data.vertices[b], &vc = data.vertices[c];
    Vec3 const normal = cross(vb.p - va.p, vc.p - va.p);
    return (dot(normal, va.n + vb.n + vc.n) < 0) != data.mirrored;
}

/// A light in the shape of an object.
struct MakeEmitter {
    world::Model const& model;
    Affine to_world;

    Emitter operator()(world::Sphere const&) const { return SphereEmitter(to_world); }
    Emitter operator()(world::Disk const&) const { return DiskEmitter(to_world); }
    Emitter operator()(world::TriangleMesh const& mesh) const {
        world::MeshData const& data = *mesh.data;
        if (data.is_rectangle) return RectangleEmitter(to_world, model.spread.tangent());
        std::vector<Vec3> positions;
        positions.reserve(data.vertices.size());
        for (world::Vertex const& v : data.vertices)
            positions.push_back(model.in_world_space ? v.p : to_world.point(v.p));
        std::vector<MeshEmitter::Triangle> triangles;
        triangles.reserve(data.source->triangles.size());
        std::vector<bool> turned;
        for (auto const& t : data.source->triangles) {
            triangles.push_back({t.v[0], t.v[1], t.v[2]});
            turned.push_back(is_wound_inwards(data, t));
        }
        return MeshEmitter(std::move(positions), std::move(triangles), data.source->uvs,
                           to_world.determinant() < 0, std::move(turned));
    }
};

/// Looks at what the surface of a light emits, once all that makes lights is committed.
class Surveyor {
  public:
    Surveyor(world::World const& world, AreaLight& light) : world_(world), light_(light) {}

    /// Fills `flux`, one value per primitive, and the light's texture where it is worth it.
    void survey() {
        flux_.assign(match(light_.emitter, [](auto const& e) { return e.primitives(); }), 0);
        match(light_.emitter, [&](auto const& e) { look(e); });
    }
    std::vector<float> const& flux() const { return flux_; }

  private:
    static constexpr int kSide = 256; ///< largest number of cells of a grid on either axis

    bool is_constant() const {
        return !light_.emission.color.texture && !light_.emission.strength.texture &&
               !light_.opacity.instance.texture && !light_.opacity.material.texture;
    }
    /// Luminance that leaves in the direction of the normal, where opacity lets it be seen.
    template <class Place>
    double luminance_at(Place const& place) const {
        shading::Textures const& t = world_.textures();
        return double(luminance(t.radiance(light_.emission, place)) *
                      t.opacity(light_.opacity, place));
    }
    double luminance_at_point(uint32_t primitive, Vec3 const& p) const {
        auto point = world_.point_near(light_.object, primitive, p, Vec3(0, 0, 1));
        point.wo = point.ng;
        return luminance_at(point);
    }

    void look(MeshEmitter const& mesh);
    template <class E>
    void look(E const& emitter);

    world::World const& world_;
    AreaLight& light_;
    std::vector<float> flux_;
};

/// No triangle that may shine is left without power by the few points that are looked at.
void Surveyor::look(MeshEmitter const& mesh) {
    uint32_t const count = mesh.primitives();
    bool const constant = is_constant();
    constexpr uint32_t all_points = 4'000'000;
    uint32_t const points = constant ? 1 : std::clamp(all_points / std::max(count, 1u), 4u, 64u);
    double sum = 0;
    for (uint32_t i = 0; i < count; ++i) {
        float const area = mesh.area(i);
        if (!(area > 0)) continue;
        double mean = 0;
        for (uint32_t k = 0; k < points; ++k) {
            // Hammersley's points: (k + 1/2) / n, and the bits of k mirrored.
            uint32_t bits = 0;
            for (uint32_t b = 0; b < 8; ++b) bits |= (k >> b & 1) << (7 - b);
            Vec2 const u((float(k) + 0.5f) / float(points), (float(bits) + 0.5f) / 256);
            Vec2 const b = square_to_triangle(u);
            mean += light_.uv_alone ? luminance_at(mesh.uv(i, b))
                                    : luminance_at_point(i, mesh.point(i, b));
        }
        flux_[i] = kPi * area * float(mean / points);
        sum += double(flux_[i]);
    }
    if (constant || !(sum > 0)) return;
    constexpr double least_share = 1e-3;
    for (uint32_t i = 0; i < count; ++i)
        flux_[i] =
            std::max(flux_[i], float(least_share * sum * double(mesh.area(i) / mesh.area())));
}

template <class E>
void Surveyor::look(E const& emitter) {
    if (is_constant()) {
        flux_[0] = kPi * emitter.area() * float(luminance_at(Vec2(0)));
        return;
    }
    Vec2i size(64, 64);
    if (light_.uv_alone)
        for (scene::TextureId id :
             {light_.emission.color.texture, light_.emission.strength.texture,
              light_.opacity.instance.texture, light_.opacity.material.texture}) {
            if (!id) continue;
            Vec2i const r = world_.textures().resolution(id);
            size = {std::clamp(r.x, size.x, kSide), std::clamp(r.y, size.y, kSide)};
        }
    Vec3 const outside = emitter.box().high + Vec3(1);
    std::vector<float> cells;
    double area = 0, sum = 0, squares = 0;
    for (int i = 0; i < size.x * size.y; ++i) {
        Vec2 const uv((float(i % size.x) + 0.5f) / float(size.x),
                      (float(i / size.x) + 0.5f) / float(size.y));
        auto const s = emitter.at_uv(outside, uv);
        double const here = s.distance > 0 ? double(emitter.area_by_uv(uv)) / (size.x * size.y) : 0;
        double const l = here == 0         ? 0
                         : light_.uv_alone ? luminance_at(uv)
                                           : luminance_at_point(0, s.p);
        area += here;
        sum += l * here;
        squares += l * l * here;
        cells.push_back(float(l * here));
    }
    if (!(area > 0)) return;
    // The grid covers the edges of disks and ellipsoids but roughly.
    flux_[0] = kPi * emitter.area() * float(sum / area);
    bool const varies = squares * area > 2 * sum * sum; // deviation above the mean
    if (varies && light_.uv_alone)
        light_.texture.emplace(cells, uint32_t(size.x), uint32_t(size.y));
}

} // namespace

AreaLight LightBuilder::make_area_light(uint32_t index) const {
    world::Model const& model = world_.model(index);
    shading::Textures const& textures = world_.textures();
    bool const uv_alone =
        within(textures.needs(model.emission) | textures.needs(model.opacity), shading::Needs::uv);
    AreaLight light{match(model.geometry, MakeEmitter{model, world_.space_of(index).to_world}),
                    model.emission,
                    model.opacity,
                    model.spread,
                    {},
                    0,
                    index,
                    uv_alone};
    light.extent = std::sqrt(match(light.emitter, [](auto const& e) { return e.area(); }));
    return light;
}

void LightBuilder::add_area_lights() {
    std::span<world::AreaObject const> const objects = world_.area_objects();
    for (size_t begin = 0, end; begin < objects.size(); begin = end) {
        // All objects of one light of the scene share its power.
        scene::LightId const id = objects[begin].light;
        list_.source = id.index;
        auto const& from = std::get<scene::AreaLight>(scene_.lights[size_t(id.index)]);
        std::vector<AreaLight> made;
        std::vector<std::vector<float>> flux;
        double sum = 0;
        for (end = begin; end < objects.size() && objects[end].light == id; ++end) {
            made.push_back(make_area_light(objects[end].object));
            Surveyor surveyor(world_, made.back());
            surveyor.survey();
            flux.push_back(surveyor.flux());
            for (float f : flux.back()) sum += double(f);
        }
        float const power = from.unit == scene::LightUnit::photometric
                                ? from.power / scene::kLumensPerWatt
                                : from.power;
        float const scale = power > 0 && sum > 0 ? float(double(power) / sum) : 1;
        for (size_t i = 0; i < made.size(); ++i) {
            world_.scale_emission(made[i].object, scale);
            made[i].emission.tint *= scale;
            std::vector<LightBounds> leaves;
            match(made[i].emitter, [&](auto const& e) {
                for (uint32_t k = 0; k < e.primitives(); ++k) {
                    leaves.push_back(bounds_of(e, k));
                    LightBounds& leaf = leaves.back();
                    leaf.theta_e = std::min(leaf.theta_e, made[i].spread.half_angle());
                    leaf.power = scale * flux[i][k];
                }
            });
            list_.add(std::move(made[i]), leaves, from.controls);
        }
    }
}

} // namespace weft::lights
