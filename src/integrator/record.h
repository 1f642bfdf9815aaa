// What a path says to the record of its sample beside its contributions: the surface that it met
// first, the guides of denoisers, and how its first bounce is shared by kinds of lobes. None of it
// is called where a picture is beauty alone.
#pragma once

#include "film/sample_record.h"
#include "integrator/path_state.h"

namespace weft::integrator {

/// The path met a surface, and has not scattered there yet.
void record_surface(world::World const& world, PathState const& path,
                    shading::SurfacePoint const& point, shading::Shading const& shading,
                    film::SampleRecord& record);

/// `path` is about to scatter by `sample` at a surface.
void record_bounce(PathSettings const& settings, PathState const& path, lobes::Bsdf const& bsdf,
                   Vec3 const& wo, lobes::BsdfSample const& sample, bool see_through,
                   film::SampleRecord& record);

/// Light sampling connects the surface that the path is at to a light towards `wi`.
void record_connection(PathState const& path, lobes::Bsdf const& bsdf, Vec3 const& wo,
                       Vec3 const& wi, film::SampleRecord& record);
/// The same where only the lobes of one part do (Bsdf::eval_part).
void record_connection(PathState const& path, lobes::Bsdf const& bsdf, Vec3 const& wo,
                       Vec3 const& wi, lobes::LobeFlags part, film::SampleRecord& record);

/// The path scattered in a medium.
void record_volume(PathState const& path, film::SampleRecord& record);

/// The path met nothing; `radiance` is the background's.
void record_background(PathState const& path, Color const& radiance, film::SampleRecord& record);

} // namespace weft::integrator
