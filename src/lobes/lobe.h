// What every lobe promises.
//
// Local frame: z is the shading normal on wo's side, so wo.z > 0 always; wi.z > 0 reflects and
// wi.z < 0 transmits. Both directions are unit and leave the surface. `eval().f` is the BSDF times
// |wi.z|; densities are per solid angle of wi.
//
// Transmission is that of *radiance*: where light crosses into a medium of another index, f
// carries the factor 1 / eta^2 (Veach 1997, 5.2; pbrt's TransportMode::Radiance), eta being the
// index on wi's side over the index on wo's side. Samples report `eta_scale` = eta^2 so that
// Russian roulette can look at the path's power instead. `albedo` is a fraction of power, in
// [0, 1]: the integral of f * eta_scale over wi.
//
// A fibre has no side: its lobe scatters over the whole sphere, its x axis is the fibre's tangent,
// and f carries the cosine to the normal plane, sqrt(1 - wi.x^2), instead of |wi.z|; z only tells
// reflection from transmission. hair.h says more.
//
// Where a tint is a plain factor, the lobe is white and its weight in the list (bsdf.h) is the
// tint.
#pragma once

#include <concepts>
#include <cstdint>

#include "base/color.h"
#include "base/scattering.h"
#include "base/vec.h"

namespace weft::lobes {

/// The sides of a surface that light is scattered to. A set.
enum class Sides : uint8_t { None = 0, Reflection = 1, Transmission = 2, Both = 3 };

constexpr Sides& operator|=(Sides& a, Sides b) { return a = Sides(uint8_t(a) | uint8_t(b)); }
/// Returns whether the sets meet.
constexpr bool any(Sides set, Sides of) { return (uint8_t(set) & uint8_t(of)) != 0; }

/// What a lobe does, wherever it is.
struct LobeFlags {
    ScatteringKind kind;
    Sides sides;
};

struct LobeValue {
    Color f;       ///< BSDF times |cos wi|
    float pdf = 0; ///< of the lobe's own sampling, per solid angle
};

struct DeltaSample {
    Vec3 wi{0, 0, 0};
    Color weight;          ///< f |cos wi| / probability
    float probability = 0; ///< that the lobe chose this of its directions; 0 means failure
    float eta_scale = 1;   ///< eta^2 after transmission, else 1
};

/// What both sorts of lobes have. `width` is in [0, 1] and says how far the lobe
/// spreads light, as the alpha of a microfacet distribution does: 0 for delta lobes, 1 for diffuse
/// ones. Lobes that are wider in one direction than in another give the greater width.
template <class L>
concept AnyLobe = requires(L const& lobe, Vec3 const& v) {
    { lobe.albedo(v) } -> std::same_as<Color>;
    { lobe.flags() } -> std::same_as<LobeFlags>;
    { lobe.width() } -> std::same_as<float>;
};

/// A lobe with a density. `sample` takes u in [0, 1)^3 and gives the zero vector on failure
/// (a direction the lobe cannot scatter to); the density then integrates to less than 1.
/// `eta_scale` is eta^2 where the lobe transmits between two indices, else 1.
template <class L>
concept SmoothLobe = AnyLobe<L> && requires(L const& lobe, Vec3 const& v) {
    { lobe.eval(v, v) } -> std::same_as<LobeValue>;
    { lobe.sample(v, v) } -> std::same_as<Vec3>;
    { lobe.eta_scale() } -> std::same_as<float>;
};

/// A lobe that scatters into finitely many directions.
template <class L>
concept DeltaLobe = AnyLobe<L> && requires(L const& lobe, Vec3 const& v) {
    { lobe.sample(v, v) } -> std::same_as<DeltaSample>;
};

/// The `eta_scale` of a sample of `lobe`: 1 where it reflects.
template <SmoothLobe L>
float eta_scale_towards(L const& lobe, Vec3 const& wi) {
    return wi.z < 0 ? lobe.eta_scale() : 1.f;
}

// Lobes that ask tables about wo in every `eval` can do so once. Overloads of these two functions
// let them; other lobes have nothing to prepare.

/// Prepares `lobe` for `wo`: from here on it is evaluated for this wo alone.
template <AnyLobe L>
void look_up(L&, Vec3 const&) {}
/// Does the same and returns lobe.albedo(wo), from the same look-up.
template <AnyLobe L>
Color look_up_albedo(L& lobe, Vec3 const& wo) {
    return lobe.albedo(wo);
}

} // namespace weft::lobes
