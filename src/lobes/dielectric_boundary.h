// How a boundary between two dielectrics shares light out between reflection and transmission.
//
// By the exact Fresnel equations of one index, unless
// * the reflection has an index of its own, for productions that light reflections and refractions
//   separately. Reflection then follows `reflection_eta`, and of the two fractions that the indices
//   let through, the smaller one crosses, so that no energy is gained. (A stronger index of
//   reflection makes the boundary non-reciprocal; a weaker one loses energy.)
// * a thin film covers it: then the film alone decides.
#pragma once

#include "lobes/fresnel.h"
#include "lobes/thin_film.h"

namespace weft::lobes {

struct BoundaryOptions {
    float reflection_eta = 0; ///< far / near, as eta; 0 means the same as eta
    ThinFilm film{};          ///< its outer_ior is that of wo's side
};

struct BoundarySplit {
    Color reflected, transmitted; ///< fractions; their sum is at most 1
};

/// `fresnel`, cos_o and cos_t obey `eta`; cos_t is 0 under total reflection.
inline BoundarySplit split_light(BoundaryOptions const& options, float eta, float fresnel,
                                 float cos_o, float cos_t) {
    if (options.film) {
        Color const r = cos_t > 0 ? thin_film_reflectance(options.film, cos_o, eta) : Color(1);
        return {r, Color(1) - r};
    }
    if (options.reflection_eta > 0) {
        float const r = fresnel_dielectric(cos_o, options.reflection_eta);
        return {Color(r), Color(1 - std::max(fresnel, r))};
    }
    return {Color(fresnel), Color(1 - fresnel)};
}

/// Returns how much more light than arrives would leave at the worst angle if `split_light` did not
/// cut it, as a fraction. Lints of materials warn of it. One or two hundredths are no mistake:
/// beyond the Brewster angle of the higher index, the lower one reflects a little more.
inline float energy_gain(float eta, float reflection_eta) {
    constexpr int n = 256;
    float worst = 0;
    for (int i = 0; i <= n; ++i) {
        float const c = float(i) / n;
        worst = std::max(worst, fresnel_dielectric(c, reflection_eta) - fresnel_dielectric(c, eta));
    }
    return worst;
}

} // namespace weft::lobes
