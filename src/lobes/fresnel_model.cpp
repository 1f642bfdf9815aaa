#include "lobes/fresnel_model.h"

namespace weft::lobes {

namespace {

/// c (1 - c)^6 and (1 - c)^5 at c = 1 / 7.
constexpr float kEdgePeak = 46656 / 823543.f, kSchlickAtPeak = 7776 / 16807.f;

/// Schlick's curve with the edge that meets `f` at the normal, at 82 degrees and at grazing.
template <class F>
SchlickFresnel schlick_fit(F const& fresnel) {
    Color const f0 = reflectance(fresnel, 1), at_peak = reflectance(fresnel, 1 / 7.f);
    Color const schlick = lerp(f0, Color(1), kSchlickAtPeak);
    return {f0, Color(1), (schlick - at_peak) * (1 / kEdgePeak)};
}

Color mean(SchlickFresnel const& f) {
    return f.f0 + (f.f90 - f.f0) * (1 / 21.f) - f.edge * (1 / 126.f);
}
Color mean(WhiteFresnel const&) { return Color(1); }
/// Fits by Kulla and Conty 2017, "Revisiting physically based shading at Imageworks".
Color mean(DielectricFresnel const& f) {
    float const n = f.eta;
    if (n < 1) return Color(0.997118f + n * (0.1014f - n * (0.965241f + n * 0.130607f)));
    return Color((n - 1) / (4.08567f + 1.00071f * n));
}
Color mean(ConductorFresnel const& f) {
    auto const at_normal = [](float eta, float k) {
        return (square(eta - 1) + k * k) / (square(eta + 1) + k * k);
    };
    return mean(SchlickFresnel{
        {at_normal(f.eta.r, f.k.r), at_normal(f.eta.g, f.k.g), at_normal(f.eta.b, f.k.b)}});
}
Color mean(ThinFilmFresnel const& f) { return mean(ConductorFresnel{f.eta, f.k}); }
Color mean(ThinWallFresnel const& f) {
    Color const r = mean(DielectricFresnel{f.eta});
    return r * (2 / (1 + r.r));
}

} // namespace

SchlickFresnel schlick_f82(Color const& f0, Color const& tint) {
    Color const schlick = lerp(f0, Color(1), kSchlickAtPeak);
    return {f0, Color(1), schlick * (Color(1) - tint) * (1 / kEdgePeak)};
}

Color mean_reflectance(Fresnel const& fresnel) {
    return match(fresnel, [](auto const& f) { return mean(f); });
}

Color rough_reflectance(SchlickFresnel const& f, ReflectionMoments const& m) {
    return f.f0 * m.white + (f.f90 - f.f0) * m.schlick - f.edge * m.edge;
}
Color rough_reflectance(ConductorFresnel const& f, ReflectionMoments const& m) {
    return rough_reflectance(schlick_fit(f), m);
}

} // namespace weft::lobes
