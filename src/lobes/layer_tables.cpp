// The lookups of the lobes whose albedo or shape is tabulated by tools/make_layer_tables.cpp.
#include "lobes/layer_tables.h"

#include "lobes/clearcoat.h"
#include "lobes/disney_sheen.h"
#include "lobes/sheen.h"
#include "lobes/table.h"

namespace weft::lobes {

namespace {

struct SheenPlace {
    CubicCell row, column;
    SheenPlace(float roughness, float cos_o)
        : row(sheen_grid::roughness_coordinate(roughness), sheen_grid::roughnesses),
          column(sheen_grid::cosine_coordinate(std::max(cos_o, 0.f), roughness),
                 sheen_grid::cosines) {}
    float in(float const* table) const {
        return interpolate(table, row, sheen_grid::cosines, column);
    }
    float albedo() const { return std::min(std::max(in(layer_tables::sheen_albedo), 0.f), 1.f); }
};

} // namespace

float sheen_albedo(float roughness, float cos_o) { return SheenPlace(roughness, cos_o).albedo(); }

SheenCoefficients sheen_coefficients(float roughness, float cos_o) {
    SheenPlace const at(roughness, cos_o);
    return {at.albedo(), std::max(at.in(layer_tables::sheen_a), 0.05f),
            at.in(layer_tables::sheen_b)};
}

float disney_sheen_albedo(float cos_o) {
    return interpolate(layer_tables::disney_sheen, CubicCell(cos_o, disney_sheen_cosines));
}

float clearcoat_albedo(float alpha, float f0, float cos_o) {
    using namespace clearcoat_grid;
    CubicCell const row(alpha_coordinate(alpha), alphas);
    CubicCell const column(cosine_coordinate(std::max(cos_o, 0.f)), cosines);
    return f0 * interpolate(layer_tables::clearcoat_white, row, cosines, column) +
           (1 - f0) * interpolate(layer_tables::clearcoat_grazing, row, cosines, column);
}

} // namespace weft::lobes
