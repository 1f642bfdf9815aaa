#include "shading/graph.h"

#include "base/feature.h"
#include "shading/node_functions.h"

namespace weft::shading {

Vec2i resolution(Program const& program) {
    if (program.result.reg < 0) return {1, 1};
    Vec2i largest(0, 0);
    bool patterns = false;
    for (Instruction const& instruction : program.instructions) {
        if (auto const* image = std::get_if<ImageOp>(&instruction)) {
            largest.x = std::max(largest.x, image->lookup.image->width);
            largest.y = std::max(largest.y, image->lookup.image->height);
        } else {
            patterns = true;
        }
    }
    if (largest.x == 0) return {512, 256};
    return patterns ? Vec2i(std::max(largest.x, 512), std::max(largest.y, 256)) : largest;
}

void evaluate(Program const& program, SurfacePoint const& point, Values& values) {
    NodeContext const context{point, values, program};
    size_t index = 0;
    for (Instruction const& instruction : program.instructions)
        values[index++] =
            match(instruction, [&](auto const& node) -> Vec3 { return run(node, context); });
}

Vec3 evaluate(Program const& program, SurfacePoint const& point) {
    if (program.result.reg < 0) return program.result.value;
    FeatureScope const scope(Feature::Shading);
    Values values;
    evaluate(program, point, values);
    return values[size_t(program.result.reg)];
}

} // namespace weft::shading
