// A world is made of valid scenes alone, whoever made them.
#include <gtest/gtest.h>

#include "scene/scene_vectors.h"
#include "world/world.h"

namespace weft::world {
namespace {

/// A sphere of this material, in front of a camera.
std::shared_ptr<scene::Scene const> sphere_of(scene::Material const& material) {
    auto s = std::make_shared<scene::Scene>();
    scene::Instance ball;
    ball.shape = add(*s, scene::ShapeKind{}, scene::Sphere{});
    add(*s, scene::MaterialKind{}, scene::Diffuse{});
    ball.bsdf = add(*s, scene::MaterialKind{}, material);
    s->contents.camera = add(*s, scene::CameraKind{}, scene::Perspective{});
    s->contents.instances = {add(*s, scene::InstanceKind{}, ball)};
    return s;
}

TEST(Commit, TakesScenesWithoutPlaces) {
    EXPECT_EQ(World::commit(sphere_of(scene::Mix{.bsdfs = {{0}, {0}}}))->statistics().objects, 1u);
}

TEST(Commit, RefusesScenesThatAreNotValid) {
    EXPECT_THROW(World::commit(sphere_of(scene::Mix{.bsdfs = {{0}}})), InputError);
    EXPECT_THROW(World::commit(sphere_of(scene::Mix{.bsdfs = {{0}, {1}}})), InputError);
    EXPECT_THROW(World::commit(sphere_of(scene::Secondary{})), InputError);
    EXPECT_THROW(World::commit(sphere_of(scene::Diffuse{.albedo = {Color(0), {7}}})), InputError);
}

} // namespace
} // namespace weft::world
