// The lookups of the lobes whose albedo or shape is tabulated by tools/make_layer_tables.cpp.
#include "lobes/layer_tables.h"

#include "lobes/burley_diffuse.h"
#include "lobes/clearcoat.h"
#include "lobes/disney_sheen.h"
#include "lobes/sheen.h"
#include "lobes/table.h"

namespace weft::lobes {

float burley_diffuse_albedo(float roughness, float cos_o) {
    using namespace burley_grid;
    return interpolate(layer_tables::burley_diffuse, LinearCell(roughness, roughnesses), cosines,
                       LinearCell(cosine_coordinate(std::max(cos_o, 0.f)), cosines));
}

float sheen_albedo(float roughness, float cos_o) {
    using namespace sheen_grid;
    return interpolate(layer_tables::sheen_albedo, LinearCell(roughness, roughnesses), cosines,
                       LinearCell(cosine_coordinate(std::max(cos_o, 0.f)), cosines));
}

SheenCoefficients sheen_coefficients(float roughness, float cos_o) {
    using namespace sheen_grid;
    LinearCell const row(roughness, roughnesses);
    LinearCell const column(cosine_coordinate(std::max(cos_o, 0.f)), cosines);
    return {interpolate(layer_tables::sheen_albedo, row, cosines, column),
            interpolate(layer_tables::sheen_a, row, cosines, column),
            interpolate(layer_tables::sheen_b, row, cosines, column)};
}

float disney_sheen_albedo(float cos_o) {
    return interpolate(layer_tables::disney_sheen, LinearCell(cos_o, disney_sheen_cosines));
}

float clearcoat_albedo(float alpha, float f0, float cos_o) {
    using namespace clearcoat_grid;
    LinearCell const row(alpha_coordinate(alpha), alphas);
    LinearCell const column(cosine_coordinate(std::max(cos_o, 0.f)), cosines);
    return f0 * interpolate(layer_tables::clearcoat_white, row, cosines, column) +
           (1 - f0) * interpolate(layer_tables::clearcoat_grazing, row, cosines, column);
}

} // namespace weft::lobes
