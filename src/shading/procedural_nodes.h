// What the nodes of scene/nodes_procedural.h compute.
#pragma once

#include "scene/nodes_procedural.h"
#include "shading/math_nodes.h"
#include "shading/noise.h"

namespace weft::shading {

inline Vec3 run(nodes::Place2d const& n, NodeContext const& at) {
    Vec2 const pivot = at(n.pivot), scale = at(n.scale), offset = at(n.offset);
    Vec2 p = at(n.texcoord) - pivot;
    p = {safe_divide(p.x, scale.x), safe_divide(p.y, scale.y)};
    float const angle = radians(at(n.rotate)), c = std::cos(angle), s = std::sin(angle);
    p = Vec2(c * p.x + s * p.y, c * p.y - s * p.x) - offset + pivot;
    return {p.x, p.y, 0};
}

inline Vec3 run(nodes::RampLr const& n, NodeContext const& at) {
    float const t = std::clamp(at(n.texcoord).x, 0.f, 1.f);
    return at(n.valuel) * (1 - t) + at(n.valuer) * t;
}
inline Vec3 run(nodes::RampTb const& n, NodeContext const& at) {
    float const t = std::clamp(at(n.texcoord).y, 0.f, 1.f);
    return at(n.valueb) * (1 - t) + at(n.valuet) * t;
}

inline Vec3 run(nodes::Noise2d const& n, NodeContext const& at) {
    return Vec3(at(n.pivot) + at(n.amplitude) * perlin_noise(at(n.texcoord)));
}
inline Vec3 run(nodes::Noise3d const& n, NodeContext const& at) {
    return Vec3(at(n.pivot) + at(n.amplitude) * perlin_noise(at(n.position)));
}
inline Vec3 run(nodes::Fractal3d const& n, NodeContext const& at) {
    float const lacunarity = at(n.lacunarity), diminish = at(n.diminish);
    Vec3 p = at(n.position);
    float amplitude = at(n.amplitude), sum = 0;
    for (int i = 0; i < n.octaves; ++i) {
        sum += amplitude * perlin_noise(p);
        amplitude *= diminish;
        p *= lacunarity;
    }
    return Vec3(sum);
}

inline Vec3 run(nodes::CellNoise2d const& n, NodeContext const& at) {
    return Vec3(cell_noise(at(n.texcoord)));
}
inline Vec3 run(nodes::CellNoise3d const& n, NodeContext const& at) {
    return Vec3(cell_noise(at(n.position)));
}

inline Vec3 worley_value(nodes::WorleyFeature feature, WorleyDistances const& d) {
    return Vec3(feature == nodes::WorleyFeature::f1   ? d.f1
                : feature == nodes::WorleyFeature::f2 ? d.f2
                                                      : d.f2 - d.f1);
}
inline Vec3 run(nodes::WorleyNoise2d const& n, NodeContext const& at) {
    return worley_value(n.feature, worley_noise(at(n.texcoord), at(n.jitter)));
}
inline Vec3 run(nodes::WorleyNoise3d const& n, NodeContext const& at) {
    return worley_value(n.feature, worley_noise(at(n.position), at(n.jitter)));
}

} // namespace weft::shading
