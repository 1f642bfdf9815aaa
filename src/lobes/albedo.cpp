#include "lobes/albedo.h"

#include <cassert>

#include "lobes/albedo_tables.h"
#include "lobes/table.h"

namespace weft::lobes {

namespace {

using namespace albedo_grid;

constexpr float kUnit = 1 / 65535.f;

template <class Distribution>
struct Tables;
template <>
struct Tables<Ggx> {
    static constexpr auto const& reflection = albedo_tables::ggx_reflection;
    static constexpr auto const& anisotropic = albedo_tables::ggx_anisotropic;
    static constexpr auto const& dielectric = albedo_tables::ggx_dielectric;
};
template <>
struct Tables<Beckmann> {
    static constexpr auto const& reflection = albedo_tables::beckmann_reflection;
    static constexpr auto const& anisotropic = albedo_tables::beckmann_anisotropic;
    static constexpr auto const& dielectric = albedo_tables::beckmann_dielectric;
};
template <>
struct Tables<AshikhminShirley> {
    static constexpr auto const& reflection = albedo_tables::ashikhmin_shirley_reflection;
    static constexpr auto const& anisotropic = albedo_tables::ashikhmin_shirley_anisotropic;
    static constexpr auto const& dielectric = albedo_tables::ashikhmin_shirley_dielectric;
};

constexpr int kMoment = alphas * cosines, kReflection = moments * kMoment;
constexpr int kDielectricPart = indices * alphas * cosines;
constexpr int kDielectricSide = 2 * kDielectricPart, kDielectric = sides * kDielectricSide;
constexpr int kAzimuth = anisotropic_cosines, kRatio = azimuths * kAzimuth;
constexpr int kGreater = alpha_ratios * kRatio, kAnisotropic = greater_alphas * kGreater;

float clamped_cosine(Vec3 const& wo) { return std::min(std::max(wo.z, 0.f), 1.f); }

/// A place in the tables of isotropic reflection.
struct ReflectionPlace {
    uint16_t const* table;
    CubicCell alpha, cosine;

    template <class D>
    ReflectionPlace(D const& d, Vec3 const& wo)
        : table(Tables<D>::reflection + int(d.shadowing) * kReflection),
          alpha(alpha_coordinate(d.alpha_x), alphas),
          cosine(cosine_coordinate(clamped_cosine(wo), d.alpha_x), cosines) {}
    float moment(int i) const {
        float const value = interpolate(table + i * kMoment, alpha, cosines, cosine) * kUnit;
        return std::min(std::max(value, 0.f), 1.f);
    }
};

/// Rounded up by what the table may lack, so that no light is gained.
template <class D>
float anisotropic(D const& d, Vec3 const& wo) {
    bool const along_x = d.alpha_x >= d.alpha_y;
    float const greater = along_x ? d.alpha_x : d.alpha_y, lesser = along_x ? d.alpha_y : d.alpha_x;
    float const u = std::abs(along_x ? wo.x : wo.y), v = std::abs(along_x ? wo.y : wo.x);
    float const ratio = lesser / greater;
    CubicCell const cell_g(alpha_coordinate(greater), greater_alphas);
    CubicCell const cell_r(ratio_coordinate(ratio), alpha_ratios);
    CubicCell const cell_p(azimuth_coordinate(u, v, ratio), azimuths);
    CubicCell const cell_c(cosine_coordinate(clamped_cosine(wo), greater), anisotropic_cosines);
    float const value = interpolate(Tables<D>::anisotropic + int(d.shadowing) * kAnisotropic,
                                    cell_g, kGreater, cell_r, kRatio, cell_p, kAzimuth, cell_c);
    return std::min(value * (kUnit * 1.0015f), 1.f);
}

} // namespace

float ashikhmin_shirley_area(float alpha, float a) {
    LinearCell const cell_a(alpha, area_alphas), cell_t(area_slope_coordinate(a), area_slopes);
    return interpolate(albedo_tables::ashikhmin_shirley_area, cell_a, area_slopes, cell_t) * kUnit;
}

template <class D>
float white_albedo(D const& d, Vec3 const& wo) {
    if (d.alpha_x != d.alpha_y) return anisotropic(d, wo);
    return ReflectionPlace(d, wo).moment(0);
}

template <class D>
ReflectionMoments reflection_moments(D const& d, Vec3 const& wo) {
    assert(d.alpha_x == d.alpha_y);
    ReflectionPlace const at(d, wo);
    return {at.moment(0), at.moment(1), at.moment(2)};
}

template <class D>
DielectricAlbedo dielectric_albedo(D const& d, Vec3 const& wo, float eta) {
    assert(d.alpha_x == d.alpha_y);
    float const alpha = d.alpha_x;
    DielectricPlace const place = dielectric_place(clamped_cosine(wo), eta, alpha);
    CubicCell const cell_e(index_coordinate(eta < 1 ? 1 / eta : eta), indices);
    CubicCell const cell_a(alpha_coordinate(alpha), alphas), cell_c(place.coordinate, cosines);
    uint16_t const* const side =
        Tables<D>::dielectric + int(d.shadowing) * kDielectric + int(place.side) * kDielectricSide;
    auto const part = [&](int i) {
        return interpolate(side + i * kDielectricPart, cell_e, alphas * cosines, cell_a, cosines,
                           cell_c) *
               kUnit;
    };
    float const all = std::min(power_at(part(0)), 1.f);
    float const reflected = std::min(std::max(part(1), 0.f), all);
    return {reflected, all - reflected};
}

template float white_albedo(Ggx const&, Vec3 const&);
template float white_albedo(Beckmann const&, Vec3 const&);
template float white_albedo(AshikhminShirley const&, Vec3 const&);
template ReflectionMoments reflection_moments(Ggx const&, Vec3 const&);
template ReflectionMoments reflection_moments(Beckmann const&, Vec3 const&);
template ReflectionMoments reflection_moments(AshikhminShirley const&, Vec3 const&);
template DielectricAlbedo dielectric_albedo(Ggx const&, Vec3 const&, float);
template DielectricAlbedo dielectric_albedo(Beckmann const&, Vec3 const&, float);
template DielectricAlbedo dielectric_albedo(AshikhminShirley const&, Vec3 const&, float);

} // namespace weft::lobes
