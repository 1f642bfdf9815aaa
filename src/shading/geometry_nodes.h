// What the nodes of scene/nodes_geometry.h compute.
#pragma once

#include "base/frame.h"
#include "base/hash.h"
#include "scene/nodes_geometry.h"
#include "shading/color_nodes.h"

namespace weft::shading {

/// Unit, or 0 where the map makes it so.
inline Vec3 unit_or_zero(Vec3 const& v) {
    float const l = length(v);
    return l > 0 ? v * (1 / l) : Vec3(0);
}

inline Vec3 object_normal(SurfacePoint const& p) {
    return p.space ? unit_or_zero(p.space->to_world.transposed(p.ns)) : p.ns;
}

inline Vec3 run(PositionOp const& n, NodeContext const& at) {
    return n.space == nodes::Space::world ? at.point.p + n.origin : object_position(at.point);
}
inline Vec3 run(nodes::Normal const& n, NodeContext const& at) {
    return n.space == nodes::Space::world ? at.point.ns : object_normal(at.point);
}
inline Vec3 run(nodes::Tangent const& n, NodeContext const& at) {
    Vec3 const tangent = Frame(at.point.ns, at.point.dpdu).s;
    bool const world = n.space == nodes::Space::world || !at.point.space;
    return world ? tangent : unit_or_zero(at.point.space->to_object.vector(tangent));
}
inline Vec3 run(nodes::Texcoord const&, NodeContext const& at) {
    return {at.point.uv.x, at.point.uv.y, 0};
}

inline Vec3 run(nodes::FacingRatio const& n, NodeContext const& at) {
    float const cosine = std::clamp(dot(at(n.normal), at.point.wo), -1.f, 1.f);
    float const facing = n.faceforward ? std::abs(cosine) : cosine;
    return Vec3(n.invert ? 1 - facing : facing);
}

inline Vec3 run(VertexOp const& n, NodeContext const& at) {
    VertexAttributes const* const attributes = at.point.attributes;
    if (!attributes || !attributes->columns[size_t(n.slot)].values) return n.fallback;
    auto const& column = attributes->columns[size_t(n.slot)];
    Vec2 const b = at.point.barycentric;
    auto const& v = attributes->mesh->triangles[at.point.primitive].v;
    auto channel = [&](int c) {
        float const* const values = column.values + std::min(c, column.components - 1);
        auto of = [&](uint32_t vertex) { return values[vertex * size_t(column.components)]; };
        return image::decoded(n.transfer,
                              of(v[0]) * (1 - b.x - b.y) + of(v[1]) * b.x + of(v[2]) * b.y);
    };
    Vec3 const x(channel(0), channel(1), channel(2));
    return n.is_number && column.components == 3 ? Vec3(average(to_color(x))) : x;
}

inline Vec3 run(nodes::InstanceRandom const& n, NodeContext const& at) {
    return Vec3(to_unit_float(hash_combine(at.point.object, uint32_t(n.seed))));
}

inline Vec3 run(nodes::NormalMap const& n, NodeContext const& at) {
    Vec3 const normal = at(n.normal), c = at(n.in);
    float const scale = at(n.scale);
    float const up = n.handedness == nodes::Handedness::opengl ? 1.f : -1.f;
    Vec3 const mapped =
        tangent_frame(at.point, normal)
            .to_world({scale * (2 * c.x - 1), scale * up * (2 * c.y - 1), 2 * c.z - 1});
    return length_squared(mapped) > 0 ? normalize(mapped) : normal;
}

} // namespace weft::shading
