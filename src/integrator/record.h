// What a path tells the record of its sample beside the light that it finds: the surface that it
// met first, the guides of denoisers, how its first bounce is shared by kinds of lobes, and the log
// of a replay. Only to be called where the tracer has a record.
#pragma once

#include "film/sample_record.h"
#include "integrator/vertex.h"

namespace weft::integrator {

/// The path reached `here`, and was not scattered there yet.
void record_vertex(Tracer const& t, PathState const& path, Vertex const& here);

/// The path is about to scatter at a surface by `sample`.
void record_bounce(Tracer const& t, PathState const& path, SurfaceVertex const& surface,
                   lobes::BsdfSample const& sample);

/// Light sampling connects `here` to a light towards `wi`. `part`: the lobes that take part, where
/// parts are told apart.
void record_connection(Tracer const& t, PathState const& path, Vertex const& here, Vec3 const& wi,
                       ScatteringKind part);

/// The path met nothing; `radiance` is the background's.
void record_background(PathState const& path, Color const& radiance, film::SampleRecord& record);

} // namespace weft::integrator
