// Weft's own views: from linear Rec. 709 light to sRGB-encoded numbers in [0, 1].
//
// * standard: clips, and encodes by the sRGB curve (IEC 61966-2-1).
// * agx: after Troy Sobotka's AgX (2022). An "inset" matrix moves colours towards grey, so that
//   bright saturated ones share their light among the channels and fade to white, where clipping
//   would turn them into a primary; then a logarithm from 10 stops below to 6.5 above middle grey,
//   his sigmoid (slope 2 at the pivot, toe of power 3, shoulder of power 3.25), the inverse matrix,
//   and a display gamma of 2.2. His "looks" are left out.
// * aces: Stephen Hill's fit (2017) of the ACES 1.0 reference rendering and sRGB output
//   transforms.
//
// What is not a number gives 0 in every view.
#pragma once

#include <array>

#include "base/color.h"

namespace weft::post {

namespace detail {

using Matrix3 = std::array<std::array<double, 3>, 3>;

constexpr Matrix3 inverse(Matrix3 const& m) {
    auto cofactor = [&](size_t i, size_t j) {
        size_t const a = (i + 1) % 3, b = (i + 2) % 3, c = (j + 1) % 3, d = (j + 2) % 3;
        return m[a][c] * m[b][d] - m[a][d] * m[b][c];
    };
    double const determinant =
        m[0][0] * cofactor(0, 0) + m[0][1] * cofactor(0, 1) + m[0][2] * cofactor(0, 2);
    Matrix3 result{};
    for (size_t i = 0; i < 3; ++i)
        for (size_t j = 0; j < 3; ++j) result[i][j] = cofactor(j, i) / determinant;
    return result;
}

/// Returns the matrix with each row scaled to the sum 1, so that grey stays grey in spite of the
/// rounding of the published digits.
constexpr Matrix3 grey_kept(Matrix3 m) {
    for (auto& row : m) {
        double const sum = row[0] + row[1] + row[2];
        for (double& x : row) x /= sum;
    }
    return m;
}

inline Color times(Matrix3 const& m, Color const& c) {
    auto row = [&](size_t i) { return float(m[i][0] * c.r + m[i][1] * c.g + m[i][2] * c.b); };
    return {row(0), row(1), row(2)};
}

/// Returns the colour in the range that every curve takes: infinity becomes a large number, and
/// what is negative or not a number becomes 0.
inline Color bounded(Color const& c) {
    auto bound = [](float x) { return x > 0 ? std::min(x, 1e6f) : 0; };
    return {bound(c.r), bound(c.g), bound(c.b)};
}

inline Color srgb_encoded(Color const& c) {
    return {linear_to_srgb(c.r), linear_to_srgb(c.g), linear_to_srgb(c.b)};
}

} // namespace detail

inline Color standard_view(Color const& c) {
    return detail::srgb_encoded(min(detail::bounded(c), 1));
}

namespace agx {

inline constexpr float kMiddleGrey = 0.18f, kStopsBelow = 10, kStopsAbove = 6.5f;
inline constexpr float kPivot = kStopsBelow / (kStopsBelow + kStopsAbove), kPivotValue = 0.5f;
inline constexpr float kSlope = 2, kToe = 3, kShoulder = 3.25f;

inline constexpr detail::Matrix3 kInset =
    detail::grey_kept({{{0.842479062253094, 0.0784335999999992, 0.0792237451477643},
                        {0.0423282422610123, 0.878468636469772, 0.0791661274605434},
                        {0.0423756549057051, 0.0784336, 0.879142973793104}}});
inline constexpr detail::Matrix3 kOutset = detail::inverse(kInset);

/// Maps [0, 1] to [0, 1], ends included.
inline float sigmoid(float x) {
    bool const toe = x < kPivot;
    float const power = toe ? kToe : kShoulder;
    float const width = toe ? kPivot : 1 - kPivot, height = toe ? kPivotValue : 1 - kPivotValue;
    // The hyperbola t / (1 + t^p)^(1/p), scaled so that its end lies in the corner.
    float const scale =
        std::pow(std::pow(kSlope * width, -power) * (std::pow(kSlope * width / height, power) - 1),
                 -1 / power);
    float const t = kSlope * std::abs(x - kPivot) / scale;
    float const away = scale * t / std::pow(1 + std::pow(t, power), 1 / power);
    return std::clamp(kPivotValue + (toe ? -away : away), 0.f, 1.f);
}

/// Maps linear light of one channel to a value for a display with a gamma of 2.2.
inline float curve(float light) {
    float const stops = std::log2(std::max(light, 1e-10f) / kMiddleGrey);
    return sigmoid(std::clamp((stops + kStopsBelow) / (kStopsBelow + kStopsAbove), 0.f, 1.f));
}

} // namespace agx

inline Color agx_view(Color const& color) {
    Color c = detail::times(agx::kInset, detail::bounded(color));
    c = clamp(detail::times(agx::kOutset, {agx::curve(c.r), agx::curve(c.g), agx::curve(c.b)}), 0,
              1);
    return detail::srgb_encoded({std::pow(c.r, 2.2f), std::pow(c.g, 2.2f), std::pow(c.b, 2.2f)});
}

namespace aces {

inline constexpr detail::Matrix3 kInput = detail::grey_kept(
    {{{0.59719, 0.35458, 0.04823}, {0.07600, 0.90834, 0.01566}, {0.02840, 0.13383, 0.83777}}});
inline constexpr detail::Matrix3 kOutput = detail::grey_kept({{{1.60475, -0.53108, -0.07367},
                                                               {-0.10208, 1.10813, -0.00605},
                                                               {-0.00327, -0.07276, 1.07602}}});

inline float curve(float v) {
    return (v * (v + 0.0245786f) - 0.000090537f) / (v * (0.983729f * v + 0.4329510f) + 0.238081f);
}

} // namespace aces

inline Color aces_view(Color const& color) {
    Color const c = detail::times(aces::kInput, detail::bounded(color));
    Color const shown =
        detail::times(aces::kOutput, {aces::curve(c.r), aces::curve(c.g), aces::curve(c.b)});
    return detail::srgb_encoded(clamp(shown, 0, 1));
}

} // namespace weft::post
