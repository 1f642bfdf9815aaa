// What each node computes: `run(instruction, context)` for every instruction of a program.
#pragma once

#include "shading/geometry_nodes.h"
#include "shading/procedural_nodes.h"

namespace weft::shading {

inline Vec3 run(scene::ConstantTexture const& n, NodeContext const&) { return to_vector(n.value); }

inline Vec3 run(MeanOp const& n, NodeContext const& at) { return Vec3(average(at(n.in))); }

inline Vec3 run(LimitOp const& n, NodeContext const& at) {
    return each([&](float x) { return std::min(std::max(x, n.min), n.max); }, at(n.in));
}

inline Vec3 run(FlattenOp const& n, NodeContext const& at) {
    Vec3 const v = at(n.in);
    return {v.x, v.y, 0};
}

inline Vec3 run(ImageOp const& n, NodeContext const& at) {
    return to_vector(n.lookup.at(at(n.texcoord)));
}

inline Vec3 run(UdimOp const& n, NodeContext const& at) {
    Vec2 const uv = at(n.texcoord);
    float const u = std::floor(uv.x), v = std::floor(uv.y);
    if (!(u >= 0 && u < 10 && v >= 0 && v < 10)) return Vec3(0);
    int const tile = n.tile[size_t(u) + 10 * size_t(v)];
    return tile > 0 ? to_vector(n.lookups[size_t(tile) - 1].at(uv - Vec2(u, v))) : Vec3(0);
}

inline Vec3 run(scene::Checkerboard const& n, NodeContext const& at) {
    Vec2 const uv = at(n.texcoord), scale = at(n.scale);
    float const cell = std::floor(uv.x * scale.x) + std::floor(uv.y * scale.y);
    return to_vector(std::fmod(cell, 2.f) == 0 ? at(n.color0) : at(n.color1));
}

/// Bump and triplanar projection run programs of their own (projections.cpp).
Vec3 run(BumpOp const& n, NodeContext const& at);
Vec3 run(TriplanarOp const& n, NodeContext const& at);

} // namespace weft::shading
