// The limit that the ray kernel sets: the rays of a render traced again, and nothing else.
#pragma once

#include "world/ray_recorder.h"
#include "world/world.h"

namespace weft::bench {

/// What a stretch of work took.
struct Cost {
    double wall = 0; ///< s
    double cpu = 0;  ///< s, of all threads of the process
};

/// Traces `rays` with as many threads as the render had, each thread its own rays in their order.
/// A thread that runs out takes over from the others, a chunk at a time, so that all end together
/// as those of a render do. Surfaces of partial opacity are asked for it as in the render.
Cost replay(world::World const& world, world::RayRecorder const& rays);

/// Adds up cost between its making and `stop`.
class Stopwatch {
  public:
    Stopwatch();
    Cost stop() const;

  private:
    Cost start_;
};

} // namespace weft::bench
