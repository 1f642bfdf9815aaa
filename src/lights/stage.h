// A world and its lights: everything a render reads, immutable and shared by all threads.
#pragma once

#include <memory>

#include "lights/light_table.h"

namespace weft::lights {

class Stage {
  public:
    /// `compensate`: light sampling leaves to BSDF sampling what that finds well; only for renders
    /// that combine both (integrator::combines_strategies).
    /// Throws InputError where the scene cannot be rendered, std::runtime_error where memory is
    /// short.
    static std::unique_ptr<Stage const> commit(std::shared_ptr<scene::Scene const> scene,
                                               world::CommitOptions const& options = {},
                                               bool compensate = false);

    world::World const& world() const { return *world_; }
    LightTable const& lights() const { return lights_; }
    /// Returns whether lights or objects heed controls.
    bool has_controls() const { return world_->has_controls() || lights_.has_controls(); }
    /// Returns whether these depend on the kind of scattering.
    bool has_controls_by_kind() const {
        return world_->has_controls_by_kind() || lights_.has_controls_by_kind();
    }

  private:
    Stage() = default;

    std::unique_ptr<world::World const> world_; ///< before the lights, which ask its ray kernel
    LightTable lights_;
};

} // namespace weft::lights
