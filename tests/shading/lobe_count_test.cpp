// Room for lobes: what materials may add is known before they do, and none is lost.
#include "shading/lobe_count.h"

#include <gtest/gtest.h>

#include "scene/nodes_procedural.h"
#include "tests/shading/material_bench.h"

using namespace weft;
using namespace weft::testing;

namespace {

/// Layers of one material, of which all but the last cover `opacity`.
scene::MaterialId stack(MaterialBench& bench, scene::Material const& material, int layers,
                        float opacity) {
    scene::Layered layered;
    for (int i = 1; i <= layers; ++i) {
        scene::Layer layer;
        layer.bsdf = bench.add(material);
        layer.opacity = {i < layers ? opacity : 1};
        layered.layers.push_back(bench.add(layer));
    }
    return bench.add(layered);
}

TEST(LobeCount, SixteenLayersKeepTheirLight) {
    Vec3 const wo = towards(0.8f);
    auto const albedo = [&](float subsurface) {
        MaterialBench bench;
        scene::Disney m;
        m.subsurface = {subsurface};
        auto const id = stack(bench, m, 16, 0.06f);
        bench.compile();
        shading::Shading const s = bench.shade(id, wo);
        EXPECT_EQ(s.bsdf.size(), subsurface == 0.5f ? 48 : 32);
        return s.bsdf.albedo(wo).g;
    };
    float const none = albedo(0);
    EXPECT_NEAR(albedo(0.5f), none, 1e-4f);
    EXPECT_NEAR(albedo(1), none, 1e-4f);
    EXPECT_GT(none, 0.7f);
}

TEST(LobeCount, WhatMayNotFitIsRefused) {
    auto const message = [](int layers) -> std::string {
        MaterialBench bench;
        scene::Disney m;
        m.subsurface = bench.input<float>(scene::nodes::CellNoise2d{});
        stack(bench, m, layers, 0.06f);
        bench.name_last("paint", {"car.xml", 12, 3});
        try {
            bench.compile();
        } catch (InputError const& e) {
            return e.what();
        }
        return "";
    };
    EXPECT_EQ(message(21), "");
    EXPECT_EQ(message(22), "car.xml:12:3: expected a material of at most 64 lobes, found <bsdf "
                           "type=\"layered\" id=\"paint\"> of up to 66");
}

TEST(LobeCount, CountsWhatInputsMayBe) {
    MaterialBench bench;
    auto const most = [&](scene::Material const& m) {
        auto const id = bench.add(m);
        bench.compile();
        return std::max(shading::most_lobes(bench.materials(), id, false, false),
                        shading::most_lobes(bench.materials(), id, false, true));
    };
    auto const anything = [&] { return bench.input<float>(scene::nodes::CellNoise2d{}); };
    scene::Disney m;
    EXPECT_EQ(most(m), 2);
    m.specular = {0.f};
    EXPECT_EQ(most(m), 1);
    m.specular = anything();
    m.subsurface = anything();
    EXPECT_EQ(most(m), 3);
    m.metallic = {1.f}; // nothing of what is not metal is seen
    EXPECT_EQ(most(m), 1);
    m.metallic = anything();
    m.sheen = anything();
    m.clearcoat = {1.f};
    m.transmission = anything();
    EXPECT_EQ(most(m), 7);
    m.transmission_roughness = anything();
    EXPECT_EQ(most(m), 8);
    m.opacity = anything();
    EXPECT_EQ(most(m), 8); // of the whole: the object's

    scene::Mix mix;
    mix.bsdfs = {bench.add(scene::Diffuse{}), bench.add(m)};
    EXPECT_EQ(most(mix), 10); // of a part: a lobe
    mix.amount = {0.f};
    EXPECT_EQ(most(mix), 1);
    scene::Secondary secondary;
    secondary.bsdfs = {bench.add(scene::Translucent{}), bench.add(m)};
    EXPECT_EQ(most(secondary), 9);
    EXPECT_EQ(most(scene::VolumeBoundary{}), 0);
    EXPECT_EQ(most(scene::Hair{}), 1);
}

/// Wherever they are seen, materials fed by noise have no more lobes than was counted.
TEST(LobeCount, IsNeverPassed) {
    MaterialBench bench;
    Rng rng(3);
    auto const some = [&] {
        scene::nodes::CellNoise2d noise;
        scene::nodes::Place2d place;
        place.scale = {Vec2(0.01f + 0.1f * rng.next(), 0.1f)};
        noise.texcoord = bench.input<scene::SurfaceUv>(place);
        uint32_t const kind = rng.next_uint() % 4;
        scene::nodes::Smoothstep ends; // so that 0 and 1 occur
        ends.in.texture = bench.input<float>(noise).texture;
        ends.low = {scene::AnyValue(0.3f)};
        ends.high = {scene::AnyValue(0.7f)};
        return kind == 0   ? scene::Input<float>{0.f}
               : kind == 1 ? scene::Input<float>{1.f}
                           : bench.input<float>(ends);
    };
    std::vector<scene::MaterialId> made;
    for (int i = 0; i < 60; ++i) {
        scene::Layered layered;
        for (int k = 0; k < 3; ++k) {
            scene::Disney m;
            m.metallic = some();
            m.specular = some();
            m.sheen = some();
            m.clearcoat = some();
            m.transmission = some();
            m.transmission_roughness = some();
            m.subsurface = some();
            m.opacity = some();
            scene::Layer layer;
            layer.bsdf = bench.add(m);
            layer.opacity = some();
            layered.layers.push_back(bench.add(layer));
        }
        scene::Coat coat;
        coat.bsdf = bench.add(layered);
        coat.weight = some();
        made.push_back(bench.add(coat));
    }
    bench.compile();
    int reached = 0;
    for (auto const id : made) {
        int const most = shading::most_lobes(bench.materials(), id, false, false);
        int found = 0;
        for (int i = 0; i < 400; ++i) {
            Vec3 const wo = square_to_sphere(rng.next2());
            found = std::max(found, bench.shade(id, wo, false, rng.next2()).bsdf.size());
        }
        EXPECT_LE(found, most);
        reached += found == most;
    }
    EXPECT_GT(reached, 20) << "counted too many";
}

} // namespace
