// Linear, scene-referred RGB with sRGB / Rec. 709 primaries and D65 white.
#pragma once

#include "base/vec.h"

namespace weft {

/// Red, green, blue. Radiance, reflectance or throughput; arithmetic is per channel.
struct Color {
    float r = 0, g = 0, b = 0;

    constexpr Color() = default;
    constexpr explicit Color(float grey) : r(grey), g(grey), b(grey) {}
    constexpr Color(float red, float green, float blue) : r(red), g(green), b(blue) {}

    constexpr float operator[](int channel) const {
        return channel == 0 ? r : channel == 1 ? g : b;
    }
    constexpr Color& operator+=(Color const& c) { return *this = {r + c.r, g + c.g, b + c.b}; }
    constexpr Color& operator-=(Color const& c) { return *this = {r - c.r, g - c.g, b - c.b}; }
    constexpr Color& operator*=(Color const& c) { return *this = {r * c.r, g * c.g, b * c.b}; }
    constexpr Color& operator*=(float s) { return *this = {r * s, g * s, b * s}; }
    friend constexpr Color operator+(Color lhs, Color const& rhs) { return lhs += rhs; }
    friend constexpr Color operator-(Color lhs, Color const& rhs) { return lhs -= rhs; }
    friend constexpr Color operator*(Color lhs, Color const& rhs) { return lhs *= rhs; }
    friend constexpr Color operator*(Color lhs, float s) { return lhs *= s; }
    friend constexpr Color operator*(float s, Color rhs) { return rhs *= s; }
    friend constexpr Color operator/(Color const& lhs, Color const& rhs) {
        return {lhs.r / rhs.r, lhs.g / rhs.g, lhs.b / rhs.b};
    }
    friend constexpr Color operator/(Color lhs, float s) { return lhs *= 1 / s; }
    friend constexpr bool operator==(Color const&, Color const&) = default;
};

/// Relative luminance Y (ITU-R BT.709).
constexpr float luminance(Color const& c) { return 0.2126f * c.r + 0.7152f * c.g + 0.0722f * c.b; }
constexpr float max_component(Color const& c) { return std::max(c.r, std::max(c.g, c.b)); }
constexpr float min_component(Color const& c) { return std::min(c.r, std::min(c.g, c.b)); }
constexpr Color max(Color const& c, float least) {
    return {std::max(c.r, least), std::max(c.g, least), std::max(c.b, least)};
}
constexpr Color min(Color const& c, float most) {
    return {std::min(c.r, most), std::min(c.g, most), std::min(c.b, most)};
}
constexpr Color clamp(Color const& c, float low, float high) {
    return {std::clamp(c.r, low, high), std::clamp(c.g, low, high), std::clamp(c.b, low, high)};
}
constexpr float average(Color const& c) { return (c.r + c.g + c.b) * (1 / 3.f); }
constexpr bool is_black(Color const& c) { return c.r == 0 && c.g == 0 && c.b == 0; }
inline bool is_finite(Color const& c) {
    return std::isfinite(c.r) && std::isfinite(c.g) && std::isfinite(c.b);
}
inline Color exp(Color const& c) { return {std::exp(c.r), std::exp(c.g), std::exp(c.b)}; }
constexpr Color lerp(Color const& a, Color const& b, float t) { return a + (b - a) * t; }

/// The sRGB transfer functions (IEC 61966-2-1); both take and give values around [0, 1].
inline float srgb_to_linear(float x) {
    return x <= 0.04045f ? x / 12.92f : std::pow((x + 0.055f) / 1.055f, 2.4f);
}
inline float linear_to_srgb(float x) {
    return x <= 0.0031308f ? 12.92f * x : 1.055f * std::pow(x, 1 / 2.4f) - 0.055f;
}

} // namespace weft
