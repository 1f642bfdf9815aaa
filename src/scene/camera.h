// Cameras. All look along their local +z, with image x along local +x and image y (downwards)
// along local +y; a pinhole's pixel grid spans [-1, 1] along `fovAxis` at the field of view.
#pragma once

#include <array>
#include <string_view>
#include <variant>

#include "scene/dialects.h"
#include "scene/handles.h"
#include "schema/describe.h"

namespace weft::scene {

enum class FovAxis { x, y };
constexpr auto choices(FovAxis) { return std::array<std::string_view, 2>{"x", "y"}; }

/// What every camera has: the picture's size and the camera's place.
struct Viewpoint {
    int width = 1280;
    int height = 720;
    Affined transform;

    template <class F>
    constexpr void describe(F&& f) {
        f("width", width,
          {.unit = "pixels", .min = 1, .max = 65536, .help = "Width of the picture."});
        f("height", height,
          {.unit = "pixels", .min = 1, .max = 65536, .help = "Height of the picture."});
        f("transform", transform, {.help = "From the camera's space to the world."});
    }
};

struct Perspective {
    static constexpr schema::TypeInfo info{
        .category = "camera",
        .type = "perspective",
        .help = "A pinhole camera: everything is in focus.",
        .example =
            "<camera type=\"perspective\" width=\"1280\" height=\"720\" fov=\"40\">\n"
            "  <transform><lookat origin=\"0,-1,-4\" target=\"0,0,0\" up=\"0,1,0\"/></transform>\n"
            "</camera>"};
    Viewpoint view;
    float fov = 45;
    FovAxis fov_axis = FovAxis::x;

    template <class F>
    constexpr void describe(F&& f) {
        f.group(view);
        f("fov", fov,
          {.unit = "deg",
           .min = 0.001,
           .max = 179.9,
           .help = "Full opening angle over the axis `fovAxis`."});
        f("fovAxis", fov_axis, {.help = "The image axis that `fov` spans."});
    }
};

/// What teams of lightwave say of lenses beside other names of the parameters.
namespace dialects {
inline constexpr std::string_view kEvenAperture =
    "has no effect: light passes the whole aperture alike, or as the image `bokeh` says";
inline constexpr std::array kLenses{
    Spelling{.type = "thin_lens", .today = "is <camera type=\"thinlens\"> today"},
    Spelling{.type = "thinLens", .today = "is <camera type=\"thinlens\"> today"},
    Spelling{.parameter = "bokeh", .today = "is the name of a file today", .rewrite = bokeh_file},
    Spelling{.parameter = "innerRadius", .today = kEvenAperture},
    Spelling{.parameter = "rateOfChange", .today = kEvenAperture},
    Spelling{.parameter = "weightDistr", .today = kEvenAperture},
    Spelling{.parameter = "weightStrength", .today = kEvenAperture},
};
} // namespace dialects

struct ThinLens {
    static constexpr schema::TypeInfo info{
        .category = "camera",
        .type = "thinlens",
        .help = "A lens of finite size: what is not at the focal distance blurs, in the shape of "
                "the aperture (a disk, a polygon, or an image).",
        .example = "<camera type=\"thinlens\" width=\"1280\" height=\"720\" fov=\"40\"\n"
                   "        lensRadius=\"0.05\" focalDistance=\"4\" blades=\"6\"/>",
        .spellings = dialects::kLenses};
    Viewpoint view;
    float fov = 45;
    FovAxis fov_axis = FovAxis::x;
    float lens_radius = 0.1f;
    float focal_distance = 1;
    int blades = 0;
    float blade_rotation = 0;
    FileName bokeh;

    template <class F>
    constexpr void describe(F&& f) {
        f.group(view);
        f("fov", fov,
          {.unit = "deg",
           .min = 0.001,
           .max = 179.9,
           .help = "Full opening angle over the axis `fovAxis`."});
        f("fovAxis", fov_axis, {.help = "The image axis that `fov` spans."});
        f("lensRadius", lens_radius,
          {.unit = "scene",
           .min = 0,
           .help = "Radius of the lens; 0 is a pinhole.",
           .aliases = {"radius", "apertureRadius",
                       schema::Alias{"aperture", "it is taken for the radius of the lens, not for "
                                                 "its diameter or an f-number"}}});
        f("focalDistance", focal_distance,
          {.unit = "scene",
           .min = 1e-12,
           .help = "Distance of the plane of focus, along the view axis.",
           .aliases = {schema::Alias{"focusDistance",
                                     "what is in focus lies in a plane at this distance; the team "
                                     "that says so focuses on a sphere, which differs towards the "
                                     "edges of the picture"},
                       "f"}});
        f("blades", blades,
          {.min = 0,
           .max = 64,
           .help = "Number of aperture blades; fewer than 3 is a round aperture.",
           .aliases = {"lenselements"}});
        f("bladeRotation", blade_rotation,
          {.unit = "deg", .help = "Rotation of the polygonal aperture."});
        f("bokeh", bokeh,
          {.help =
               "An image whose brightness is the aperture's transmission relative to its mean, so "
               "that the exposure stays; it fills the square around the lens."});
    }
};

struct Orthographic {
    static constexpr schema::TypeInfo info{
        .category = "camera",
        .type = "orthographic",
        .help = "Parallel projection: size does not depend on distance."};
    Viewpoint view;
    float scale = 1;
    FovAxis fov_axis = FovAxis::x;

    template <class F>
    constexpr void describe(F&& f) {
        f.group(view);
        f("scale", scale,
          {.unit = "scene",
           .min = 1e-12,
           .help = "Half of the picture's extent along the axis `fovAxis`.",
           .aliases = {schema::Alias{"fov",
                                     "an angle has no meaning for parallel rays; it is taken for "
                                     "the extent that it spans at a distance of 1",
                                     dialects::scale_of_fov}}});
        f("fovAxis", fov_axis, {.help = "The image axis that `scale` spans."});
    }
};

struct EnvironmentCamera {
    static constexpr schema::TypeInfo info{
        .category = "camera",
        .type = "environment",
        .help = "The whole sphere of directions as a latitude-longitude picture that an `envmap` "
                "light of the same transform would show again."};
    Viewpoint view;

    template <class F>
    constexpr void describe(F&& f) {
        f.group(view);
    }
};

using Camera = std::variant<Perspective, ThinLens, Orthographic, EnvironmentCamera>;

} // namespace weft::scene
