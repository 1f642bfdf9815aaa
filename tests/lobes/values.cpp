// For every configuration of every lobe: numbers stay finite and non-negative wherever they are
// asked for, and smooth lobes are reciprocal.
#include <cstdio>

#include <gtest/gtest.h>

#include "base/warp.h"
#include "tests/lobes/configurations.h"

using namespace weft;
using namespace weft::lobes;
using namespace weft::lobes::testing;

namespace {

/// A unit vector with z > 0: anywhere, at grazing angles down to 1e-12, or hugging the normal.
Vec3 nasty_direction(Rng& rng) {
    float const kind = rng.next(), azimuth = 2 * kPi * rng.next();
    float z = rng.next();
    if (kind < 0.3f) z = std::pow(10.f, -12 * rng.next());
    float r = std::sqrt((1 - z) * (1 + z));
    if (kind > 0.7f) {
        r = std::pow(10.f, -8 * rng.next());
        z = safe_sqrt(1 - r * r);
    }
    // Along an axis now and then, where a component is exactly 0.
    Vec3 const w =
        rng.next() < 0.1f ? Vec3(r, 0, z) : Vec3(r * std::cos(azimuth), r * std::sin(azimuth), z);
    return {w.x, w.y, std::max(z, 1e-12f)};
}

/// Now and then an end of the unit interval.
float nasty_number(Rng& rng) {
    float const kind = rng.next();
    return kind < 0.03f ? 0.f : kind > 0.97f ? kOneMinusEpsilon : rng.next();
}

Vec3 nasty_numbers(Rng& rng) {
    float const x = nasty_number(rng), y = nasty_number(rng);
    return {x, y, nasty_number(rng)};
}

bool sound(float x) { return std::isfinite(x) && x >= 0; }
bool sound(Color const& c) { return sound(c.r) && sound(c.g) && sound(c.b); }
bool unit(Vec3 const& v) { return std::abs(length_squared(v) - 1) < 1e-5f; }

std::string text(Vec3 const& v) {
    char buffer[100];
    std::snprintf(buffer, sizeof buffer, "(%.9g, %.9g, %.9g)", double(v.x), double(v.y),
                  double(v.z));
    return buffer;
}

template <class L>
int cases_per_configuration() {
    return 150000 / int(test_configurations<L>().size()) + 1000;
}

/// What goes wrong with one case, or "".
template <SmoothLobe L>
std::string fault(Configuration<L> const& c, Vec3 const& wo, Vec3 const& wi, Vec3 const& u,
                  int& lost) {
    L lobe = c.lobe;
    look_up(lobe, wo);
    LobeValue const any_value = lobe.eval(wo, wi);
    if (!sound(any_value.f) || !sound(any_value.pdf)) return "eval at " + text(wi);
    if (!sound(lobe.albedo(wo)) || max_component(lobe.albedo(wo)) > 1.0001f) return "albedo";
    Vec3 const sampled = lobe.sample(wo, u);
    if (!is_finite(sampled)) return "sample by " + text(u);
    if (sampled == Vec3(0)) return "";
    if (!unit(sampled)) return "length of the sample by " + text(u);
    LobeValue const v = lobe.eval(wo, sampled);
    if (!sound(v.f) || !sound(v.pdf)) return "eval at its own sample " + text(sampled);
    bool const at_an_end =
        u.x == 0 || u.y == 0 || u.x == kOneMinusEpsilon || u.y == kOneMinusEpsilon;
    if (!(v.pdf > 0) && !at_an_end) ++lost;
    float const scale = eta_scale_towards(lobe, sampled);
    if (c.weighs_below_one && max_component(v.f) * scale > v.pdf * 1.01f &&
        max_component(lobe.albedo(wo)) == 1)
        return "a weight above 1 at " + text(sampled);
    return "";
}

TEST(SmoothLobes, StaySoundAtTheEdges) {
    for_each_configuration<true>([&]<class L>(Configuration<L> const& c) {
        Rng rng(hash_bytes(c.name));
        int const cases = cases_per_configuration<L>();
        int lost = 0, faults = 0;
        for (int i = 0; i < cases && faults < 3; ++i) {
            Vec3 const wo = nasty_direction(rng);
            Vec3 wi = nasty_direction(rng);
            float const kind = rng.next();
            if (kind < 0.2f) wi = {-wo.x, -wo.y, wo.z};
            if (kind > 0.5f) wi.z = -wi.z;
            if (kind > 0.9f) wi = -wo;
            std::string const f = fault(c, wo, wi, nasty_numbers(rng), lost);
            faults += !f.empty();
            EXPECT_EQ(f, "") << c.name << ", wo " << text(wo);
        }
        // Samples that rounding puts where the lobe sees no density lose energy: few may.
        EXPECT_LE(lost, cases / 500) << c.name;
    });
}

TEST(SmoothLobes, AreReciprocal) {
    for_each_configuration<true>([&]<class L>(Configuration<L> const& c) {
        if (!c.reciprocal) return;
        Rng rng(hash_bytes(c.name));
        int compared = 0, faults = 0;
        for (int i = 0; i < 4000 && faults < 3; ++i) {
            Vec3 const wo =
                at_angle(degrees(std::acos(0.01f + 0.99f * rng.next())), 6 * rng.next());
            Vec3 wi = c.lobe.sample(wo, rng.next3());
            if (i % 2 == 0) wi = square_to_sphere(rng.next2());
            if (std::abs(wi.z) < 0.01f) continue;
            // f / |cos| eta is the same both ways (Veach 1997, 5.2); the mirrored frame has z
            // on the side of its wo.
            float const flip = wi.z < 0 ? -1.f : 1.f;
            Vec3 const back_wo(wi.x, wi.y, flip * wi.z), back_wi(wo.x, wo.y, flip * wo.z);
            L const behind = wi.z < 0 ? seen_from_behind(c.lobe) : c.lobe;
            float const eta = std::sqrt(eta_scale_towards(c.lobe, wi));
            Color const there = c.lobe.eval(wo, wi).f * (eta / std::abs(wi.z));
            Color const back = behind.eval(back_wo, back_wi).f * (1 / (eta * wo.z));
            for (int k = 0; k < 3; ++k) {
                // The absolute part: next to the range's border a cosine of rounding's size
                // is a factor.
                float const greater = std::max(there[k], back[k]);
                compared += greater > 1e-5f;
                bool const equal = std::abs(there[k] - back[k]) <= c.resolution * greater + 1e-6f;
                faults += !equal;
                EXPECT_TRUE(equal) << c.name << ": " << there[k] << " and " << back[k] << " for "
                                   << text(wo) << text(wi);
            }
        }
        bool const black = is_black(c.lobe.albedo({0, 0, 1}));
        EXPECT_TRUE(black || compared > 1000) << c.name;
    });
}

TEST(DeltaLobes, StaySoundAtTheEdges) {
    for_each_configuration<false>([&]<class L>(Configuration<L> const& c) {
        Rng rng(hash_bytes(c.name));
        for (int i = 0; i < cases_per_configuration<L>(); ++i) {
            Vec3 const wo = nasty_direction(rng);
            DeltaSample const s = c.lobe.sample(wo, nasty_numbers(rng));
            ASSERT_TRUE(sound(s.weight) && sound(s.probability) && s.probability <= 1 &&
                        sound(s.eta_scale) && sound(c.lobe.albedo(wo)))
                << c.name << ", wo " << text(wo);
            if (s.probability == 0) continue;
            ASSERT_TRUE(unit(s.wi)) << c.name << ", wo " << text(wo) << ", wi " << text(s.wi);
            ASSERT_TRUE(s.wi.z < 0 || s.eta_scale == 1);
            // Both kinds lie in the plane of incidence, on the far side of the normal.
            ASSERT_NEAR(s.wi.x * wo.y, s.wi.y * wo.x, 1e-6);
            ASSERT_LE(s.wi.x * wo.x + s.wi.y * wo.y, 0);
            // Snell's law; a mirror's ratio is 1.
            double const sin2_o = double(wo.x) * wo.x + double(wo.y) * wo.y;
            double const sin2_i = double(s.wi.x) * s.wi.x + double(s.wi.y) * s.wi.y;
            ASSERT_NEAR(sin2_i * s.eta_scale, sin2_o, 2e-6 * s.eta_scale);
        }
    });
}

TEST(DeltaLobes, SampleTheirAlbedo) {
    for_each_configuration<false>([&]<class L>(Configuration<L> const& c) {
        for (float const angle : {0.f, 45.f, 80.f, 89.f}) {
            // Strata of u.z instead of random numbers: nothing else chooses.
            constexpr int n = 1 << 12;
            Vec3 const wo = at_angle(angle);
            Color sum;
            double reflected = 0, reflect_probability = 0;
            for (int i = 0; i < n; ++i) {
                DeltaSample const s = c.lobe.sample(wo, {0, 0, (float(i) + 0.5f) / n});
                if (s.probability == 0) continue;
                sum += s.weight * (s.eta_scale / n);
                if (s.wi.z < 0) continue;
                reflected += 1.0 / n;
                reflect_probability = s.probability;
            }
            Color const albedo = c.lobe.albedo(wo);
            for (int k = 0; k < 3; ++k) EXPECT_NEAR(sum[k], albedo[k], 2e-3) << c.name;
            EXPECT_NEAR(reflected, reflect_probability, 1.0 / n) << c.name;
            EXPECT_LE(max_component(albedo), 1.00001f) << c.name;
        }
    });
}

} // namespace
