// Albedos of rough boundaries that have too many parameters for tables made in advance.
//
// Stretched boundaries, and those with options, are added up over a fixed set of normals. That
// takes some 50 microseconds, too long for every hit. So it is done at the nodes of a lattice over
// all parameters, only at those that a picture needs, and once for each (base/memo.h).
#pragma once

#include "lobes/dielectric_boundary.h"
#include "lobes/microfacet.h"

namespace weft::lobes {

/// Returns the fractions of light from unit `wo` (wo.z > 0) that a rough untinted boundary reflects
/// and transmits in one scattering. `eta` is that of MicrofacetDielectric, and not 1. The sum of
/// both is good to 1e-2, and to 2e-3 in the mean over all parameters; what is reflected jumps at
/// the critical angle of smooth glass and may be off by 0.1 there.
template <class Distribution>
BoundarySplit boundary_albedo(Distribution const& distribution, float eta,
                              BoundaryOptions const& options, Vec3 const& wo);

/// Returns the same without the lattice: the mean over `n` normals.
template <class Distribution>
BoundarySplit boundary_albedo_over_normals(Distribution const& distribution, float eta,
                                           BoundaryOptions const& options, Vec3 const& wo, int n);

} // namespace weft::lobes
