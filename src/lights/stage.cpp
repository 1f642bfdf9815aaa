#include "lights/stage.h"

#include "lights/light_builder.h"

namespace weft::lights {

std::unique_ptr<Stage const> Stage::commit(std::shared_ptr<scene::Scene const> scene,
                                           world::CommitOptions const& options, bool compensate) {
    std::unique_ptr<world::World> world = world::World::commit(std::move(scene), options);
    std::unique_ptr<Stage> stage(new Stage);
    stage->lights_ = LightBuilder(*world, compensate).build();
    stage->world_ = std::move(world);
    return stage;
}

} // namespace weft::lights
