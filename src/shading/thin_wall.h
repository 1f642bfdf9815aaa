// Sheets of a dielectric so thin that light leaves them where it went in: window panes, bubbles,
// lampshades. Both sides are one surface, which light crosses without a bend.
#pragma once

#include "shading/lobe_builder.h"

namespace weft::shading {

/// What the sheet reflects, and factors on it and on what gets through.
struct ThinWall {
    lobes::ThinWallFresnel fresnel;
    Color reflectance, transmittance;
};

/// Returns the roughness of what is seen through a sheet whose sides have `roughness`: the higher
/// its index, the more its facets deflect (Burley 2015, section 5, thin surfaces).
inline float roughness_through(float roughness, float ior) {
    return unit(roughness * (0.65f * ior - 0.35f));
}

/// Adds the lobes of a sheet around `frame`, the frame in use. It gets `share` of the light.
/// Without a distribution what is reflected, or what gets through, is clear.
template <class Distribution>
void add_thin_wall(LobeBuilder const& b, float share, ThinWall const& wall, Frame const& frame,
                   std::optional<Distribution> const& reflecting,
                   std::optional<Distribution> const& transmitting) {
    Color reflected;
    if (reflecting) {
        reflected = b.add_layer(
            share * wall.reflectance,
            lobes::MicrofacetReflection<Distribution>{*reflecting, wall.fresnel, true}, frame);
    } else {
        reflected = lobes::reflectance(wall.fresnel, std::abs(dot(frame.n, b.view.wo)));
        b.add(share * wall.reflectance * reflected, lobes::SpecularReflection{});
    }
    Color const through = share * wall.transmittance * rest_of(reflected);
    if (transmitting)
        b.add(through, lobes::ThinTransmission<Distribution>(*transmitting));
    else
        b.add(through, lobes::Transparent{});
}

} // namespace weft::shading
