#include "lobes/albedo.h"

#include "lobes/albedo_tables.h"

namespace weft::lobes {

namespace {

using namespace albedo_grid;

/// The cell of an axis of n nodes over [0, 1] and the position inside it.
struct Cell {
    int index;
    float t;
    Cell(float coordinate, int nodes) {
        float const x = std::min(std::max(coordinate, 0.f), 1.f) * float(nodes - 1);
        index = std::min(int(x), nodes - 2);
        t = x - float(index);
    }
};

float mean_square_alpha(float x, float y) { return std::sqrt(0.5f * (x * x + y * y)); }

constexpr int kSlab = alphas * cosines; // one index; kSlab * indices is one part of a side

float look_up(uint16_t const* slab, Cell const& a, Cell const& c) {
    auto const row = [&](int i) {
        uint16_t const* const p = slab + i * cosines + c.index;
        return lerp(p[0], p[1], c.t);
    };
    return lerp(row(a.index), row(a.index + 1), a.t) * (1 / 65535.f);
}

float look_up(uint16_t const* part, Cell const& e, Cell const& a, Cell const& c) {
    uint16_t const* const slab = part + e.index * kSlab;
    return lerp(look_up(slab, a, c), look_up(slab + kSlab, a, c), e.t);
}

float reflection(uint16_t const* table, float alpha, float cos_o) {
    return look_up(table, Cell(alpha_coordinate(alpha), alphas),
                   Cell(cosine_coordinate(std::max(cos_o, 0.f)), cosines));
}

DielectricAlbedo dielectric(uint16_t const* table, float alpha, float cos_o, float eta) {
    bool const leaving = eta < 1;
    float const c = std::min(std::max(cos_o, 0.f), 1.f);
    Cell const cell_e(index_coordinate(leaving ? 1 / eta : eta), indices);
    Cell const cell_a(alpha_coordinate(alpha), alphas);
    Cell const cell_c(leaving ? leaving_cosine_coordinate(c, eta) : cosine_coordinate(c), cosines);
    constexpr int part = kSlab * indices;
    uint16_t const* const side = table + (leaving ? 2 * part : 0);
    return {look_up(side, cell_e, cell_a, cell_c), look_up(side + part, cell_e, cell_a, cell_c)};
}

} // namespace

float reflection_albedo(Ggx const& d, float cos_o) {
    return reflection(albedo_tables::ggx_reflection, mean_square_alpha(d.alpha_x, d.alpha_y),
                      cos_o);
}
float reflection_albedo(Beckmann const& d, float cos_o) {
    return reflection(albedo_tables::beckmann_reflection, mean_square_alpha(d.alpha_x, d.alpha_y),
                      cos_o);
}
DielectricAlbedo dielectric_albedo(Ggx const& d, float cos_o, float eta) {
    return dielectric(albedo_tables::ggx_dielectric, mean_square_alpha(d.alpha_x, d.alpha_y), cos_o,
                      eta);
}
DielectricAlbedo dielectric_albedo(Beckmann const& d, float cos_o, float eta) {
    return dielectric(albedo_tables::beckmann_dielectric, mean_square_alpha(d.alpha_x, d.alpha_y),
                      cos_o, eta);
}

} // namespace weft::lobes
