// What every step of a path is given, beside the path itself.
#pragma once

#include "film/contribution.h"
#include "lights/stage.h"
#include "sampling/stream.h"
#include "scene/render_settings.h"

namespace weft::integrator {

struct PathSettings {
    scene::Strategy strategy = scene::Strategy::mis;
    uint32_t depth = 16;         ///< most vertices of a path, where the first hit is number 1
    uint32_t roulette_depth = 3; ///< vertices before which no Russian roulette is played
    float footprint_scale = 1;   ///< see world::footprint_scale
    bool full_materials = false; ///< no material has a simpler stand-in
    bool controls = true;        ///< lights and objects heed theirs
    bool by_part = false;        ///< some light's controls differ by the kind of scattering
    bool fold_normals = false;   ///< see lobes::BentNormals
    uint32_t light_samples = 1;  ///< most lights sampled at a path's first smooth scattering
    bool caustics = true, secondary_specular = true;
    float secondary_roughness = 0;
    float indirect_clamp = kInfinity;
};

/// The surroundings of one sample of one pixel. All of it outlives the tracer.
struct Tracer {
    world::World const& world;
    lights::LightTable const& lights; ///< of the world
    PathSettings const& settings;
    sampling::SampleStream const& stream; ///< random numbers, by dimension and step
    film::SampleSink& sink;               ///< takes the light that is found

    /// Returns what the sample says beside its colour; null where beauty is all that is wanted.
    film::SampleRecord* record() const { return sink.record(); }
};

} // namespace weft::integrator
