// Networks of nodes made by hand, and what they give at a point.
#pragma once

#include "base/frame.h"
#include "base/hash.h"
#include "shading/graph_compiler.h"

#include <gtest/gtest.h>

namespace weft::testing {

namespace nodes = scene::nodes;
using scene::AnyValue;
using scene::Input;

struct Network {
    scene::Scene scene;

    scene::TextureId add(scene::Texture node) {
        scene.textures.push_back(std::move(node));
        scene.texture_locations.emplace_back();
        return {int32_t(scene.textures.size()) - 1};
    }
    /// An input fed by a new node.
    template <class T>
    Input<T> input(scene::Texture node) {
        Input<T> in;
        in.texture = add(std::move(node));
        return in;
    }
    Input<AnyValue> any(scene::Texture node) { return input<AnyValue>(std::move(node)); }

    shading::Program compile(scene::TextureId id, bool fold = true) const {
        return shading::GraphCompiler(scene, {fold}).compile(id, {});
    }
    Vec3 at(scene::TextureId id, shading::SurfacePoint const& point, bool fold = true) const {
        return shading::evaluate(compile(id, fold), point);
    }
};

/// A world-space position node: the value of `point.p`.
inline nodes::Position place() { return {nodes::Space::world}; }

inline shading::SurfacePoint random_point(Rng& rng) {
    shading::SurfacePoint point;
    point.p = rng.next3() * 4.f - Vec3(2);
    point.uv = rng.next2();
    point.ns = point.ng = normalize(rng.next3() - Vec3(0.5f));
    point.wo = normalize(rng.next3() - Vec3(0.5f));
    Frame const frame(point.ns);
    point.dpdu = frame.s * 1.5f + frame.t * 0.25f;
    point.dpdv = frame.t * 0.75f;
    point.object = rng.next_uint() % 100;
    return point;
}

inline void expect_near(Vec3 const& found, Vec3d const& expected, double tolerance,
                        std::string const& what) {
    for (int i = 0; i < 3; ++i)
        EXPECT_NEAR(found[i], expected[i], tolerance * std::max(1., std::abs(expected[i])))
            << what << ", channel " << i;
}

} // namespace weft::testing
