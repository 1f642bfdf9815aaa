// Camera-relative rendering: scenes far from their origin, such as maps in metres east and north of
// one (4e6 and more), in whose coordinates single precision has steps of half a metre. Production
// renderers place the world around the camera, in double precision, and so do we.
#pragma once

#include <memory>

#include "scene/scene.h"

namespace weft::scene {

/// From this distance between the camera and the origin on, in units of the scene, one may be
/// moved. There single precision has steps of 6e-5.
inline constexpr double kFarAway = 1000;

/// A scene, and where its origin lies in the one that it was made from.
struct PlacedScene {
    std::shared_ptr<Scene const> scene;
    Vec3d origin{0, 0, 0};
};

/// Returns the scene, or where its camera and most of its instances are far from the origin a copy
/// that is moved so that the camera stands near it. Indices stay what they are.
PlacedScene camera_relative(std::shared_ptr<Scene const> scene);

} // namespace weft::scene
