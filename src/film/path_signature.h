// How a path travelled, and what it brought.
#pragma once

#include <cstdint>

#include "base/color.h"

namespace weft::film {

/// What a path did at a vertex.
enum class Bounce : uint8_t {
    None,
    Diffuse,
    Glossy,
    Specular,
    DiffuseTransmission,
    GlossyTransmission,
    SpecularTransmission,
    Volume,
    Subsurface
};

/// The kinds of a path's bounces from the camera on: 4 bits each, the first 16 of them.
class PathSignature {
  public:
    void append(Bounce bounce) {
        if (length_ < 16) bits_ |= uint64_t(bounce) << (4 * length_);
        ++length_;
    }
    uint32_t length() const { return length_; } ///< all bounces, those beyond the 16th included
    /// None beyond the end and beyond the 16th.
    Bounce operator[](uint32_t i) const {
        return i < 16 ? Bounce((bits_ >> (4 * i)) & 15) : Bounce::None;
    }

  private:
    uint64_t bits_ = 0;
    uint32_t length_ = 0;
};

/// How the light of a contribution was found.
enum class Found : uint8_t {
    ByRay,            ///< a ray met the light
    InBackground,     ///< a ray left the scene
    SampledInMedium,  ///< light sampling at a point in a medium, which `path` ends with
    SampledAtSurface, ///< light sampling at a surface, which `path` does not hold as a bounce,
                      ///< since several lobes may share it
};

struct Contribution {
    Color value;        ///< radiance at the camera
    int32_t light = -1; ///< index of the light; -1: an emissive object that is no light
    PathSignature const& path;
    int32_t object = -1; ///< index of the emissive object that a ray met; -1: none
    Found found = Found::ByRay;

    bool is_sampled() const {
        return found == Found::SampledInMedium || found == Found::SampledAtSurface;
    }
    /// Returns how often the light was scattered on its way to the camera.
    uint32_t bounces() const { return path.length() + (found == Found::SampledAtSurface ? 1 : 0); }
};

} // namespace weft::film
