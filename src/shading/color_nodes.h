// What the nodes of scene/nodes_color.h compute.
#pragma once

#include "base/blackbody.h"
#include "scene/nodes_color.h"
#include "shading/math_nodes.h"

namespace weft::shading {

/// Hue (0 to 1 from red over green and blue to red), saturation, value: Smith 1978, "Color gamut
/// transform pairs".
inline Vec3 rgb_to_hsv(Color const& c) {
    float const high = max_component(c), chroma = high - min_component(c);
    if (!(chroma > 0)) return {0, 0, high};
    float const sextant = high == c.r   ? (c.g - c.b) / chroma
                          : high == c.g ? 2 + (c.b - c.r) / chroma
                                        : 4 + (c.r - c.g) / chroma;
    float const hue = sextant / 6;
    return {hue - std::floor(hue), safe_divide(chroma, high), high};
}

inline Color hsv_to_rgb(Vec3 const& hsv) {
    float const hue = 6 * (hsv.x - std::floor(hsv.x));
    auto channel = [&](float from) {
        float const k = std::fmod(from + hue, 6.f);
        return hsv.z * (1 - hsv.y * std::clamp(std::min(k, 4 - k), 0.f, 1.f));
    };
    return {channel(5), channel(3), channel(1)};
}

inline Color adjust_hsv(Color const& c, Vec3 const& amount) {
    Vec3 const hsv = rgb_to_hsv(c);
    return hsv_to_rgb({hsv.x + amount.x, hsv.y * amount.y, hsv.z * amount.z});
}

/// To the power of 1 / gamma, on both sides of 0.
inline float apply_gamma(float x, float gamma) {
    return std::copysign(safe_power(std::abs(x), safe_divide(1, gamma)), x);
}

inline Vec3 run(nodes::Luminance const& n, NodeContext const& at) {
    return Vec3(luminance(at(n.in)));
}

inline Vec3 run(nodes::Contrast const& n, NodeContext const& at) {
    Vec3 const pivot = at(n.pivot);
    return pivot + (at(n.in) - pivot) * at(n.amount);
}

inline Vec3 run(nodes::Range const& n, NodeContext const& at) {
    Vec3 const low = at(n.outlow), high = at(n.outhigh);
    Vec3 const t = each(apply_gamma, fraction(at(n.in), at(n.inlow), at(n.inhigh)), at(n.gamma));
    Vec3 const x = low + t * (high - low);
    if (!n.doclamp) return x;
    auto smaller = [](float a, float b) { return std::min(a, b); };
    auto larger = [](float a, float b) { return std::max(a, b); };
    return each(smaller, each(larger, x, each(smaller, low, high)), each(larger, low, high));
}

inline Vec3 run(nodes::Saturate const& n, NodeContext const& at) {
    Color const c = at(n.in);
    return to_vector(lerp(Color(luminance(c)), c, at(n.amount)));
}

inline Vec3 run(nodes::HsvAdjust const& n, NodeContext const& at) {
    return to_vector(adjust_hsv(at(n.in), at(n.amount)));
}

inline Vec3 run(nodes::ColorCorrect const& n, NodeContext const& at) {
    Color c = adjust_hsv(at(n.in), {at(n.hue), 1, 1});
    c = lerp(Color(luminance(c)), c, at(n.saturation));
    float const gamma = at(n.gamma), lift = at(n.lift), contrast = at(n.contrast),
                pivot = at(n.contrast_pivot), gain = at(n.gain);
    float const exposure = std::exp2(at(n.exposure));
    auto correct = [&](float x) {
        x = apply_gamma(x, gamma);
        x = (x * (1 - lift) + lift) * gain;
        return ((x - pivot) * contrast + pivot) * exposure;
    };
    return {correct(c.r), correct(c.g), correct(c.b)};
}

inline Vec3 run(nodes::Blackbody const& n, NodeContext const& at) {
    return to_vector(blackbody_color(at(n.temperature)));
}

inline Vec3 run(nodes::ColorRamp const& n, NodeContext const& at) {
    auto const& stops = n.stops.stops;
    float const x = at(n.in);
    size_t next = 0;
    while (next < stops.size() && !(x < stops[next].position)) ++next;
    if (next == 0) return to_vector(stops.front().color);
    auto const& before = stops[next - 1];
    if (next == stops.size() || n.interpolation == nodes::RampInterpolation::constant)
        return to_vector(before.color);
    float const t = (x - before.position) / (stops[next].position - before.position);
    bool const smooth = n.interpolation == nodes::RampInterpolation::smooth;
    return to_vector(lerp(before.color, stops[next].color, smooth ? smooth_rise(t, 0, 1) : t));
}

} // namespace weft::shading
