// A world is made of valid scenes alone, whoever made them.
#include <gtest/gtest.h>

#include <ctime>
#include <string>

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
    ball.traits.bsdf = add(*s, scene::MaterialKind{}, material);
    s->cameras.emplace_back(scene::Perspective{});
    s->contents.camera = {0};
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

/// A scene with a camera, and a mesh of 72 triangles that nothing shows yet.
struct Grid {
    std::shared_ptr<scene::Scene> scene = std::make_shared<scene::Scene>();
    std::shared_ptr<scene::Mesh const> mesh;

    Grid() {
        scene->cameras.emplace_back(scene::Perspective{});
        scene->contents.camera = {0};
        scene::Mesh grid;
        constexpr uint32_t side = 6;
        for (uint32_t y = 0; y <= side; ++y)
            for (uint32_t x = 0; x <= side; ++x) grid.positions.push_back({float(x), float(y), 0});
        for (uint32_t y = 0; y < side; ++y)
            for (uint32_t x = 0; x < side; ++x) {
                uint32_t const a = y * (side + 1) + x, b = a + side + 1;
                grid.triangles.push_back({{a, a + 1, b + 1}});
                grid.triangles.push_back({{a, b + 1, b}});
            }
        mesh = std::make_shared<scene::Mesh const>(std::move(grid));
    }
    /// Adds a shape of a mesh of its own.
    void add_shape() {
        scene::MeshShape shape;
        shape.filename.resource = int32_t(scene->meshes.size());
        scene->meshes.push_back(mesh);
        scene->shapes.emplace_back(shape);
    }
    /// Adds an instance of the last shape.
    scene::InstanceTraits& add_instance(Vec3d const& where) {
        scene::Instance instance;
        instance.shape = {int32_t(scene->shapes.size()) - 1};
        instance.transform.origin = where;
        scene->contents.instances.push_back({int32_t(scene->instances.size())});
        scene->instances.push_back(instance);
        return scene->instances.back().traits;
    }
};

/// So many meshes, each there twice.
std::shared_ptr<scene::Scene const> meshes_in_pairs(int count) {
    Grid grid;
    for (int i = 0; i < count; ++i) {
        grid.add_shape();
        for (double z : {0.0, 1.0}) grid.add_instance({double(i), 0, z});
    }
    return grid.scene;
}

/// So many instances of one mesh that differ in what few instances have.
std::shared_ptr<scene::Scene const> instances_that_differ(int count) {
    Grid grid;
    grid.add_shape();
    for (int i = 0; i < count; ++i) {
        scene::InstanceTraits& traits = grid.add_instance({double(i), 0, 0});
        if (i % 2)
            traits.group = std::to_string(i);
        else
            traits.trace_distance = float(i + 1);
    }
    return grid.scene;
}

/// Processor seconds of a commit, the least of three.
double seconds_to_commit(std::shared_ptr<scene::Scene const> const& scene) {
    double least = 1e9;
    for (int i = 0; i < 3; ++i) {
        std::clock_t const start = std::clock();
        World::commit(scene);
        least = std::min(least, double(std::clock() - start) / CLOCKS_PER_SEC);
    }
    return least;
}

TEST(Commit, TakesTimeInProportionToInstancedMeshes) {
    // Eight times as many: 64 times as long where each mesh looks at all objects.
    double const few = seconds_to_commit(meshes_in_pairs(500)),
                 many = seconds_to_commit(meshes_in_pairs(4000));
    EXPECT_LT(many, 24 * few);
}

TEST(Commit, TakesTimeInProportionToInstancesThatDiffer) {
    double const few = seconds_to_commit(instances_that_differ(2000)),
                 many = seconds_to_commit(instances_that_differ(16000));
    EXPECT_LT(many, 24 * few);
}

TEST(Commit, KeepsLittlePerObject) {
    auto const pairs = World::commit(meshes_in_pairs(50));
    EXPECT_EQ(pairs->object_count(), 100u);
    EXPECT_EQ(pairs->models().size(), 50u); // what looks the same is one model
    EXPECT_EQ(World::commit(instances_that_differ(50))->models().size(), 50u);
}

} // namespace
} // namespace weft::world
