// What the function of a node can read: the point, and the registers written so far.
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
    Vec3 operator()(scene::Input<scene::SurfacePosition> const& in) const {
        return in.texture ? values(scene::Input<Vec3>{{}, in.texture}) : object_position(point);
    }
    Vec3 operator()(scene::Input<scene::SurfaceNormal> const& in) const {
        return in.texture ? values(scene::Input<Vec3>{{}, in.texture}) : point.ns;
    }
};

inline Vec3 to_vector(Color const& c) { return {c.r, c.g, c.b}; }
inline Color to_color(Vec3 const& v) { return {v.x, v.y, v.z}; }

} // namespace weft::shading
