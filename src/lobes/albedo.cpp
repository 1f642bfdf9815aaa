#include "lobes/albedo.h"

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

/// The root mean square of the alphas; exactly x where both are.
float mean_square_alpha(float x, float y) { return x == y ? x : std::sqrt(0.5f * (x * x + y * y)); }

/// Mostly the width of normals along the view's azimuth, which shadows what is transmitted.
float alpha_along(float x, float y, Vec3 const& wo) {
    if (x == y) return x;
    constexpr float across = 0.1f; // leaves the least error
    float const s2 = wo.x * wo.x + wo.y * wo.y;
    float const cos2 = s2 > 0 ? square(wo.x) / s2 : 0.5f;
    return std::sqrt(lerp(y * y, x * x, lerp(cos2, 1 - cos2, across)));
}

constexpr int kReflectionPart = alphas * reflection_cosines; // one of the moments
constexpr int kDielectricPart = indices * dielectric_alphas * cosines;

TableCell reflection_cell(Vec3 const& wo, float alpha) {
    float const c = std::min(std::max(wo.z, 0.f), 1.f);
    return {fresnel_cosine_coordinate(c, alpha), reflection_cosines};
}

/// The white albedo, isotropic.
float isotropic(uint16_t const* reflection, TableCell const& a, TableCell const& c) {
    return interpolate(reflection, reflection_cosines, a, c) * kUnit;
}

float anisotropic(uint16_t const* table, float alpha_x, float alpha_y, Vec3 const& wo) {
    bool const along_x = alpha_x >= alpha_y;
    float const greater = along_x ? alpha_x : alpha_y, lesser = along_x ? alpha_y : alpha_x;
    float const u = std::abs(along_x ? wo.x : wo.y), v = std::abs(along_x ? wo.y : wo.x);
    TableCell const cell_g(alpha_coordinate(greater), greater_alphas);
    TableCell const cell_r(alpha_coordinate(lesser / greater), alpha_ratios);
    TableCell const cell_p(azimuth_coordinate(u, v), azimuths);
    TableCell const cell_c(cosine_coordinate(std::max(wo.z, 0.f), greater), anisotropic_cosines);
    constexpr int row = anisotropic_cosines, slab = azimuths * row, book = alpha_ratios * slab;
    return interpolate(table, book, cell_g, slab, cell_r, row, cell_p, cell_c) * kUnit;
}

} // namespace

float ashikhmin_shirley_area(float alpha, float a) {
    TableCell const cell_a(alpha, area_alphas), cell_t(area_slope_coordinate(a), area_slopes);
    return interpolate(albedo_tables::ashikhmin_shirley_area, area_slopes, cell_a, cell_t) * kUnit;
}

template <class D>
float white_albedo(D const& d, Vec3 const& wo) {
    if (d.alpha_x != d.alpha_y)
        return anisotropic(Tables<D>::anisotropic, d.alpha_x, d.alpha_y, wo);
    return isotropic(Tables<D>::reflection, TableCell(alpha_coordinate(d.alpha_x), alphas),
                     reflection_cell(wo, d.alpha_x));
}

template <class D>
ReflectionMoments reflection_moments(D const& d, Vec3 const& wo) {
    float const alpha = mean_square_alpha(d.alpha_x, d.alpha_y);
    TableCell const a(alpha_coordinate(alpha), alphas);
    TableCell const c = reflection_cell(wo, alpha);
    auto const moment = [&](int i) {
        return interpolate(Tables<D>::reflection + i * kReflectionPart, reflection_cosines, a, c) *
               kUnit;
    };
    ReflectionMoments m{moment(0), moment(1), moment(2), moment(3), moment(4)};
    if (d.alpha_x != d.alpha_y) {
        float const white = white_albedo(d, wo), ratio = white / m.white;
        m.white = white;
        m.schlick *= ratio;
        m.edge *= ratio;
    }
    return m;
}

template <class D>
float dielectric_reflection(D const& d, Vec3 const& wo, float eta) {
    if (d.alpha_x == d.alpha_y) return dielectric_albedo(d, wo, eta).reflected;
    float const alpha = mean_square_alpha(d.alpha_x, d.alpha_y);
    D const even{alpha, alpha};
    return dielectric_albedo(even, wo, eta).reflected * white_albedo(d, wo) /
           white_albedo(even, wo);
}

template <class D>
DielectricAlbedo dielectric_albedo(D const& d, Vec3 const& wo, float eta) {
    bool const leaving = eta < 1;
    float const c = std::min(std::max(wo.z, 0.f), 1.f),
                alpha = alpha_along(d.alpha_x, d.alpha_y, wo);
    TableCell const cell_e(index_coordinate(leaving ? 1 / eta : eta), indices);
    TableCell const cell_a(alpha_coordinate(alpha), dielectric_alphas);
    TableCell const cell_c(leaving ? leaving_cosine_coordinate(c, eta, alpha)
                                   : fresnel_cosine_coordinate(c, alpha),
                           cosines);
    uint16_t const* const side = Tables<D>::dielectric + (leaving ? 2 * kDielectricPart : 0);
    auto const part = [&](int i) {
        return interpolate(side + i * kDielectricPart, dielectric_alphas * cosines, cell_e, cosines,
                           cell_a, cell_c) *
               kUnit;
    };
    float const all = power_at(part(0));
    float const reflected = std::min(part(1), all);
    return {reflected, all - reflected};
}

template float white_albedo(Ggx const&, Vec3 const&);
template float white_albedo(Beckmann const&, Vec3 const&);
template float white_albedo(AshikhminShirley const&, Vec3 const&);
template ReflectionMoments reflection_moments(Ggx const&, Vec3 const&);
template ReflectionMoments reflection_moments(Beckmann const&, Vec3 const&);
template ReflectionMoments reflection_moments(AshikhminShirley const&, Vec3 const&);
template float dielectric_reflection(Ggx const&, Vec3 const&, float);
template float dielectric_reflection(Beckmann const&, Vec3 const&, float);
template float dielectric_reflection(AshikhminShirley const&, Vec3 const&, float);
template DielectricAlbedo dielectric_albedo(Ggx const&, Vec3 const&, float);
template DielectricAlbedo dielectric_albedo(Beckmann const&, Vec3 const&, float);
template DielectricAlbedo dielectric_albedo(AshikhminShirley const&, Vec3 const&, float);

} // namespace weft::lobes
