// The nodes that run programs at points other than their own.
#include "shading/node_functions.h"

namespace weft::shading {

namespace {

/// How uv changes along unit `d` in the tangent plane: the least squares solution of
/// (dpdu dpdv) duv = d; 0 where there are no uvs.
Vec2 uv_change(SurfacePoint const& p, Vec3 const& d) {
    float const uu = dot(p.dpdu, p.dpdu), uv = dot(p.dpdu, p.dpdv), vv = dot(p.dpdv, p.dpdv);
    float const determinant = uu * vv - uv * uv;
    if (!(determinant > 0)) return {0, 0};
    float const du = dot(p.dpdu, d), dv = dot(p.dpdv, d);
    return Vec2(vv * du - uv * dv, uu * dv - uv * du) * (1 / determinant);
}

/// Half the distance over which slopes are measured: a fraction of the uv square (about a texel
/// of a large image) or, without uvs, of the object's unit.
float step_length(SurfacePoint const& p) {
    constexpr float fraction = 5e-4f;
    float const extent = std::sqrt(std::max(length(cross(p.dpdu, p.dpdv)), 0.f));
    if (extent > 0) return fraction * extent;
    return fraction * (p.space ? std::cbrt(std::abs(p.space->to_world.determinant())) : 1.f);
}

} // namespace

/// Blinn 1978, "Simulation of wrinkled surfaces": the slopes along two tangents tilt the normal.
Vec3 run(BumpOp const& n, NodeContext const& at) {
    Vec3 const normal = at(n.normal);
    Program const& height = at.program.parts[size_t(n.part)];
    Frame const frame(normal, at.point.dpdu);
    float const chosen = at(n.step), step = chosen > 0 ? chosen : step_length(at.point);
    auto slope = [&](Vec3 const& tangent) {
        Vec2 const duv = uv_change(at.point, tangent);
        auto height_at = [&](float distance) {
            SurfacePoint moved = at.point;
            moved.p += tangent * distance;
            moved.uv += duv * distance;
            return evaluate(height, moved).x;
        };
        return (height_at(step) - height_at(-step)) / (2 * step);
    };
    float const scale = at(n.scale);
    Vec3 const tilted = normal - (frame.s * slope(frame.s) + frame.t * slope(frame.t)) * scale;
    return normalize(tilted);
}

Vec3 run(TriplanarOp const& n, NodeContext const& at) {
    bool const world = n.position.space == scene::nodes::Space::world;
    Vec3 const p = run(n.position, at) * at(n.scale);
    Vec3 const normal = abs(world ? at.point.ns : object_normal(at.point));
    // From |n| at blend 1 towards the largest axis alone.
    float const exponent = 1 / std::max(at(n.blend), 1e-2f), most = max_component(normal);
    auto share = [&](float x) {
        float const w = std::pow(x / most, exponent);
        return w < 1e-3f ? 0 : w; // not to be seen
    };
    Vec3 weight = each(share, normal);
    weight *= 1 / (weight.x + weight.y + weight.z);
    Program const& pattern = at.program.parts[size_t(n.part)];
    SurfacePoint moved = at.point;
    Vec3 sum(0);
    for (int axis = 0; axis < 3; ++axis) {
        if (weight[axis] == 0) continue;
        moved.uv = axis == 0 ? Vec2(p.y, p.z) : axis == 1 ? Vec2(p.x, p.z) : Vec2(p.x, p.y);
        sum += evaluate(pattern, moved) * weight[axis];
    }
    return sum;
}

} // namespace weft::shading
