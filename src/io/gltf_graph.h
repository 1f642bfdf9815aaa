// Arithmetic on inputs of materials while a glTF file is read: constants are calculated at once,
// everything else becomes nodes.
//
// An input that a node feeds keeps, as its `value`, what the network gives where all of its images
// are white: whether an effect is there at all is told by that.
#pragma once

#include <cmath>

#include "scene/scene_vectors.h"

namespace weft::io::gltf {

inline float apply(scene::nodes::AddOp, float a, float b) { return a + b; }
inline float apply(scene::nodes::SubtractOp, float a, float b) { return a - b; }
inline float apply(scene::nodes::MultiplyOp, float a, float b) { return a * b; }
inline float apply(scene::nodes::DivideOp, float a, float b) { return a / b; }
inline float apply(scene::nodes::PowerOp, float a, float b) { return std::pow(a, b); }
inline float apply(scene::nodes::MinOp, float a, float b) { return std::min(a, b); }
inline float apply(scene::nodes::MaxOp, float a, float b) { return std::max(a, b); }
inline float apply(scene::nodes::ModuloOp, float a, float b) { return a - b * std::floor(a / b); }
template <class Op>
Color apply(Op op, Color const& a, Color const& b) {
    return {apply(op, a.r, b.r), apply(op, a.g, b.g), apply(op, a.b, b.b)};
}

inline scene::Input<scene::AnyValue> any(scene::Input<float> const& in) {
    return {scene::AnyValue(in.value), in.texture};
}
inline scene::Input<scene::AnyValue> any(scene::Input<Color> const& in) {
    return {scene::AnyValue(in.value.r, in.value.g, in.value.b), in.texture};
}

/// Appends nodes to a scene.
class Nodes {
  public:
    explicit Nodes(scene::Scene& scene) : scene_(scene) {}

    /// Where what the next nodes stand for is written, for messages.
    SourceLocation where;

    template <class Node>
    scene::TextureId add(Node node) {
        return scene::add(scene_, schema::TextureKind{}, std::move(node), where);
    }

    template <class Op, class T>
    scene::Input<T> binary(scene::Input<T> const& a, scene::Input<T> const& b) {
        T const value = apply(Op(), a.value, b.value);
        if (!a.texture && !b.texture) return {value};
        return {value, add(scene::nodes::Binary<Op>{any(a), any(b)})};
    }
    template <class T>
    scene::Input<T> multiply(scene::Input<T> const& a, scene::Input<T> const& b) {
        if (!a.texture && a.value == T(1)) return b;
        if (!b.texture && b.value == T(1)) return a;
        return binary<scene::nodes::MultiplyOp>(a, b);
    }
    scene::Input<float> subtract(scene::Input<float> const& a, scene::Input<float> const& b) {
        return binary<scene::nodes::SubtractOp>(a, b);
    }
    /// a where t is 0, b where it is 1.
    scene::Input<float> lerp(float a, float b, scene::Input<float> const& t) {
        scene::Input<float> const rise = multiply(scene::Input<float>{b - a}, t);
        return a == 0 ? rise : binary<scene::nodes::AddOp>(scene::Input<float>{a}, rise);
    }
    scene::Input<Color> mix(scene::Input<Color> const& a, scene::Input<Color> const& b,
                            scene::Input<float> const& t) {
        if (!t.texture && t.value == 0) return a;
        if (!t.texture && t.value == 1) return b;
        return {Color(1), add(scene::nodes::Mix{.fg = any(b), .bg = any(a), .mix = t})};
    }
    /// 1 where x is at least `edge`, else 0.
    scene::Input<float> step(scene::Input<float> const& x, float edge) {
        float const value = x.value >= edge ? 1.f : 0.f;
        if (!x.texture) return {value};
        scene::Input<scene::AnyValue> const at = any(scene::Input<float>{edge});
        return {value, add(scene::nodes::Smoothstep{any(x), at, at})};
    }
    /// One channel of the node's result, whose value is 1.
    scene::Input<float> extract(scene::TextureId from, int channel) {
        return {1, add(scene::nodes::Extract{{{}, from}, channel})};
    }

  private:
    scene::Scene& scene_;
};

} // namespace weft::io::gltf
