// How a path gets from one vertex to the next: in a straight line through media, and through all
// that it does not see.
#pragma once

#include "integrator/vertex.h"

namespace weft::integrator {

/// Follows the path's ray to the next place where the path may scatter, and moves `here` there. On
/// the way it adds the light of lamps that the ray meets. Returns false where there is no such
/// place: the ray left the scene, and the background's light was added; the camera looks into a
/// hole that an object cuts; or the ray met so many surfaces that it is taken for lost.
bool find_vertex(Tracer const& t, PathState& path, Vertex& here);

/// Lets the path go straight on behind a surface that lets it through.
void pass_through(PathState& path, SurfaceVertex const& surface);

/// Follows a camera ray like `find_vertex`, but also behind what lets it straight through. Returns
/// the surface that the path scatters at first; null where it meets none, or scatters in a medium
/// before. The surface is that of `here`.
SurfaceVertex const* find_first_surface(Tracer const& t, PathState& path, Vertex& here);

} // namespace weft::integrator
