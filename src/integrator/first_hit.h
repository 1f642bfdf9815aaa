// Integrators that follow no light: they draw a property of the camera ray, or of the surface that
// a path of the same sample scatters at first. So they see what paths see: not what hides from the
// camera, but what lies behind holes, holdouts and the boundaries of fog, and nothing where the fog
// itself scatters.
#pragma once

#include "integrator/tracer.h"

namespace weft::integrator {

/// Returns the property for one camera ray, which starts within `media`.
Color draw(scene::CameraIntegrator const& i, Tracer const& t, world::Ray const& ray,
           media::MediumStack const& media);
Color draw(scene::AovIntegrator const& i, Tracer const& t, world::Ray const& ray,
           media::MediumStack const& media);
Color draw(scene::NormalIntegrator const& i, Tracer const& t, world::Ray const& ray,
           media::MediumStack const& media);
Color draw(scene::AlbedoIntegrator const& i, Tracer const& t, world::Ray const& ray,
           media::MediumStack const& media);

} // namespace weft::integrator
