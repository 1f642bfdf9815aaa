// Light that reaches a vertex straight from lights, found by sampling lights.
#pragma once

#include "integrator/vertex.h"

namespace weft::integrator {

/// Returns the weight of a sample of density `pdf` where another strategy gives it with the density
/// `other`: the power heuristic with exponent 2 (Veach 1997, 9.2.2).
inline float power_heuristic(float pdf, float other) {
    float const ratio = other / pdf; // divided first: squares of large densities overflow
    return 1 / (1 + ratio * ratio);
}

/// Samples lights from `here`, where the path has not been scattered yet, and adds what they send
/// along the path: with shadow rays through transparent surfaces and media, and weighed against
/// what the path's next ray finds.
void direct(Tracer const& t, PathState const& path, Vertex const& here);

/// Tells the record of light at a shadow catcher that the camera sees: as it is, and as it would be
/// with only other catchers in the light's way.
void catch_shadow(Tracer const& t, PathState const& path, Vertex const& here);

} // namespace weft::integrator
