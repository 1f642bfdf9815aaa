// Renders a scene a few times and says how fast that was, measured in several ways.
#pragma once

#include <string>

#include "image/image.h"
#include "world/ray_recorder.h"

namespace weft::bench {

struct RenderFigures {
    size_t triangles = 0;      ///< instances counted as often as they stand
    int width = 0, height = 0; ///< pixels
    uint32_t spp = 0;          ///< samples per pixel
    double seconds = 0;        ///< wall time of the fastest of the renders
    double pixel_samples_per_second = 0;
    double rays_per_second = 0; ///< closest-hit and shadow rays
    double rays_per_sample = 0;
    double shadow_rays = 0; ///< their part of all rays
    double share = 0;       ///< of the raw limit: kernel time / render time, wall clock
    double cpu_share = 0;   ///< the same in processor time, which other programs disturb less
    double variance = 0;    ///< mean of v / (m^2 + 0.01) over pixels, from two seeds
};

/// Returns the mean of v / (m^2 + 0.01) over the pixels of two independent renders of one scene of
/// RGB: of the luminances x and y of a pixel, m is the mean and v = (x - y)^2 / 2 estimates the
/// variance.
double relative_variance(image::Image const& a, image::Image const& b);

/// Renders the first job of a scene file `rounds` times (at least 2), each with its own seed and
/// each followed by a replay of the recorded rays; the best of each counts. Rays are recorded
/// with `recorder`, whose lists are emptied, and at no more samples per pixel than keep them
/// within about a gigabyte: the replay is then scaled by the number of samples.
/// Throws InputError.
RenderFigures measure_render(std::string const& scene_file, world::RayRecorder& recorder,
                             int rounds = 3);

} // namespace weft::bench
