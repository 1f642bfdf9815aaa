// What each node computes: `run(instruction, context)` for every instruction of a program.
#pragma once

#include "shading/graph.h"

namespace weft::shading {

struct NodeContext {
    SurfacePoint const& point;
    Values const& values;
    Program const& program;

    template <class T>
    auto operator()(scene::Input<T> const& in) const {
        return values(in);
    }
    Vec2 operator()(scene::Input<scene::SurfaceUv> const& in) const {
        return in.texture ? values(scene::Input<Vec2>{{}, in.texture}) : point.uv;
    }
};

inline Vec3 to_vector(Color const& c) { return {c.r, c.g, c.b}; }
inline Color to_color(Vec3 const& v) { return {v.x, v.y, v.z}; }

inline Vec3 run(scene::ConstantTexture const& n, NodeContext const&) { return to_vector(n.value); }

inline Vec3 run(MeanOp const& n, NodeContext const& at) { return Vec3(average(at(n.in))); }

inline Vec3 run(ImageOp const& n, NodeContext const& at) {
    // How a network stretches uvs is not followed: behind one, images are read at their finest.
    return to_vector(
        n.lookup.at(at(n.texcoord), n.texcoord.texture ? UvFootprint{} : at.point.footprint));
}

inline Vec3 run(scene::Checkerboard const& n, NodeContext const& at) {
    Vec2 const uv = at(n.texcoord), scale = at(n.scale);
    float const cell = std::floor(uv.x * scale.x) + std::floor(uv.y * scale.y);
    return to_vector(std::fmod(cell, 2.f) == 0 ? at(n.color0) : at(n.color1));
}

} // namespace weft::shading
