// What each parameter of `disney` and of materials made of materials means, against formulas
// written down once more.
#include <gtest/gtest.h>

#include "scene/material_facts.h"
#include "tests/shading/material_bench.h"

using namespace weft;
using namespace weft::testing;

namespace {

Vec3 const kAbove(0, 0, 1);

shading::Shading shaded(scene::Disney const& m, Vec3 const& wo = kAbove) {
    MaterialBench bench;
    auto const id = bench.add(m);
    bench.compile();
    return bench.shade(id, wo);
}

/// The lobes of one kind.
template <class L>
std::vector<std::pair<Color, L>> lobes_of(lobes::Bsdf const& bsdf) {
    std::vector<std::pair<Color, L>> found;
    for (int i = 0; i < bsdf.size(); ++i)
        if (auto const* l = std::get_if<L>(&bsdf[i].kind)) found.emplace_back(bsdf[i].weight, *l);
    return found;
}

template <class L>
std::pair<Color, L> only(lobes::Bsdf const& bsdf) {
    auto const all = lobes_of<L>(bsdf);
    EXPECT_EQ(all.size(), 1u);
    return all.at(0);
}

void expect_near(Color const& found, Color const& expected, float tolerance = 1e-5f) {
    for (int k = 0; k < 3; ++k) EXPECT_NEAR(found[k], expected[k], tolerance);
}

TEST(Disney, SpecularScalesTheReflectionThatIorSays) {
    for (float const ior : {1.33f, 1.5f, 2.f})
        for (float const specular : {0.25f, 0.5f, 1.f}) {
            scene::Disney m;
            m.ior = {ior};
            m.specular = {specular};
            auto const [weight, lobe] = only<lobes::GgxReflection>(shaded(m).bsdf);
            float const f0 = square((ior - 1) / (ior + 1));
            expect_near(weight * reflectance(lobe.fresnel, 1), Color(2 * specular * f0));
        }
    scene::Disney m;
    m.specular = {0.f};
    EXPECT_TRUE(lobes_of<lobes::GgxReflection>(shaded(m).bsdf).empty());
}

TEST(Disney, MetalReflectsItsBaseColorAndTintsItsEdge) {
    scene::Disney m;
    m.metallic = {1.f};
    m.base_color = {Color(0.9f, 0.6f, 0.2f)};
    m.specular_tint = {Color(1, 0.5f, 0.25f)};
    shading::Shading const s = shaded(m);
    EXPECT_EQ(s.bsdf.size(), 1);
    auto const [weight, lobe] = only<lobes::GgxReflection>(s.bsdf);
    expect_near(weight * reflectance(lobe.fresnel, 1), m.base_color.value);
    // At 82 degrees, the cosine 1 / 7, the tint scales Schlick's value.
    Color const schlick = lerp(m.base_color.value, Color(1), std::pow(6 / 7.f, 5.f));
    expect_near(weight * reflectance(lobe.fresnel, 1 / 7.f), schlick * m.specular_tint.value);
    expect_near(weight * reflectance(lobe.fresnel, 0), Color(1));
}

TEST(Disney, SpecularTintColoursDielectrics) {
    scene::Disney m;
    m.specular_tint = {Color(1, 0.5f, 0)};
    auto const [weight, lobe] = only<lobes::GgxReflection>(shaded(m).bsdf);
    expect_near(weight * reflectance(lobe.fresnel, 1), Color(0.04f, 0.02f, 0));
}

TEST(Disney, AnisotropicStretchesBySqrtOneMinusNineTenths) {
    scene::Disney m;
    m.metallic = {1.f};
    m.roughness = {0.5f};
    m.anisotropic = {0.8f};
    auto const [weight, lobe] = only<lobes::GgxReflection>(shaded(m).bsdf);
    float const aspect = std::sqrt(1 - 0.9f * 0.8f);
    EXPECT_NEAR(lobe.distribution.alpha_x, 0.25f / aspect, 1e-6);
    EXPECT_NEAR(lobe.distribution.alpha_y, 0.25f * aspect, 1e-6);
}

TEST(Disney, TransmissionRoughnessIsOfWhatIsSeenThrough) {
    scene::Disney m;
    m.transmission = {1.f};
    m.roughness = {0.2f};
    m.transmission_roughness = {0.6f};
    auto const glass = lobes_of<lobes::GgxDielectric>(shaded(m).bsdf);
    ASSERT_EQ(glass.size(), 2u);
    EXPECT_NEAR(glass[0].second.distribution().alpha_x, 0.04f, 1e-6);
    EXPECT_EQ(glass[0].second.transmittance(), Color(0));
    EXPECT_NEAR(glass[1].second.distribution().alpha_x, 0.36f, 1e-6);
    EXPECT_EQ(glass[1].second.reflectance(), Color(0));
    m.transmission_roughness = {-1.f};
    EXPECT_EQ(lobes_of<lobes::GgxDielectric>(shaded(m).bsdf).size(), 1u);
}

TEST(Disney, ClearcoatTintsByTheWayThroughIt) {
    scene::Disney m;
    m.specular = {0.f};
    m.clearcoat = {1.f};
    for (float const cosine : {1.f, 0.6f, 0.2f}) {
        Vec3 const wo = towards(cosine);
        m.clearcoat_tint = {Color(1)};
        Color const clear = only<lobes::BurleyDiffuse>(shaded(m, wo).bsdf).first;
        m.clearcoat_tint = {Color(0.9f, 0.5f, 0.1f)};
        Color const tinted = only<lobes::BurleyDiffuse>(shaded(m, wo).bsdf).first;
        // Snell: the way is 1 / cos of the refracted angle.
        float const way = 1 / std::sqrt(1 - (1 - cosine * cosine) / (1.5f * 1.5f));
        for (int k = 0; k < 3; ++k)
            EXPECT_NEAR(tinted[k] / clear[k], std::pow(m.clearcoat_tint.value[k], way), 1e-5);
    }
}

TEST(Disney, SheenLeavesTheRestToTheBase) {
    scene::Disney m;
    m.specular = {0.f};
    m.base_color = {Color(0.5f)};
    m.sheen = {0.7f};
    m.sheen_tint = {Color(1, 0.5f, 0)};
    for (float const cosine : {1.f, 0.5f, 0.1f}) {
        Vec3 const wo = towards(cosine);
        shading::Shading const s = shaded(m, wo);
        auto const [weight, lobe] = only<lobes::Sheen>(s.bsdf);
        expect_near(weight, Color(0.7f, 0.35f, 0));
        Color const left = Color(1) - weight * lobe.albedo(wo);
        expect_near(only<lobes::BurleyDiffuse>(s.bsdf).first, 0.5f * left);
    }
}

TEST(Disney, FilmOfNoThicknessIsNone) {
    for (float const metallic : {0.f, 1.f})
        for (float const transmission : {0.f, 1.f}) {
            scene::Disney m;
            m.metallic = {metallic};
            m.transmission = {transmission};
            auto const f = [&](float thickness, float ior) {
                m.thin_film_thickness = {thickness};
                m.thin_film_ior = {ior};
                return shaded(m, towards(0.7f)).bsdf.eval(towards(0.7f), towards(0.6f, 2.5f)).f;
            };
            EXPECT_EQ(f(0, 1.33f), f(0, 2));
            EXPECT_NE(f(0, 1.33f), f(300, 1.33f));
        }
}

TEST(Disney, LightLeavesByTheInverseIndex) {
    scene::Disney m;
    m.transmission = {1.f};
    m.ior = {1.4f};
    shading::Shading const outside = shaded(m), inside = shaded(m, -kAbove);
    EXPECT_NEAR(only<lobes::GgxDielectric>(outside.bsdf).second.eta(), 1.4f, 1e-6);
    EXPECT_NEAR(only<lobes::GgxDielectric>(inside.bsdf).second.eta(), 1 / 1.4f, 1e-6);
    EXPECT_EQ(outside.ior, 1.4f);
    MaterialBench bench;
    EXPECT_EQ(scene::inner_ior(bench.scene(), bench.add(m))->value, 1.4f);
    m.transmission = {0.f};
    EXPECT_FALSE(scene::inner_ior(bench.scene(), bench.add(m)));
}

struct Parts {
    MaterialBench bench;
    scene::MaterialId diffuse(float albedo) { return bench.add(scene::Diffuse{{Color(albedo)}}); }
    scene::LayerId layer(scene::MaterialId material, float opacity) {
        scene::Layer layer;
        layer.bsdf = material;
        layer.opacity = {opacity};
        return bench.add(layer);
    }
};

TEST(Parts, OpacityIsATransparentLobe) {
    Parts p;
    scene::Disney half;
    half.opacity = {0.6f};
    scene::Mix mix;
    mix.bsdfs = {p.diffuse(0.5f), p.bench.add(half)};
    mix.amount = {0.25f};
    auto const id = p.bench.add(mix);
    p.bench.compile();
    expect_near(only<lobes::Transparent>(p.bench.shade(id, kAbove).bsdf).first,
                Color(0.25f * 0.4f));
    expect_near(only<lobes::Lambert>(p.bench.shade(id, kAbove).bsdf).first, Color(0.75f * 0.5f));
    // A whole material's opacity is the object's.
    EXPECT_TRUE(lobes_of<lobes::Transparent>(shaded(half).bsdf).empty());
}

TEST(Parts, EmitInTheirShare) {
    Parts p;
    scene::Disney lamp;
    lamp.emission_color = {Color(1, 0.5f, 0)};
    lamp.emission_strength = {3.f};
    lamp.opacity = {0.5f};
    scene::Layered layered;
    layered.layers = {p.layer(p.diffuse(0.5f), 0.2f), p.layer(p.bench.add(lamp), 1)};
    auto const id = p.bench.add(layered);
    p.bench.compile();
    expect_near(p.bench.shade(id, kAbove).emission, Color(1.2f, 0.6f, 0));
    EXPECT_EQ(p.bench.shade(id, -kAbove).emission, Color(0)); // the front alone
}

TEST(Parts, LayersCoverByTheirOpacity) {
    Parts p;
    scene::Layered layered;
    layered.layers = {p.layer(p.diffuse(0.9f), 0.3f), p.layer(p.diffuse(0.7f), 0.6f),
                      p.layer(p.diffuse(0.5f), 1)};
    auto const id = p.bench.add(layered);
    layered.secondary = scene::SecondaryRays::base;
    auto const cheap = p.bench.add(layered);
    p.bench.compile();
    auto const found = lobes_of<lobes::Lambert>(p.bench.shade(id, kAbove).bsdf);
    ASSERT_EQ(found.size(), 3u);
    expect_near(found[0].first, Color(0.3f * 0.9f));
    expect_near(found[1].first, Color(0.7f * 0.6f * 0.7f));
    expect_near(found[2].first, Color(0.7f * 0.4f * 0.5f));
    expect_near(only<lobes::Lambert>(p.bench.shade(cheap, kAbove, true).bsdf).first, Color(0.5f));
    EXPECT_EQ(p.bench.shade(cheap, kAbove, false).bsdf.size(), 3);
}

TEST(Parts, SecondaryRaysSeeTheStandIn) {
    Parts p;
    scene::Secondary secondary;
    secondary.bsdfs = {p.diffuse(0.2f), p.diffuse(0.6f)};
    scene::Mix mix;
    mix.bsdfs = {p.diffuse(0.8f), p.diffuse(0.1f)};
    mix.secondary = scene::SecondaryRays::base;
    scene::Coat coat;
    coat.bsdf = p.diffuse(0.4f);
    coat.secondary = scene::SecondaryRays::base;
    auto const a = p.bench.add(secondary), b = p.bench.add(mix), c = p.bench.add(coat);
    p.bench.compile();
    auto const weight = [&](scene::MaterialId id, bool again) {
        return only<lobes::Lambert>(p.bench.shade(id, kAbove, again).bsdf).first;
    };
    expect_near(weight(a, false), Color(0.2f));
    expect_near(weight(a, true), Color(0.6f));
    expect_near(weight(b, true), Color(0.8f));
    expect_near(weight(c, true), Color(0.4f));
    EXPECT_EQ(p.bench.shade(b, kAbove, false).bsdf.size(), 2);
    EXPECT_EQ(p.bench.shade(c, kAbove, false).bsdf.size(), 2);
}

} // namespace
