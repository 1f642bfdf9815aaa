// How a path travelled, and what it brought.
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>

#include "base/color.h"
#include "base/scattering.h"

namespace weft::film {

/// How a path was scattered at its vertices, from the camera on: the first 16 of them.
class PathSignature {
  public:
    void append(Scattering s) {
        if (length_ < 16) bits_ |= uint64_t(uint64_t(s.kind) << 1 | s.through) << (4 * length_);
        ++length_;
    }
    /// Returns how often the path was scattered, also beyond the 16th time.
    uint32_t length() const { return length_; }
    /// Returns the scattering number `i`, counted from 0; none beyond the end and the 16th.
    std::optional<Scattering> operator[](uint32_t i) const {
        if (i >= std::min(length_, 16u)) return {};
        uint64_t const bits = bits_ >> (4 * i) & 15;
        return Scattering{ScatteringKind(bits >> 1), (bits & 1) != 0};
    }

  private:
    static_assert(uint32_t(ScatteringKind::Medium) < 8, "a scattering fits into 4 bits");

    uint64_t bits_ = 0;
    uint32_t length_ = 0;
};

/// How the light of a contribution was found.
enum class Found : uint8_t {
    ByRay,        ///< a ray met the light
    InBackground, ///< a ray left the scene
    BySampling,   ///< light sampling, at a vertex where the path has not been scattered yet
};

struct Contribution {
    Color value;        ///< radiance at the camera
    int32_t light = -1; ///< index of the light; -1: an emissive object that is no light
    PathSignature const& path;
    int32_t object = -1; ///< index of the emissive object that a ray met; -1: none
    Found found = Found::ByRay;
    /// The camera sees the light straight and in focus, with nothing in between: only its edges
    /// have noise.
    bool is_sharp = false;

    bool is_sampled() const { return found == Found::BySampling; }
    /// Returns how often the light was scattered on its way to the camera: also by the vertex that
    /// it was sampled at, which `path` does not hold.
    uint32_t bounces() const { return path.length() + (is_sampled() ? 1 : 0); }
};

} // namespace weft::film
