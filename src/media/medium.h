// Homogeneous participating media: transmittance and distance sampling.
//
// Coefficients may differ by channel. A distance is drawn from one channel, chosen by how much
// the path still carries there, and weighted by the mean density over all channels (the one-sample
// model of multiple importance sampling with the balance heuristic, Veach 1997, 9.2.4; spectral
// MIS in Wilkie et al. 2014), so that the weight stays bounded whatever the colour.
#pragma once

#include "base/color.h"

namespace weft::media {

struct Medium {
    Color absorption; ///< per scene unit
    Color scattering; ///< per scene unit
    float g = 0;      ///< Henyey-Greenstein asymmetry

    Color extinction() const { return absorption + scattering; }
};

/// exp(-extinction * distance); 0 at infinity wherever the extinction is not 0.
inline Color transmittance(Medium const& medium, float distance) {
    Color const e = medium.extinction();
    auto one = [&](float sigma) { return sigma == 0 ? 1.f : std::exp(-sigma * distance); };
    return {one(e.r), one(e.g), one(e.b)};
}

struct MediumSample {
    bool scattered; ///< at `distance`; else the path reached `distance_limit`
    float distance;
    Color weight; ///< transmittance (times scattering coefficient) over probability
};

/// Draws how far a path of the given throughput gets before it scatters. `u.x` picks the channel,
/// `u.y` the distance; `distance_limit` may be infinite.
inline MediumSample sample_distance(Medium const& medium, Color const& throughput,
                                    float distance_limit, Vec2 u) {
    Color const sigma = medium.extinction();
    float const total = throughput.r + throughput.g + throughput.b;
    Color const pick = total > 0 ? throughput / total : Color(1 / 3.f);
    int const channel = u.x < pick.r ? 0 : u.x < pick.r + pick.g ? 1 : 2;
    float const distance = sigma[channel] > 0 ? -std::log1p(-u.y) / sigma[channel] : kInfinity;
    bool const scattered = distance < distance_limit;
    Color const tr = transmittance(medium, scattered ? distance : distance_limit);
    Color const density = scattered ? sigma * tr : tr;
    float const pdf = pick.r * density.r + pick.g * density.g + pick.b * density.b;
    if (!(pdf > 0)) return {false, distance_limit, Color(0)};
    return {scattered, std::min(distance, distance_limit),
            (scattered ? medium.scattering * tr : tr) / pdf};
}

} // namespace weft::media
