#include "lights/sky_model.h"

#include <array>
#include <cassert>
#include <numbers>

#include "base/blackbody.h"
#include "base/lat_long.h"
#include "lights/hosek_wilkie_tables.h"

namespace weft::lights {

namespace {

constexpr double kPi64 = std::numbers::pi;
/// Of the luminous efficiency's peak, lm/W.
constexpr double kPeakEfficacy = 683;

/// `xyz` in the units of 683 lm/W.
Color radiance_of(Vec3d const& xyz) {
    // IEC 61966-2-1.
    Vec3d const rgb(3.2404542 * xyz.x - 1.5371385 * xyz.y - 0.4985314 * xyz.z,
                    -0.9692660 * xyz.x + 1.8760108 * xyz.y + 0.0415560 * xyz.z,
                    0.0556434 * xyz.x - 0.2040259 * xyz.y + 1.0572252 * xyz.z);
    double const scale = kPeakEfficacy / kDaylightEfficacy;
    return max(Color(float(rgb.x * scale), float(rgb.y * scale), float(rgb.z * scale)), 0);
}

/// The curve of degree 5 over the cube root of the elevation (eq. 11), of the control points
/// `point(i)`.
template <class F>
double bezier(double t, F const& point) {
    constexpr double binomial[]{1, 5, 10, 10, 5, 1};
    double sum = 0;
    for (int i = 0; i < 6; ++i)
        sum += binomial[i] * std::pow(t, i) * std::pow(1 - t, 5 - i) * point(i);
    return sum;
}

/// Linear in turbidity and albedo. `value(a, t)`: of albedo a and turbidity t + 1.
template <class F>
double between(double turbidity, double albedo, F const& value) {
    int const low = std::clamp(int(turbidity), 1, 9) - 1;
    double const t = std::clamp(turbidity, 1.0, 10.0) - 1 - low;
    auto const of = [&](int a) { return (1 - t) * value(a, low) + t * value(a, low + 1); };
    return (1 - albedo) * of(0) + albedo * of(1);
}

/// Of the sky with the sun at this elevation below the horizon.
double twilight(double elevation) {
    return elevation < 0 ? std::pow(10, 0.35 * elevation * 180 / kPi64) : 1;
}

} // namespace

SkyModel::SkyModel(double turbidity, double albedo, double elevation) {
    using namespace hosek_wilkie;
    double const t = std::cbrt(std::clamp(elevation / (kPi64 / 2), 0.0, 1.0));
    auto const set = [&](Channel& channel, auto const& shape, auto const& radiance) {
        for (int k = 0; k < 9; ++k)
            channel.shape[k] = between(turbidity, albedo, [&](int a, int i) {
                return bezier(t, [&](int p) { return shape[a][i][p][k]; });
            });
        channel.scale = twilight(elevation) * between(turbidity, albedo, [&](int a, int i) {
                            return bezier(t, [&](int p) { return radiance[a][i][p]; });
                        });
    };
    set(channels_[0], kShapeX, kRadianceX);
    set(channels_[1], kShapeY, kRadianceY);
    set(channels_[2], kShapeZ, kRadianceZ);
}

Color SkyModel::radiance(double theta, double gamma) const {
    double const ct = std::max(std::cos(theta), 0.0), cg = std::cos(gamma);
    double xyz[3];
    for (int c = 0; c < 3; ++c) {
        double const(&s)[9] = channels_[c].shape;
        double const mie = (1 + cg * cg) / std::pow(1 + s[8] * s[8] - 2 * s[8] * cg, 1.5);
        xyz[c] = channels_[c].scale * (1 + s[0] * std::exp(s[1] / (ct + 0.01))) *
                 (s[2] + s[3] * std::exp(s[4] * gamma) + s[5] * cg * cg + s[6] * mie +
                  s[7] * std::sqrt(ct));
    }
    return radiance_of({xyz[0], xyz[1], xyz[2]});
}

Color sun_irradiance(double turbidity, double elevation) {
    if (elevation <= 0) return Color(0);
    // Of ozone, 1/cm, from 450 nm in steps of 10 nm; 0.35 cm of it.
    constexpr std::array ozone{0.003, 0.006, 0.009, 0.014, 0.021, 0.030, 0.040, 0.048, 0.063,
                               0.075, 0.085, 0.103, 0.120, 0.120, 0.115, 0.125, 0.120, 0.105,
                               0.090, 0.079, 0.067, 0.057, 0.048, 0.036, 0.028, 0.023, 0.018,
                               0.014, 0.011, 0.010, 0.009, 0.007, 0.004};
    double const degrees = elevation * 180 / kPi64;
    double const mass = 1 / (std::sin(elevation) + 0.50572 * std::pow(degrees + 6.07995, -1.6364));
    double const aerosols = 0.04608 * turbidity - 0.04586;
    // Planck's law in W/(m^2 sr nm), c1 = 2 h c^2 and c2 = h c / k; the sun's solid angle by its
    // radius over its distance.
    constexpr double c1 = 1.191042972e20, c2 = 1.438776877e7, kelvin = 5772;
    constexpr double sine = 6.957e8 / 1.495978707e11;
    Vec3d xyz(0);
    constexpr int step = 5;
    for (int w = 380; w <= 770; w += step) {
        double const um = w * 1e-3;
        double const place = std::max((w - 450) / 10.0, -1.0);
        int const i = int(std::floor(place));
        auto const at = [&](int k) {
            return k < 0 || k >= int(ozone.size()) ? 0.0 : ozone[size_t(k)];
        };
        double const absorbed = at(i) + (at(i + 1) - at(i)) * (place - i);
        double const depth =
            0.008735 * std::pow(um, -4.08) + aerosols * std::pow(um, -1.3) + 0.35 * absorbed;
        double const planck = c1 / (std::pow(double(w), 5) * std::expm1(c2 / (w * kelvin)));
        xyz += cie_xyz(w) * (planck * kPi64 * sine * sine * std::exp(-mass * depth) * step);
    }
    return radiance_of(xyz);
}

Color SkyTable::at(Vec2 uv) const {
    float const x = uv.x * float(width) - 0.5f, y = uv.y * float(height) - 0.5f;
    float const fx = std::floor(x), s = x - fx;
    float const fy = std::clamp(std::floor(y), 0.f, float(std::max(height - 2, 0)));
    float const t = std::clamp(y - fy, 0.f, 1.f);
    int const left = (int(fx) + width) % width, right = (left + 1) % width;
    int const top = int(fy), bottom = std::min(top + 1, height - 1);
    auto const row = [&](int j) {
        Color const* const p = &texels[size_t(j) * size_t(width)];
        return lerp(p[left], p[right], s);
    };
    return lerp(row(top), row(bottom), t);
}

SkyTable make_sky_table(SkyParameters const& p, int width, int height) {
    assert(height % 2 == 0);
    double const elevation = std::asin(std::clamp(double(p.sun.y), -1.0, 1.0));
    SkyModel const model(double(p.turbidity), double(std::clamp(luminance(p.ground), 0.f, 1.f)),
                         elevation);
    SkyTable table{width, height, std::vector<Color>(size_t(width) * size_t(height))};
    Color irradiance =
        sun_irradiance(double(p.turbidity), elevation) * (p.sun_factor * std::max(p.sun.y, 0.f));
    for (int y = 0; y < height / 2; ++y) {
        double const theta = kPi64 * (y + 0.5) / height;
        float const part =
            float(2 * kPi64 / width * kPi64 / height * std::sin(theta) * std::cos(theta));
        for (int x = 0; x < width; ++x) {
            Vec3d const d(uv_to_direction(
                {(float(x) + 0.5f) / float(width), (float(y) + 0.5f) / float(height)}));
            Vec3d const sun(p.sun);
            double const gamma = std::atan2(length(cross(d, sun)), dot(d, sun));
            Color& texel = table.texels[size_t(y) * size_t(width) + size_t(x)];
            texel = model.radiance(theta, gamma) * p.sky;
            irradiance += texel * part;
        }
    }
    Color const ground = p.ground * irradiance * kInvPi;
    std::fill(table.texels.begin() + ptrdiff_t(width) * (height / 2), table.texels.end(), ground);
    return table;
}

} // namespace weft::lights
