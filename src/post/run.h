// Runs the postprocesses of a scene file: pictures in memory go in, one comes out.
//
// A further kind of postprocess is an overload of `apply` (post/apply.h; scene/postprocess.h lists
// the other steps).
#pragma once

#include <map>

#include "image/write.h"
#include "scene/job.h"

namespace weft::post {

struct Picture {
    /// Linear. Of one with the channels R, G and B these are the colours, and all others go along.
    image::Image image;
    image::ExrHeader header; ///< what a file of it says
    std::string original;    ///< the file that it comes from, or "": its header says more
};

/// What the integrators and postprocesses of a file have made so far, by ImageId::index.
using Pictures = std::map<int32_t, Picture>;

/// Makes the picture that `job` describes. All that it reads must be in `pictures`. It is its
/// `input` with other colours: further channels and the header stay, and "weft:postprocess" says
/// how it was made. Throws InputError, with the place of the job, where its pictures do not go
/// together or it cannot be done on this machine.
Picture run(scene::PostprocessJob const& job, Pictures const& pictures);

} // namespace weft::post
