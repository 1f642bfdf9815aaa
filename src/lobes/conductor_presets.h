// Metals by name, and metals by the colours an artist sees.
//
// The presets are complex indices for linear Rec. 709. They come from measured spectra, as
// collected by M. N. Polyanskiy's refractiveindex.info database (public domain, CC0):
//     gold, silver, copper  P. B. Johnson and R. W. Christy 1972, Phys. Rev. B 6, 4370
//     aluminium             A. D. Rakic 1995, Appl. Opt. 34, 4755
//     iron, chrome          P. B. Johnson and R. W. Christy 1974, Phys. Rev. B 9, 5056
//     brass (70 Cu, 30 Zn)  M. R. Querry 1985, CRDC-CR-85034
// Per channel, eta and k are those whose reflectance under eight angles (cosines 0.1 to 1) comes
// nearest to the reflectance spectrum seen by the CIE 1931 observer in even light: error below
// 0.002. Gold's red leaves the gamut; there they are the spectrum's own means.
#pragma once

#include <array>
#include <string_view>

#include "base/color.h"

namespace weft::lobes {

/// A complex index eta + i k.
struct Conductor {
    Color eta, k;
};

struct ConductorPreset {
    std::string_view name;
    Conductor conductor;
};

inline constexpr std::array<ConductorPreset, 7> conductor_presets{{
    {"gold", {{0.108f, 0.489f, 1.488f}, {3.508f, 2.272f, 1.758f}}},
    {"silver", {{0.056f, 0.055f, 0.043f}, {4.351f, 3.559f, 2.562f}}},
    {"copper", {{0.264f, 1.038f, 1.304f}, {3.191f, 2.626f, 2.347f}}},
    {"aluminium", {{1.452f, 0.991f, 0.594f}, {7.558f, 6.565f, 5.304f}}},
    {"iron", {{2.915f, 2.924f, 2.533f}, {3.066f, 2.939f, 2.742f}}},
    {"chrome", {{3.219f, 3.125f, 2.265f}, {3.291f, 3.337f, 3.105f}}},
    {"brass", {{0.447f, 0.517f, 1.146f}, {3.856f, 2.681f, 1.792f}}},
}};

/// Gulbrandsen 2014, "Artist friendly metallic Fresnel": the conductor of this reflectance at the
/// normal, and of an edge tint from 0 (the largest eta that gives it) to 1 (the smallest). Both are
/// in [0, 1]; reflectivity is taken at 0.999 at most, beyond which no finite index is.
inline Conductor artist_conductor(Color const& reflectivity, Color const& edge_tint) {
    auto const channel = [](float at_normal, float tint, float& eta, float& k) {
        float const r = std::min(std::max(at_normal, 0.f), 0.999f), root = std::sqrt(r);
        float const least = (1 - r) / (1 + r), greatest = (1 + root) / (1 - root);
        eta = tint * least + (1 - tint) * greatest;
        k = safe_sqrt((square(eta + 1) * r - square(eta - 1)) / (1 - r));
    };
    Conductor c;
    channel(reflectivity.r, edge_tint.r, c.eta.r, c.k.r);
    channel(reflectivity.g, edge_tint.g, c.eta.g, c.k.g);
    channel(reflectivity.b, edge_tint.b, c.eta.b, c.k.b);
    return c;
}

} // namespace weft::lobes
