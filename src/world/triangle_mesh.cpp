// All that is special about triangle meshes.
#include "world/geometry.h"

namespace weft::world {

namespace {

Vec2 interpolated_uv(Vertex const& a, Vertex const& b, Vertex const& c, Hit const& hit) {
    float const w = 1 - hit.u - hit.v;
    return {a.u * w + b.u * hit.u + c.u * hit.v, a.v * w + b.v * hit.u + c.v * hit.v};
}

/// How two numbers grow over a triangle that grow by `d1` and `d2` along its edges. (The gradient
/// of a barycentric coordinate is perpendicular to the opposite edge.)
UvGradients triangle_gradients(Vec3 const& e1, Vec3 const& e2, Vec2 d1, Vec2 d2) {
    Vec3 const n = cross(e1, e2);
    float const area = length_squared(n);
    if (!(area > 0)) return {};
    Vec3 const b1 = cross(e2, n) * (1 / area), b2 = cross(n, e1) * (1 / area);
    return {b1 * d1.x + b2 * d2.x, b1 * d1.y + b2 * d2.y};
}

/// Returns the way from p = `point.p`, in the mesh's own space, to the smooth surface on wo's side:
/// the mean, by p's barycentric coordinates, of the ways out to the tangent planes at the vertices
/// (Hanika 2021, "Hacking the shadow terminator"). 0 where that surface is not seen from its front.
Vec3 lift(std::array<Vertex, 3> const& v, Vec3 const& weights, Vec3 const& p,
          shading::SurfacePoint const& s) {
    float const side = dot(s.ng, s.wo) > 0 ? 1.f : -1.f;
    if (!(side * dot(s.ns, s.wo) > 0)) return Vec3(0);
    Vec3 sum(0);
    for (size_t i = 0; i < 3; ++i) {
        Vec3 const& n = v[i].n; // of any length
        float const below = std::min(side * dot(p - v[i].p, n), 0.f);
        if (below < 0) sum -= n * (side * below * weights[int(i)] / length_squared(n));
    }
    return sum;
}

} // namespace

void point_on(TriangleMesh const& mesh, Contact const& contact, shading::SurfacePoint& point) {
    MeshData const& data = *mesh.data;
    Hit const& hit = contact.hit;
    auto const& v = mesh.triangles[hit.primitive].v;
    Vertex const &a = mesh.vertices[v[0]], &b = mesh.vertices[v[1]], &c = mesh.vertices[v[2]];
    Vec3 const e1 = b.p - a.p, e2 = c.p - a.p;
    float const w = 1 - hit.u - hit.v;
    point.p = a.p * w + b.p * hit.u + c.p * hit.v;
    point.p_error = max(max(abs(a.p), abs(b.p)), abs(c.p));
    Vec3 normal = cross(e1, e2);
    if (data.mirrored) normal = -normal;
    if (data.smooth) point.ns = a.n * w + b.n * hit.u + c.n * hit.v;
    point.uv = data.has_uvs ? interpolated_uv(a, b, c, hit) : Vec2(hit.u, hit.v);
    point.barycentric = {hit.u, hit.v};
    point.attributes = &data.attributes;
    if (contact.tangents && data.has_uvs) {
        Vec2 const d1(b.u - a.u, b.v - a.v), d2(c.u - a.u, c.v - a.v);
        float const determinant = d1.x * d2.y - d1.y * d2.x;
        if (determinant != 0) {
            point.dpdu = (e1 * d2.y - e2 * d1.y) * (1 / determinant);
            point.dpdv = (e2 * d1.x - e1 * d2.x) * (1 / determinant);
        }
    }
    Vec3 const p = point.p;
    if (contact.space) {
        auto const& [to_world, to_object] = *contact.space;
        normal = to_object.transposed(normal);
        if (data.smooth) point.ns = to_object.transposed(point.ns);
        point.dpdu = to_world.vector(point.dpdu);
        point.dpdv = to_world.vector(point.dpdv);
        point.p = to_world.point(point.p);
        point.p_error = absolute_vector(to_world, point.p_error) + abs(to_world.origin);
    }
    point.p_error *= kRounding;
    point.ng = normalize(normal);
    if (!data.smooth) {
        point.ns = point.ng;
    } else {
        point.ns = normalize(point.ns);
        // The vertex normals say which side is the front, whatever the winding.
        if (dot(point.ng, point.ns) < 0) point.ng = -point.ng;
        if (contact.lifts) {
            point.lift = lift({a, b, c}, {w, hit.u, hit.v}, p, point);
            if (contact.space) point.lift = contact.space->to_world.vector(point.lift);
        }
    }
}

Vec2 uv_at(TriangleMesh const& mesh, Hit const& hit, Vec3 const&) {
    if (!mesh.data->has_uvs) return {hit.u, hit.v};
    auto const& v = mesh.triangles[hit.primitive].v;
    return interpolated_uv(mesh.vertices[v[0]], mesh.vertices[v[1]], mesh.vertices[v[2]], hit);
}

UvGradients uv_gradients(TriangleMesh const& mesh, Contact const& contact,
                         shading::SurfacePoint const&) {
    auto const& v = mesh.triangles[contact.hit.primitive].v;
    Vertex const &a = mesh.vertices[v[0]], &b = mesh.vertices[v[1]], &c = mesh.vertices[v[2]];
    bool const mapped = mesh.data->has_uvs;
    UvGradients const g =
        triangle_gradients(b.p - a.p, c.p - a.p, mapped ? Vec2(b.u - a.u, b.v - a.v) : Vec2(1, 0),
                           mapped ? Vec2(c.u - a.u, c.v - a.v) : Vec2(0, 1));
    if (!contact.space) return g;
    Affine const& to_object = contact.space->to_object;
    return {to_object.transposed(g.u), to_object.transposed(g.v)};
}

void nearest(TriangleMesh const& mesh, Vec3 const& local, Hit& hit) {
    auto place = [&](uint32_t triangle) {
        auto const& v = mesh.triangles[triangle].v;
        Vec3 const &a = mesh.vertices[v[0]].p, e1 = mesh.vertices[v[1]].p - a,
                   e2 = mesh.vertices[v[2]].p - a, n = cross(e1, e2), d = local - a;
        float const scale = 1 / length_squared(n);
        hit.primitive = triangle;
        hit.u = dot(cross(d, e2), n) * scale;
        hit.v = dot(cross(e1, d), n) * scale;
    };
    place(hit.primitive);
    if (mesh.data->is_rectangle && hit.u < 0) place(1);
}

/// By the divergence theorem: of a closed surface the sum of areas as vectors is 0, and that of
/// p . area / 3 is the volume.
Enclosure enclosure(TriangleMesh const& mesh, Affined const& to_world) {
    Enclosure e;
    MeshData const& data = *mesh.data;
    if (data.vertices.empty()) return e;
    Vec3d areas(0);
    double total = 0;
    Vec3d const reference = to_world.point(Vec3d(data.vertices[0].p));
    for (auto const& t : data.source->triangles) {
        Vec3d corner[3];
        for (int i = 0; i < 3; ++i) {
            Vec3d const p = to_world.point(Vec3d(data.vertices[t.v[i]].p));
            e.grow(p);
            corner[i] = p - reference;
        }
        Vec3d const area = cross(corner[1] - corner[0], corner[2] - corner[0]);
        areas = areas + area;
        total += length(area);
        e.volume += dot(corner[0], area) / 6;
    }
    e.volume = std::abs(e.volume);
    e.closed = length(areas) <= 1e-3 * total;
    return e;
}

bool keeps_kind(TriangleMesh const&, Affined const&) { return true; }

RTCGeometry make_kernel_geometry(TriangleMesh const& mesh, RTCDevice device, Affine const&) {
    RTCGeometry const geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
    MeshData const& data = *mesh.data;
    auto const& indices = data.source->triangles;
    rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                               data.vertices.data(), offsetof(Vertex, p), sizeof(Vertex),
                               data.vertices.size());
    rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, indices.data(),
                               0, sizeof(scene::Mesh::Triangle), indices.size());
    return geometry;
}

bool has_corners(TriangleMesh const& mesh, uint32_t a, Corners corners, uint32_t b) {
    auto const& of_a = mesh.triangles[a].v;
    auto const& of_b = mesh.triangles[b].v;
    auto is_of_b = [&](uint32_t v) {
        return std::any_of(std::begin(of_b), std::end(of_b), [&](uint32_t w) {
            return v == w || mesh.vertices[v].p == mesh.vertices[w].p;
        });
    };
    for (int k = 0; k < 3; ++k)
        if (corners & (1 << k) && !is_of_b(of_a[k])) return false;
    return true;
}

} // namespace weft::world
