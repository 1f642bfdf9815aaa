// Hair and fur: one dielectric fibre, seen from so far that its width is the pixel's (Chiang,
// Bitterli, Tappan, Burley 2016, "A practical and controllable hair and fur model for production
// path tracing"; after Marschner et al. 2003 and d'Eon et al. 2011). Light reflects off the fibre
// (p = 0), passes through it (p = 1), or reflects inside (p = 2; p = 3 stands for all that follow):
//     f cos_i = sum over p of  M_p(theta_o, theta_i)  A_p(o, h)  N_p(phi).
// M_p (d'Eon et al. 2011, eq. 7) blurs along the fibre, with variance v_p; N_p, a logistic
// distribution cut off at +-pi, blurs around it; A_p is what Fresnel reflection and absorption
// leave. M_p integrates to 1 over sin theta_i and N_p over phi, so that the albedo is just the sum
// of A_p: white hair, sigma_a = 0, reflects all light. Lobes are sampled in proportion to A_p, then
// exactly.
//
// Local frame: x runs along the fibre (towards its tip: scales tilt R towards the root), y-z is the
// normal plane, and theta = asin(w.x). The whole sphere scatters; f carries the fibre's own cosine,
// sqrt(1 - wi.x^2), where surfaces have |wi.z|, and depends on y and z through the angle between
// the directions alone. z only says what counts as transmission: the material gives it any
// direction across the fibre on wo's side, the same for shading and geometric normal (then Bsdf
// drops nothing).
//
// `h` in [-1, 1] says where wo meets the fibre's width: h = dot(x, cross(n, o)) with n the normal
// of the round fibre and o the normalised part of wo across it; a flat ribbon that faces wo has it
// from -1 to 1 over its width.
//
// Left out: elliptical cross sections, the medulla of animal fur. Not reciprocal, because of the
// scales and because wo alone decides on refraction and absorption.
#pragma once

#include <array>

#include "lobes/fresnel.h"
#include "lobes/lobe.h"

namespace weft::lobes {

/// What a fibre is made of; shared by all points of a groom.
struct HairParameters {
    Color sigma_a{};            ///< absorption per fibre radius, >= 0
    float beta_m = 0.3f;        ///< roughness along the fibre, in [0, 1]; below 0.03 as 0.03
    float beta_n = 0.3f;        ///< roughness around it, in [0, 1]; below 0.03 as 0.03
    float eta = 1.55f;          ///< index of refraction over that outside, > 1
    float alpha = radians(2.f); ///< tilt of the scales, radians
};

/// Absorption by concentrations of the two pigments, >= 0: brown to black eumelanin (1.3: brown, 8:
/// black) and red pheomelanin. d'Eon et al. 2011, as Chiang et al. 2016 have it.
Color sigma_a_from_melanin(float eumelanin, float pheomelanin);

/// Absorption that gives a mass of hair about this colour (its channels are taken within [0.001,
/// 0.999]) under diffuse light: Chiang et al. 2016, eq. 9.
Color sigma_a_from_color(Color const& color, float beta_n);

class Hair {
  public:
    Hair(HairParameters const& parameters, float h);

    static constexpr LobeFlags flags() { return {ScatteringKind::Glossy, Sides::Both}; }
    /// However smooth, the round fibre sends light all around.
    static constexpr float width() { return 1; }
    static constexpr float eta_scale() { return 1; }
    LobeValue eval(Vec3 const& wo, Vec3 const& wi) const;
    Vec3 sample(Vec3 const& wo, Vec3 const& u) const;
    /// Exact.
    Color albedo(Vec3 const& wo) const;

  private:
    static constexpr int kLobes = 4; ///< R, TT, TRT, and the rest

    /// All that depends on wo alone.
    struct Outgoing {
        float sin_theta, cos_theta;
        float gamma_t; ///< azimuth of the refracted ray's chord
        std::array<Color, kLobes> a;
        std::array<float, kLobes> pick; ///< by average(a), sums to 1

        Outgoing(Hair const& hair, Vec3 const& wo);
    };

    struct SinCos {
        float sin, cos;
    };
    /// wo's inclination as lobe p sees it, tilted by the scales.
    SinCos tilted(Outgoing const& o, int p) const;
    /// The azimuth that a smooth fibre would send lobe p to, relative to wo's.
    float exit_azimuth(Outgoing const& o, int p) const;

    Color sigma_a_;
    float eta_, h_, gamma_o_;
    std::array<float, 3> variance_;     ///< of M_0 ... M_2; M_3 is as wide as M_2
    std::array<float, 3> longitudinal_; ///< 1 / (v (1 - exp(-2 / v)))
    std::array<SinCos, 3> tilt_;
    float scale_; ///< s of the logistic
    float tail_;  ///< of the logistic below -pi
};

static_assert(SmoothLobe<Hair>);
static_assert(sizeof(Hair) <= 96);

} // namespace weft::lobes
