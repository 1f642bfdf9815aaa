// The words for how light is scattered, which lobes, media, paths, the controls of lights and
// objects, and pictures by component share.
//
// A new kind of scattering is one line in `ScatteringKind`, and one more case in each `switch`
// below, which the compiler asks for. Nothing outside of this file lists the kinds.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace weft {

enum class ScatteringKind : uint8_t {
    Diffuse,    ///< by a surface, into every direction of a side
    Subsurface, ///< diffusely, by what lies below a surface
    Glossy,     ///< by a rough surface or a fibre, around some direction
    Specular,   ///< by a smooth surface, into single directions
    Straight,   ///< a surface lets the light straight through
    Medium,     ///< at a point in a medium
};

/// What happens to light at one vertex of a path.
struct Scattering {
    ScatteringKind kind = ScatteringKind::Diffuse;
    bool through = false; ///< the light goes to the other side of a surface

    friend bool operator==(Scattering const&, Scattering const&) = default;
};

/// Returns whether light goes into finitely many directions, which no other strategy finds.
constexpr bool is_delta(ScatteringKind kind) {
    switch (kind) {
    case ScatteringKind::Diffuse:
    case ScatteringKind::Subsurface:
    case ScatteringKind::Glossy:
    case ScatteringKind::Medium:
        return false;
    case ScatteringKind::Specular:
    case ScatteringKind::Straight:
        return true;
    }
    return false;
}

/// Returns whether the direction of the light before is forgotten: what is mirrored or refracted
/// after such a scattering is a caustic.
constexpr bool is_diffuse(ScatteringKind kind) {
    switch (kind) {
    case ScatteringKind::Diffuse:
    case ScatteringKind::Subsurface:
    case ScatteringKind::Medium:
        return true;
    case ScatteringKind::Glossy:
    case ScatteringKind::Specular:
    case ScatteringKind::Straight:
        return false;
    }
    return false;
}

/// The kinds of rays that users tell apart, by what they left: the controls of lights and objects
/// have a switch or a factor for each, and pictures by component a picture for each but `camera`.
enum class RayKind : uint8_t { camera, diffuse, glossy, transmission, volume, subsurface };
inline constexpr size_t kRayKinds = 6;
inline constexpr std::array<RayKind, kRayKinds> kAllRayKinds{RayKind::camera, RayKind::diffuse,
                                                             RayKind::glossy, RayKind::transmission,
                                                             RayKind::volume, RayKind::subsurface};

constexpr RayKind ray_kind(Scattering s) {
    if (s.through) return RayKind::transmission;
    switch (s.kind) {
    case ScatteringKind::Diffuse:
        return RayKind::diffuse;
    case ScatteringKind::Subsurface:
        return RayKind::subsurface;
    case ScatteringKind::Glossy:
    case ScatteringKind::Specular:
    case ScatteringKind::Straight:
        return RayKind::glossy;
    case ScatteringKind::Medium:
        return RayKind::volume;
    }
    return RayKind::glossy;
}

/// One kind for each part of a BSDF that the controls of lights tell apart.
inline constexpr std::array kParts{ScatteringKind::Diffuse, ScatteringKind::Subsurface,
                                   ScatteringKind::Glossy};

/// Returns whether lobes of the two kinds belong to the same part.
constexpr bool same_part(ScatteringKind a, ScatteringKind b) {
    return ray_kind({a, false}) == ray_kind({b, false});
}

/// Returns what the scattering is called in reports.
constexpr std::string_view text_of(Scattering s) {
    switch (s.kind) {
    case ScatteringKind::Diffuse:
        return s.through ? "diffuse transmission" : "diffuse reflection";
    case ScatteringKind::Subsurface:
        return "scattering below the surface";
    case ScatteringKind::Glossy:
        return s.through ? "glossy transmission" : "glossy reflection";
    case ScatteringKind::Specular:
        return s.through ? "clear transmission" : "mirror reflection";
    case ScatteringKind::Straight:
        return "straight transmission";
    case ScatteringKind::Medium:
        return "scattering in a medium";
    }
    return "";
}

} // namespace weft
