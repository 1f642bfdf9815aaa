// One sample of one pixel, whatever the integrator: the function that tiles and threads call.
#pragma once

#include "film/filter.h"
#include "integrator/path.h"
#include "scene/render_settings.h"

namespace weft::integrator {

/// Returns whether rays find what light sampling misses: see lights::Stage::commit.
bool combines_strategies(scene::Integrator const& integrator);

class PixelRenderer {
  public:
    /// `samples_per_pixel`: how many are to be taken, 0 for what the sampler says; footprints of
    /// textures are the smaller the more there are.
    PixelRenderer(lights::Stage const& stage, scene::Integrator const& integrator,
                  scene::Sampler const& sampler, uint32_t seed, int samples_per_pixel = 0);

    /// Returns the radiance that sample number `sample` of `pixel` sees: a pure function of its
    /// arguments, the seed and, where textures are filtered by footprints, the samples per pixel.
    /// `record`, where given, is cleared and then holds all else that the sample says.
    /// `lost_track`: set where the path was in more objects at once than it can remember.
    Color sample(Vec2i pixel, uint32_t sample, film::SampleRecord* record = nullptr,
                 bool* lost_track = nullptr) const;

    /// Returns whether samples are radiance, rather than some property of the scene. Radiance is
    /// not negative, and only such samples fill records.
    bool follows_light() const;

  private:
    world::Ray camera_ray(Vec2i pixel, sampling::SampleStream const& u) const;
    /// Follows a path, and where the record asks for it a second one that heeds no controls.
    Color follow_light(world::Ray const& ray, sampling::SampleStream const& stream,
                       film::SampleRecord* record, bool* lost_track) const;

    lights::Stage const& stage_;
    world::World const& world_; ///< of the stage
    scene::Integrator integrator_;
    PathSettings path_, unruled_; ///< unruled_: without controls and simpler materials
    sampling::SamplerKind sampler_;
    uint32_t seed_;
    film::Filter filter_;
    media::MediumStack media_;
};

} // namespace weft::integrator
