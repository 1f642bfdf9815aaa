// What the nodes of scene/nodes_math.h compute.
#pragma once

#include "scene/nodes_math.h"
#include "shading/node_context.h"

namespace weft::shading {

namespace nodes = scene::nodes;

template <class F>
Vec3 each(F const& f, Vec3 const& a) {
    return {f(a.x), f(a.y), f(a.z)};
}
template <class F>
Vec3 each(F const& f, Vec3 const& a, Vec3 const& b) {
    return {f(a.x, b.x), f(a.y, b.y), f(a.z, b.z)};
}

inline float safe_divide(float a, float b) { return b == 0 ? 0 : a / b; }
inline float safe_power(float a, float b) {
    float const p = std::pow(a, b);
    return std::isfinite(p) ? p : 0;
}

inline float apply(nodes::AddOp, float a, float b) { return a + b; }
inline float apply(nodes::SubtractOp, float a, float b) { return a - b; }
inline float apply(nodes::MultiplyOp, float a, float b) { return a * b; }
inline float apply(nodes::DivideOp, float a, float b) { return safe_divide(a, b); }
inline float apply(nodes::ModuloOp, float a, float b) {
    return b == 0 ? 0 : a - b * std::floor(a / b);
}
inline float apply(nodes::PowerOp, float a, float b) { return safe_power(a, b); }
inline float apply(nodes::MinOp, float a, float b) { return std::min(a, b); }
inline float apply(nodes::MaxOp, float a, float b) { return std::max(a, b); }
inline float apply(nodes::AbsvalOp, float x) { return std::abs(x); }
inline float apply(nodes::FloorOp, float x) { return std::floor(x); }
inline float apply(nodes::CeilOp, float x) { return std::ceil(x); }
inline float apply(nodes::SinOp, float x) { return std::sin(x); }
inline float apply(nodes::CosOp, float x) { return std::cos(x); }

template <class Op>
Vec3 run(nodes::Unary<Op> const& n, NodeContext const& at) {
    return each([](float x) { return apply(Op{}, x); }, at(n.in));
}

template <class Op>
Vec3 run(nodes::Binary<Op> const& n, NodeContext const& at) {
    return each([](float a, float b) { return apply(Op{}, a, b); }, at(n.in1), at(n.in2));
}

inline Vec3 run(nodes::Invert const& n, NodeContext const& at) { return at(n.amount) - at(n.in); }

inline Vec3 run(nodes::Clamp const& n, NodeContext const& at) {
    auto smaller = [](float a, float b) { return std::min(a, b); };
    auto larger = [](float a, float b) { return std::max(a, b); };
    return each(smaller, each(larger, at(n.in), at(n.low)), at(n.high));
}

/// Where `x` lies between `low` (0) and `high` (1).
inline Vec3 fraction(Vec3 const& x, Vec3 const& low, Vec3 const& high) {
    return each(safe_divide, x - low, high - low);
}

inline Vec3 run(nodes::Remap const& n, NodeContext const& at) {
    Vec3 const from = at(n.outlow);
    return from + fraction(at(n.in), at(n.inlow), at(n.inhigh)) * (at(n.outhigh) - from);
}

/// 0 up to `low`, 1 from `high` on; a step where they are equal.
inline float smooth_rise(float x, float low, float high) {
    if (x >= high) return 1;
    if (x <= low) return 0;
    float const t = (x - low) / (high - low);
    return t * t * (3 - 2 * t);
}

inline Vec3 run(nodes::Smoothstep const& n, NodeContext const& at) {
    Vec3 const x = at(n.in), low = at(n.low), high = at(n.high);
    return {smooth_rise(x.x, low.x, high.x), smooth_rise(x.y, low.y, high.y),
            smooth_rise(x.z, low.z, high.z)};
}

inline Vec3 run(nodes::Mix const& n, NodeContext const& at) {
    float const t = at(n.mix);
    return at(n.bg) * (1 - t) + at(n.fg) * t;
}

inline Vec3 run(nodes::DotProduct const& n, NodeContext const& at) {
    return Vec3(dot(at(n.in1), at(n.in2)));
}
inline Vec3 run(nodes::CrossProduct const& n, NodeContext const& at) {
    return cross(at(n.in1), at(n.in2));
}
inline Vec3 run(nodes::Normalize const& n, NodeContext const& at) {
    Vec3 const v = at(n.in);
    float const l = length(v);
    return l > 0 ? v * (1 / l) : Vec3(0);
}
inline Vec3 run(nodes::Magnitude const& n, NodeContext const& at) { return Vec3(length(at(n.in))); }

inline Vec3 run(nodes::Extract const& n, NodeContext const& at) { return Vec3(at(n.in)[n.index]); }
inline Vec3 run(nodes::Combine2 const& n, NodeContext const& at) {
    return {at(n.in1), at(n.in2), 0};
}
inline Vec3 run(nodes::Combine3 const& n, NodeContext const& at) {
    return {at(n.in1), at(n.in2), at(n.in3)};
}

} // namespace weft::shading
