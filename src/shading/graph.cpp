#include "shading/graph.h"

#include "base/feature.h"
#include "shading/node_functions.h"

namespace weft::shading {

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
