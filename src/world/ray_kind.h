// Which objects a ray meets, by how it came about.
#pragma once

#include "base/scattering.h"

namespace weft::world {

/// Bits of an object's mask, one of which has to be set for a ray to meet it.
using RayMask = uint32_t;

/// What light from below a surface meets is what its diffuse light does.
constexpr RayMask mask_of(RayKind kind) {
    return 1u << uint32_t(kind == RayKind::subsurface ? RayKind::diffuse : kind);
}
inline constexpr RayMask kShadowMask = 1u << 5;
/// Every object has it: rays that heed no control.
inline constexpr RayMask kUnruledMask = 1u << 6;
/// Shadow catchers have it.
inline constexpr RayMask kCatcherMask = 1u << 7;
/// From here on one for each different list of objects that block some light.
inline constexpr uint32_t kFirstLinkBit = 8, kLinkBits = 24;

} // namespace weft::world
