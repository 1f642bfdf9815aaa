// Postprocesses of a scene file, on pictures in memory.
#include <gtest/gtest.h>

#include "io/scene_file.h"
#include "post/denoise.h"
#include "post/run.h"
#include "tests/post/pictures.h"

namespace weft::post {
namespace {

using namespace weft::testing;

io::SceneFile parse(std::string const& postprocess) {
    return io::parse_scene(
        "<scene id='room'><camera type='perspective'/></scene>"
        "<integrator type='path'><ref id='room'/><image id='noisy'/></integrator>"
        "<integrator type='albedo'><ref id='room'/><image id='albedo'/></integrator>"
        "<integrator type='normal'><ref id='room'/><image id='normal'/></integrator>\n" +
            postprocess,
        "s.xml", "");
}

/// Pictures for the file's three integrators.
Pictures pictures_for(io::SceneFile const& file, image::Image const& color,
                      image::Image const& guide) {
    Pictures pictures;
    for (size_t i = 0; i < 3; ++i)
        pictures[file.jobs[i].target.image.index] = {
            i == 0 ? color : guide, {.texts = {{"Owner", "me"}}}, {}};
    return pictures;
}

TEST(Run, DenoisesWhatTheFileNames) {
    auto const file = parse("<postprocess type='denoising' backend='nlm'>"
                            "<ref name='input' id='noisy'/><ref name='albedo' id='albedo'/>"
                            "<ref name='normal' id='normal'/><image id='clean'/></postprocess>");
    image::Image const color = noisy_picture(40, 30), guide = constant_picture(40, 30, 0.75f),
                       normals = constant_picture(40, 30, 0.5f);
    Picture const result = run(file.postprocesses.at(0), pictures_for(file, color, guide));
    DenoiseOptions options;
    options.backend = Backend::nlm;
    EXPECT_EQ(result.image.pixels, denoise({&color, &guide, &normals}, options).image.pixels);
    EXPECT_EQ(result.header.texts,
              (image::Metadata{{"Owner", "me"}, {"weft:postprocess", "denoising (nlm)"}}));
}

TEST(Run, NotesEachStep) {
    auto const file = parse("<postprocess type='denoising' backend='nlm'>"
                            "<ref name='input' id='noisy'/><image id='once'/></postprocess>"
                            "<postprocess type='denoising' backend='nlm'>"
                            "<ref name='input' id='once'/><image id='twice'/></postprocess>");
    image::Image const color = noisy_picture(20, 20);
    Pictures pictures = pictures_for(file, color, color);
    for (auto const& job : file.postprocesses) {
        Picture made = run(job, pictures);
        pictures[scene::pictures_of(job.postprocess).output.index] = std::move(made);
    }
    auto const last = scene::pictures_of(file.postprocesses[1].postprocess).output;
    EXPECT_EQ(pictures.at(last.index).header.texts.at("weft:postprocess"),
              "denoising (nlm), denoising (nlm)");
}

TEST(Run, SaysWhichPicturesDoNotGoTogether) {
    auto const file = parse("<postprocess type='denoising'><ref name='input' id='noisy'/>"
                            "<ref name='albedo' id='albedo'/><image id='clean'/></postprocess>");
    try {
        run(file.postprocesses.at(0),
            pictures_for(file, noisy_picture(40, 30), constant_picture(41, 30, 1)));
        ADD_FAILURE() << "no error";
    } catch (InputError const& e) {
        EXPECT_STREQ(
            e.what(),
            "s.xml:2:1: the albedo expects the size of the picture, 40 x 30, found 41 x 30");
    }
}

} // namespace
} // namespace weft::post
