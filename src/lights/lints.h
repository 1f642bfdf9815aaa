// What in a committed scene is legal and hardly meant: each with where it is written and what to
// do.
//
// Lights and surfaces are looked at as a render would, by a few thousand rays, so that what no
// picture shows (a mirror behind the camera) raises no alarm.
#pragma once

#include <string>
#include <vector>

#include "lights/stage.h"

namespace weft::lights {

/// "file:line:column: what, and what to do about it". Of lights nothing is said to an integrator
/// that draws none (`normal`, `aov`, ...).
/// `where`: the place of the integrator.
std::vector<std::string> lint_warnings(Stage const& stage, scene::Integrator const& integrator,
                                       SourceLocation const& where);

/// The part of it that is about lights.
std::vector<std::string> light_warnings(Stage const& stage);

/// The part of it that is about what objects enclose: glass and media in meshes that are open or
/// turned inside out.
std::vector<std::string> solid_warnings(world::World const& world);

/// The part of it that is about meshes and lamps so far from their origin that single precision
/// has lost where they are.
std::vector<std::string> precision_warnings(world::World const& world);

} // namespace weft::lights
