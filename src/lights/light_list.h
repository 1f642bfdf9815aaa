// The lights while they are collected, before a LightTable is made of them.
#pragma once

#include <span>
#include <vector>

#include "lights/light.h"
#include "lights/light_bounds.h"

namespace weft::lights {

/// The bounds of what shines from infinitely far away.
inline LightBounds at_infinity() {
    LightBounds bounds;
    bounds.at_infinity = true;
    return bounds;
}

/// Lights, and the leaves that the light tree is to have: one for each light, but for meshes one
/// for each triangle.
struct LightList {
    // Per light:
    std::vector<LightKind> kinds;
    std::vector<LightRules> rules;
    std::vector<LightInfo> infos;
    std::vector<uint32_t> first_leaf;

    std::vector<LightBounds> bounds; ///< per leaf
    float cross_section = 1;         ///< of the scene, for the power of what shines from infinity
    int32_t source = -1;             ///< which of the scene's lights the next ones are

    /// `leaves`: their powers are the luminance of what each emits in all.
    void add(LightKind kind, std::span<LightBounds const> leaves,
             scene::LightControls const& controls, bool hidden_from_camera = false);
    /// A light of one leaf.
    void add(LightKind kind, LightBounds where, float power, scene::LightControls const& controls,
             bool hidden_from_camera = false) {
        where.power = power;
        add(std::move(kind), std::span(&where, 1), controls, hidden_from_camera);
    }
    /// A light that is no object: hiding it from the camera is no control that takes light away.
    void add_lamp(LightKind kind, LightBounds const& where, float power,
                  scene::LightControls controls) {
        bool const hidden = !controls.visible_to_camera;
        controls.visible_to_camera = true;
        add(std::move(kind), where, power, controls, hidden);
    }
};

} // namespace weft::lights
