#include "lobes/boundary_albedo.h"

#include <bit>
#include <span>

#include "base/memo.h"
#include "lobes/ashikhmin_shirley.h"

namespace weft::lobes {

namespace {

// The lattice. Between nodes along the axes albedos are interpolated linearly.
constexpr float kCosines = 128; ///< equal steps of the cosine's root in [0, 1]
constexpr float kAzimuths = 16; ///< equal steps of a quarter turn
constexpr float kThickness = 4; ///< nm between steps
// With alphas albedos change little: the nearest node speaks for them. Indices of refraction, which
// few materials vary, are taken as they are.
constexpr float kAlphas = 100; ///< steps for each doubling
/// Visible normals that an albedo is the mean over.
constexpr int kNormals = 987;

enum Axis { kCosine, kAzimuth, kFilmThickness, kAxes };

/// A node. Places count steps, those of alphas from 1 down in logarithms; indices are the bits of
/// floats.
struct Node {
    uint16_t kind; ///< of the distribution
    std::array<uint16_t, kAxes> place;
    uint16_t alpha_x, alpha_y;
    uint32_t eta, reflection_eta, film_ior, outer_ior; ///< 0: there is no such index
};
static_assert(sizeof(Node) == 28);

/// Two colours without padding.
struct NodeAlbedo {
    float reflected[3], transmitted[3];
};

/// About as many as a picture with fifty such materials, or one with maps for all of their
/// parameters, needs.
Memo<Node, NodeAlbedo, 1 << 18> known_albedos;

uint16_t alpha_step(float alpha) {
    return uint16_t(std::clamp(std::round(-std::log2(alpha) * kAlphas), 0.f, 60000.f));
}
float alpha_at(uint16_t step) { return std::exp2(-float(step) / kAlphas); }

template <class Distribution>
constexpr uint16_t kKind = 0;
template <>
constexpr uint16_t kKind<Beckmann> = 1;
template <>
constexpr uint16_t kKind<AshikhminShirley> = 2;

template <class Distribution>
NodeAlbedo albedo_at(Node const& node, Shadowing shadowing) {
    auto const& at = node.place;
    float const root = float(at[kCosine]) / kCosines;
    float const z = std::max(root * root, 1e-4f), sine = safe_sqrt(1 - z * z);
    float const phi = float(at[kAzimuth]) / kAzimuths * (kPi / 2);
    BoundaryOptions options;
    options.reflection_eta = std::bit_cast<float>(node.reflection_eta);
    if (node.film_ior)
        options.film = {float(at[kFilmThickness]) * kThickness, std::bit_cast<float>(node.film_ior),
                        std::bit_cast<float>(node.outer_ior)};
    BoundarySplit const s = boundary_albedo_over_normals(
        Distribution{alpha_at(node.alpha_x), alpha_at(node.alpha_y), shadowing},
        std::bit_cast<float>(node.eta), options, {sine * std::cos(phi), sine * std::sin(phi), z},
        kNormals);
    return {{s.reflected.r, s.reflected.g, s.reflected.b},
            {s.transmitted.r, s.transmitted.g, s.transmitted.b}};
}

/// Adds up `f(node, weight)` over the corners around a place along `axes`, those that lie between
/// two nodes.
template <class F>
void for_each_corner(Node& node, std::span<Axis const> axes, std::array<float, kAxes> const& part,
                     float weight, F const& f) {
    if (axes.empty()) return f(node, weight);
    Axis const axis = axes.front();
    for_each_corner(node, axes.subspan(1), part, weight * (1 - part[axis]), f);
    ++node.place[axis];
    for_each_corner(node, axes.subspan(1), part, weight * part[axis], f);
    --node.place[axis];
}

} // namespace

template <class Distribution>
BoundarySplit boundary_albedo_over_normals(Distribution const& d, float eta,
                                           BoundaryOptions const& options, Vec3 const& wo, int n) {
    float const sigma_o = d.projected_area(wo);
    BoundarySplit sum;
    for_visible_normals(d, wo, sigma_o, n, [&](Vec3 const& m, float share) {
        float const cos_o = dot(wo, m);
        if (!(cos_o > 0)) return;
        float cos_t;
        float const fresnel = fresnel_dielectric(cos_o, eta, cos_t);
        BoundarySplit const split = split_light(options, eta, fresnel, cos_o, cos_t);
        if (Vec3 const r = reflect(wo, m); r.z > 0)
            sum.reflected += split.reflected * (share * shadowing_above(d.shadowing, wo.z, sigma_o,
                                                                        r.z, d.projected_area(r)));
        if (!(fresnel < 1)) return;
        if (Vec3 const t = refract(wo, m, cos_o, cos_t, eta); t.z < 0)
            sum.transmitted +=
                split.transmitted *
                (share * shadowing_across(d.shadowing, wo.z, sigma_o, -t.z, d.projected_area(t)));
    });
    return sum;
}

template <class Distribution>
BoundarySplit boundary_albedo(Distribution const& d, float eta, BoundaryOptions const& options,
                              Vec3 const& wo) {
    Node node{.kind = uint16_t(2 * kKind<Distribution> + uint16_t(d.shadowing)),
              .place = {},
              .alpha_x = alpha_step(d.alpha_x),
              .alpha_y = alpha_step(d.alpha_y),
              .eta = std::bit_cast<uint32_t>(eta),
              .reflection_eta = std::bit_cast<uint32_t>(std::max(options.reflection_eta, 0.f)),
              .film_ior = 0,
              .outer_ior = 0};
    std::array<float, kAxes> place{};
    place[kCosine] = std::sqrt(std::clamp(wo.z, 0.f, 1.f)) * kCosines;
    if (node.alpha_x != node.alpha_y)
        place[kAzimuth] = std::atan2(std::abs(wo.y), std::abs(wo.x)) / (kPi / 2) * kAzimuths;
    if (options.film) {
        node.film_ior = std::bit_cast<uint32_t>(options.film.ior);
        node.outer_ior = std::bit_cast<uint32_t>(options.film.outer_ior);
        place[kFilmThickness] = std::min(options.film.thickness / kThickness, 60000.f);
    }

    std::array<Axis, kAxes> between;
    size_t count = 0;
    std::array<float, kAxes> part{};
    for (size_t i = 0; i < kAxes; ++i) {
        float const below = std::floor(place[i]);
        node.place[i] = uint16_t(below);
        part[i] = place[i] - below;
        if (part[i] > 0) between[count++] = Axis(i);
    }
    BoundarySplit sum;
    for_each_corner(node, std::span(between).first(count), part, 1, [&](Node& at, float weight) {
        NodeAlbedo const a = known_albedos.get(
            at, [&](Node const& n) { return albedo_at<Distribution>(n, d.shadowing); });
        sum.reflected += weight * Color(a.reflected[0], a.reflected[1], a.reflected[2]);
        sum.transmitted += weight * Color(a.transmitted[0], a.transmitted[1], a.transmitted[2]);
    });
    return sum;
}

template BoundarySplit boundary_albedo_over_normals(Ggx const&, float, BoundaryOptions const&,
                                                    Vec3 const&, int);
template BoundarySplit boundary_albedo_over_normals(Beckmann const&, float, BoundaryOptions const&,
                                                    Vec3 const&, int);
template BoundarySplit boundary_albedo_over_normals(AshikhminShirley const&, float,
                                                    BoundaryOptions const&, Vec3 const&, int);
template BoundarySplit boundary_albedo(Ggx const&, float, BoundaryOptions const&, Vec3 const&);
template BoundarySplit boundary_albedo(Beckmann const&, float, BoundaryOptions const&, Vec3 const&);
template BoundarySplit boundary_albedo(AshikhminShirley const&, float, BoundaryOptions const&,
                                       Vec3 const&);

} // namespace weft::lobes
