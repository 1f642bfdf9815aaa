// What a thread of a render is at: the closest hit, a texture, choosing a light. Profiles tell
// processor time by it (base/profiler.h).
//
// The idea is that of pbrt-v3 (Pharr, Jakob, Humphreys: Physically Based Rendering, 3rd edition,
// A.1, ProfilePhase): a thread keeps what it does now in one byte of its own; scopes at the borders
// between features set it and restore what it was, so that time within nested scopes is the
// innermost one's. Where pbrt has a bit for each of the scopes that are open, a byte here holds
// the innermost alone.
//
// A scope is a load and two stores to a thread-local byte, whether somebody looks at it or not: no
// call, no lock, no branch. It keeps nothing that a pixel's value could depend on. Nobody waits for
// these stores, so they are relaxed, and the compiler may let arithmetic slip past them: borders
// are as sharp as function calls make them, some nanoseconds.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>

namespace weft {

enum class Feature : uint8_t {
    Integration,   ///< everything else along a path, random numbers among it
    ClosestHits,   ///< camera and bounce rays through the scene
    ShadowRays,    ///< whether light gets to a point
    Surfaces,      ///< from hits to points: normals, uvs, tangents
    Shading,       ///< node networks, and the lobes that materials make of their values
    Textures,      ///< lookups in images, wherever they are asked for
    Bsdf,          ///< values, densities and samples of lobes
    LightChoice,   ///< which light, and how likely it was
    LightSampling, ///< points on lights, their radiance and density; also of those that rays find
    Media,         ///< free flight, transmittance, scattering in media
    Camera,        ///< pixel filter and camera rays
    Film,          ///< sums of pixels, AOVs, estimates of noise
};
inline constexpr size_t kFeatures = size_t(Feature::Film) + 1;

namespace detail {
/// One byte per thread. `constinit`: no guard, and no wrapper where another file reads it.
inline constinit thread_local std::atomic<Feature> current_feature{Feature::Integration};
} // namespace detail

/// While it lives, the thread is at `now`.
class FeatureScope {
  public:
    explicit FeatureScope(Feature now)
        : before_(detail::current_feature.load(std::memory_order_relaxed)) {
        detail::current_feature.store(now, std::memory_order_relaxed);
    }
    FeatureScope(FeatureScope const&) = delete;
    FeatureScope& operator=(FeatureScope const&) = delete;
    ~FeatureScope() { detail::current_feature.store(before_, std::memory_order_relaxed); }

  private:
    Feature before_;
};

/// What the calling thread is at.
inline Feature current_feature() { return detail::current_feature.load(std::memory_order_relaxed); }

} // namespace weft
