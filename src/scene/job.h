// What there is to do: pictures to render and to process, as plain data. Readers make jobs of
// files; the session and the postprocesses take them and know no file format.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "base/error.h"
#include "scene/display.h"
#include "scene/postprocess.h"
#include "scene/scene.h"

namespace weft::scene {

/// One picture to render.
struct RenderJob {
    Integrator integrator;
    RenderTarget target;
    Sampler sampler;
    std::shared_ptr<Scene const> scene;
    std::string image_name; ///< names the picture's file; "" where the user has to
    std::string folder;     ///< where the file goes; "" is the current one
    std::optional<ImageTest> test;
    SourceLocation where; ///< of the integrator, for messages
};

/// One postprocess. Its ImageIds, and those of the targets of render jobs, are indices into one
/// list of `PictureName`s. A job before it makes the pictures that it reads.
struct PostprocessJob {
    Postprocess postprocess;
    size_t jobs_before = 0; ///< the number of render jobs that come before it
    SourceLocation where;   ///< for messages
    std::optional<ImageTest> test;
    std::string test_name; ///< names the files of the test
};

/// What a picture is called, which folder its file goes to, and how it is shown.
struct PictureName {
    std::string name;             ///< of the file, without its ending
    std::string folder;           ///< "" is the current one
    Display display;              ///< the default one where nothing else is said
    SourceLocation display_where; ///< empty where nothing is said about the display
    std::string file = {};        ///< the path of a picture that is there already; "" where none is
    bool linear = false;          ///< whether integers in that file are light
};

} // namespace weft::scene
