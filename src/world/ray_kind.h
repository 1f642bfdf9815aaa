// How a ray came about, and which objects it meets.
#pragma once

#include <cstdint>

namespace weft::world {

enum class RayKind : uint8_t { camera, diffuse, glossy, transmission, volume };
inline constexpr uint32_t kRayKinds = 5;

/// What of an object's mask has to be set for a ray to meet it.
using RayMask = uint32_t;

constexpr RayMask mask_of(RayKind kind) { return 1u << uint32_t(kind); }
inline constexpr RayMask kShadowMask = 1u << kRayKinds;
/// Every object has it: rays that heed no control.
inline constexpr RayMask kUnruledMask = 1u << 6;
/// Shadow catchers have it.
inline constexpr RayMask kCatcherMask = 1u << 7;
/// From here on one for each different list of objects that block some light.
inline constexpr uint32_t kFirstLinkBit = 8, kLinkBits = 24;

} // namespace weft::world
