// Light that reaches a point straight from lights, and how its estimates are combined.
#pragma once

#include "film/contribution.h"
#include "integrator/path_state.h"

namespace weft::integrator {

/// The weight of a sample of density `pdf` where another strategy has density `other`: the power
/// heuristic with exponent 2 (Veach 1997, 9.2.2).
inline float power_heuristic(float pdf, float other) {
    float const ratio = other / pdf; // divided first: squares of large densities overflow
    return 1 / (1 + ratio * ratio);
}

/// Light samples at `point`, by the random numbers of `vertex`, added to `sink`: choice of up to
/// `point.at.choices` lights, shadow rays through transparent surfaces and media, MIS weights.
void direct(lights::Stage const& stage, PathSettings const& settings, PathState const& path,
            ScatterPoint const& point, sampling::SampleStream const& u, uint32_t vertex,
            film::SampleSink& sink);

/// Tells `record` of light samples at a shadow catcher that the camera sees: with nothing but
/// other catchers in the light's way, and as it is.
void catch_shadow(lights::Stage const& stage, PathSettings const& settings, PathState const& path,
                  ScatterPoint const& point, sampling::SampleStream const& u, uint32_t vertex,
                  film::SampleRecord& record);

/// The weight of light of density `light_pdf` that the ray of `path` found by itself.
float found_weight(scene::Strategy strategy, PathState const& path, float light_pdf);

} // namespace weft::integrator
