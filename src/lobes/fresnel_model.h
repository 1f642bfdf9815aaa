// What colour of light a surface reflects under an angle: the closed set of Fresnel models that
// reflecting lobes choose from. All give Colors in [0, 1] where their parameters are.
//
// Edge tints follow Kutz, Hasan and Edmondson 2021 ("Novel aspects of the Adobe Standard
// Material"): Schlick's curve less a c (1 - c)^6, whose peak at c = 1 / 7 (82 degrees) is set by
// the tint and which leaves both ends alone (Lazanyi and Szirmay-Kalos 2005).
#pragma once

#include <variant>

#include "base/match.h"
#include "lobes/albedo.h"
#include "lobes/fresnel.h"
#include "lobes/thin_film.h"

namespace weft::lobes {

/// Reflects all light; the tint is the weight in the list.
struct WhiteFresnel {};

/// f0 + (f90 - f0) (1 - c)^5 - edge c (1 - c)^6.
struct SchlickFresnel {
    Color f0;
    Color f90{1.f};
    Color edge{}; ///< see schlick_f82
};

/// One interface of relative index `eta` = far / near > 0.
struct DielectricFresnel {
    float eta = 1.5f;
};

/// Complex index eta + i k relative to the near side.
struct ConductorFresnel {
    Color eta, k;
};

/// A thin film over a conductor, or with k = 0 over a dielectric.
struct ThinFilmFresnel {
    ThinFilm film;
    Color eta, k;
};

/// Both sides of a wall of relative index `eta`, and all that is reflected to and fro between them:
/// with R of one side, R + (1 - R)^2 R / (1 - R^2) = 2 R / (1 + R). A film lies on each.
struct ThinWallFresnel {
    float eta = 1.5f;
    ThinFilm film{};
};

using Fresnel = std::variant<WhiteFresnel, SchlickFresnel, DielectricFresnel, ConductorFresnel,
                             ThinFilmFresnel, ThinWallFresnel>;

/// From `f0` at the normal to white at grazing, and `tint` in [0, 1] times Schlick's value at 82
/// degrees.
SchlickFresnel schlick_f82(Color const& f0, Color const& tint);

Color reflectance(WhiteFresnel const&, float cos_o);
Color reflectance(SchlickFresnel const& fresnel, float cos_o);
Color reflectance(DielectricFresnel const& fresnel, float cos_o);
Color reflectance(ConductorFresnel const& fresnel, float cos_o);
Color reflectance(ThinFilmFresnel const& fresnel, float cos_o);
Color reflectance(ThinWallFresnel const& fresnel, float cos_o);

/// cos_o in [0, 1] between wo and the (half) normal.
inline Color reflectance(Fresnel const& fresnel, float cos_o) {
    return match(fresnel, [cos_o](auto const& f) { return reflectance(f, cos_o); });
}

/// The mean over a hemisphere of even light, 2 * the integral of F(c) c: exact for Schlick, within
/// 0.02 for the others; films count as their base. What multiple scattering sees.
Color mean_reflectance(Fresnel const& fresnel);

/// Of a rough surface with these moments. Exact for Schlick; for conductors by the curve with an
/// edge that meets theirs at the normal, at 82 degrees and at grazing.
Color rough_reflectance(SchlickFresnel const& fresnel, ReflectionMoments const& m);
Color rough_reflectance(ConductorFresnel const& fresnel, ReflectionMoments const& m);

// Inline: what every evaluation calls.

inline Color reflectance(WhiteFresnel const&, float) { return Color(1); }
inline Color reflectance(SchlickFresnel const& f, float cos_o) {
    float const c = std::min(std::max(cos_o, 0.f), 1.f), m = 1 - c, m5 = square(m * m) * m;
    Color const r = f.f0 + (f.f90 - f.f0) * m5 - f.edge * (c * m5 * m);
    return max(r, 0);
}
inline Color reflectance(DielectricFresnel const& f, float cos_o) {
    return Color(fresnel_dielectric(cos_o, f.eta));
}
inline Color reflectance(ConductorFresnel const& f, float cos_o) {
    return fresnel_conductor(cos_o, f.eta, f.k);
}
inline Color reflectance(ThinFilmFresnel const& f, float cos_o) {
    if (f.film.thickness > 0) return thin_film_reflectance(f.film, cos_o, f.eta, f.k);
    return fresnel_conductor(cos_o, f.eta, f.k);
}
inline Color reflectance(ThinWallFresnel const& f, float cos_o) {
    Color const r = f.film ? thin_film_reflectance(f.film, cos_o, f.eta)
                           : Color(fresnel_dielectric(cos_o, f.eta));
    return {2 * r.r / (1 + r.r), 2 * r.g / (1 + r.g), 2 * r.b / (1 + r.b)};
}

} // namespace weft::lobes
