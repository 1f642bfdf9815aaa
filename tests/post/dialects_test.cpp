// A scene file of another dialect gives the same pictures, bit by bit, as the file in today's
// words. The files are tests/io/dialects/NAME.xml and NAME_today.xml.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <filesystem>

#include "integrator/pixel_renderer.h"
#include "io/scene_file.h"
#include "post/run.h"
#include "session/render.h"

namespace weft::post {
namespace {

std::string const kFolder = std::string(WEFT_SOURCE_DIR) + "/tests/io/dialects/";

std::vector<std::string> dialect_scenes() {
    std::vector<std::string> names;
    for (auto const& entry : std::filesystem::directory_iterator(kFolder))
        if (entry.path().extension() == ".notes") names.push_back(entry.path().stem().string());
    std::sort(names.begin(), names.end());
    return names;
}

/// The pictures of all integrators and postprocesses of a file, in this order.
std::vector<image::Image> pictures_of_file(std::string const& path) {
    io::SceneFile const file = io::read_scene_file(path);
    std::vector<image::Image> all;
    Pictures pictures;
    session::RenderOptions options;
    options.threads = 1;
    for (scene::RenderJob const& job : file.jobs) {
        auto const stage =
            lights::Stage::commit(job.scene, {}, integrator::combines_strategies(job.integrator));
        all.push_back(session::render(*stage, job, options).image);
        if (job.target.image) pictures[job.target.image.index].image = all.back();
    }
    for (scene::PostprocessJob const& job : file.postprocesses) {
        Picture made = run(job, pictures);
        all.push_back(made.image);
        pictures[scene::pictures_of(job.postprocess).output.index] = std::move(made);
    }
    return all;
}

class DialectPictures : public ::testing::TestWithParam<std::string> {};

TEST_P(DialectPictures, HaveTheSameBits) {
    auto const old = pictures_of_file(kFolder + GetParam() + ".xml"),
               today = pictures_of_file(kFolder + GetParam() + "_today.xml");
    ASSERT_EQ(old.size(), today.size());
    ASSERT_FALSE(old.empty());
    for (size_t i = 0; i < old.size(); ++i) {
        ASSERT_EQ(old[i].pixels.size(), today[i].pixels.size());
        EXPECT_EQ(std::memcmp(old[i].pixels.data(), today[i].pixels.data(),
                              old[i].pixels.size() * sizeof(float)),
                  0)
            << "picture " << i;
        EXPECT_TRUE(
            std::any_of(old[i].pixels.begin(), old[i].pixels.end(), [](float v) { return v > 0; }))
            << "picture " << i;
    }
}

INSTANTIATE_TEST_SUITE_P(All, DialectPictures, ::testing::ValuesIn(dialect_scenes()),
                         [](auto const& tested) { return tested.param; });

} // namespace
} // namespace weft::post
