// One sample of one pixel, whatever the integrator: the function that tiles and threads call.
#pragma once

#include "film/filter.h"
#include "integrator/path.h"
#include "scene/render_settings.h"

namespace weft::integrator {

class PixelRenderer {
  public:
    PixelRenderer(world::World const& world, scene::Integrator const& integrator,
                  scene::Sampler const& sampler, uint32_t seed);

    /// The radiance that sample number `sample` of `pixel` sees: a pure function of its arguments
    /// and the seed.
    Color sample(Vec2i pixel, uint32_t sample) const;

  private:
    Color trace(scene::CameraIntegrator const& i, world::Ray const& ray) const;
    Color trace(scene::AovIntegrator const& i, world::Ray const& ray) const;
    Color trace(scene::NormalIntegrator const& i, world::Ray const& ray) const;
    Color trace(scene::AlbedoIntegrator const& i, world::Ray const& ray) const;

    world::World const& world_;
    scene::Integrator integrator_;
    PathSettings path_;
    sampling::SamplerKind sampler_;
    uint32_t seed_;
    film::Filter filter_;
    media::MediumStack media_;
};

} // namespace weft::integrator
