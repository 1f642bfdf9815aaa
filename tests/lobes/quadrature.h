// The albedo of a smooth lobe by its own samples, over a low-discrepancy sequence.
#pragma once

#include "lobes/lobe.h"

namespace weft::lobes::testing {

/// u of a low-discrepancy sequence: M. Roberts 2018, the R3 sequence.
inline Vec3 r3(int i) {
    auto const part = [&](double a) { return float(std::fmod(0.5 + a * (i + 1), 1.0)); };
    Vec3 const u(part(0.8191725133961645), part(0.6710436067037893), part(0.5497004779019703));
    return {std::min(u.x, kOneMinusEpsilon), std::min(u.y, kOneMinusEpsilon),
            std::min(u.z, kOneMinusEpsilon)};
}

template <class L>
Color quadrature_albedo(L const& lobe, Vec3 const& wo, int samples) {
    Vec3d sum(0);
    for (int i = 0; i < samples; ++i) {
        Vec3 const wi = lobe.sample(wo, r3(i));
        if (wi == Vec3(0)) continue;
        LobeValue const v = lobe.eval(wo, wi);
        if (!(v.pdf > 0)) continue;
        Color const w = v.f * (eta_scale_towards(lobe, wi) / v.pdf);
        sum += Vec3d(w.r, w.g, w.b);
    }
    return {float(sum.x / samples), float(sum.y / samples), float(sum.z / samples)};
}

} // namespace weft::lobes::testing
