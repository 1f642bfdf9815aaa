#include "lobes/hair.h"

namespace weft::lobes {

namespace {

/// exp(-x) I_0(x), the modified Bessel function of the first kind, x >= 0: Abramowitz and Stegun
/// 1964, 9.8.1 and 9.8.2; relative error below 2e-7.
float bessel_i0_scaled(float x) {
    if (x < 3.75f) {
        float const t = square(x / 3.75f);
        float const i0 =
            1 + t * (3.5156229f +
                     t * (3.0899424f +
                          t * (1.2067492f + t * (0.2659732f + t * (0.0360768f + t * 0.0045813f)))));
        return i0 * std::exp(-x);
    }
    float const t = 3.75f / x;
    float const series =
        0.39894228f +
        t * (0.01328592f +
             t * (0.00225319f +
                  t * (-0.00157565f +
                       t * (0.00916281f +
                            t * (-0.02057706f +
                                 t * (0.02635537f + t * (-0.01647633f + t * 0.00392377f)))))));
    return series / std::sqrt(x);
}

/// x + 2 pi k in [-pi, pi].
float wrap_angle(float x) { return x - 2 * kPi * std::nearbyint(x * (0.5f * kInvPi)); }

float fifth(float x) { return square(square(x)) * x; }

} // namespace

Color sigma_a_from_melanin(float eumelanin, float pheomelanin) {
    return Color(0.419f, 0.697f, 1.37f) * eumelanin + Color(0.187f, 0.4f, 1.05f) * pheomelanin;
}

Color sigma_a_from_color(Color const& color, float beta_n) {
    float const b = beta_n;
    float const divisor =
        5.969f + b * (-0.215f + b * (2.532f + b * (-10.73f + b * (5.574f + b * 0.245f))));
    auto const channel = [&](float c) {
        return square(std::log(std::min(std::max(c, 1e-3f), 0.999f)) / divisor);
    };
    return {channel(color.r), channel(color.g), channel(color.b)};
}

Hair::Hair(HairParameters const& p, float h)
    : sigma_a_(p.sigma_a), eta_(p.eta), h_(std::min(std::max(h, -1.f), 1.f)),
      gamma_o_(std::asin(h_)) {
    // Chiang et al. 2016, eq. 7 and 8: roughness that looks even, to variance and scale.
    float const m = std::min(std::max(p.beta_m, 0.03f), 1.f);
    float const m20 = square(square(fifth(m)));
    float const v = square(0.726f * m + 0.812f * m * m + 3.7f * m20);
    variance_ = {v, 0.25f * v, 4 * v};
    for (size_t i = 0; i < 3; ++i)
        longitudinal_[i] = 1 / (variance_[i] * -std::expm1(-2 / variance_[i]));

    float const n = std::min(std::max(p.beta_n, 0.03f), 1.f);
    float const n22 = square(square(fifth(n)) * n);
    constexpr float sqrt_pi_over_8 = 0.626657069f;
    scale_ = sqrt_pi_over_8 * (0.265f * n + 1.194f * n * n + 5.372f * n22);
    tail_ = 1 / (1 + std::exp(kPi / scale_));

    // Normals lean towards the root: R leaves nearer to it by 2 alpha, TT nearer to the tip by
    // alpha and TRT by 4 alpha. What leaves mirrors the tilted wo.
    auto const at = [](float angle) { return SinCos{std::sin(angle), std::cos(angle)}; };
    tilt_ = {at(2 * p.alpha), at(-p.alpha), at(-4 * p.alpha)};
}

Hair::Outgoing::Outgoing(Hair const& hair, Vec3 const& wo)
    : sin_theta(wo.x), cos_theta(std::sqrt(wo.y * wo.y + wo.z * wo.z)) {
    // The refracted ray: Snell along the fibre and, with Bravais' index, around it.
    float const sin_theta_t = sin_theta / hair.eta_;
    float const cos_theta_t = safe_sqrt(1 - sin_theta_t * sin_theta_t);
    float const bravais = safe_sqrt(square(hair.eta_) - square(sin_theta));
    float const sin_gamma_t = std::min(std::max(hair.h_ * cos_theta / bravais, -1.f), 1.f);
    gamma_t = std::asin(sin_gamma_t);
    Color const transmittance =
        exp(hair.sigma_a_ * (-2 * safe_sqrt(1 - sin_gamma_t * sin_gamma_t) / cos_theta_t));

    float const cos_gamma_o = safe_sqrt(1 - hair.h_ * hair.h_);
    float const f = fresnel_dielectric(cos_theta * cos_gamma_o, hair.eta_);
    a[0] = Color(f);
    a[1] = transmittance * square(1 - f);
    a[2] = a[1] * transmittance * f;
    // The sum of the geometric series; its denominator is 0 only where a[2] is.
    auto const rest = [](float a2, float tf) { return tf < 1 ? a2 * tf / (1 - tf) : 0.f; };
    Color const tf = transmittance * f;
    a[3] = {rest(a[2].r, tf.r), rest(a[2].g, tf.g), rest(a[2].b, tf.b)};

    float total = 0;
    for (size_t p = 0; p < kLobes; ++p) total += pick[p] = average(a[p]);
    for (float& p : pick) p /= total; // > 0: reflection is never 0
}

Hair::SinCos Hair::tilted(Outgoing const& o, int p) const {
    if (p == 3) return {o.sin_theta, o.cos_theta};
    SinCos const& t = tilt_[size_t(p)];
    return {o.sin_theta * t.cos + o.cos_theta * t.sin,
            std::abs(o.cos_theta * t.cos - o.sin_theta * t.sin)};
}

float Hair::exit_azimuth(Outgoing const& o, int p) const {
    return float(p) * (2 * o.gamma_t + kPi) - 2 * gamma_o_;
}

LobeValue Hair::eval(Vec3 const& wo, Vec3 const& wi) const {
    Outgoing const o(*this, wo);
    float const sin_i = wi.x, cos_i = std::sqrt(wi.y * wi.y + wi.z * wi.z);
    // The azimuth from wo to wi about the fibre; any where one of them runs along it.
    float const phi = std::atan2(wo.y * wi.z - wo.z * wi.y, wo.y * wi.y + wo.z * wi.z);
    LobeValue sum;
    for (int p = 0; p < kLobes; ++p) {
        size_t const i = size_t(std::min(p, 2));
        SinCos const t = tilted(o, p);
        float const c = cos_i * t.cos, v = variance_[i];
        // (cos(theta_o + theta_i) - 1) / v with the digits of small differences.
        float const away = (square(cos_i - t.cos) + square(sin_i + t.sin)) / (2 * v);
        float const m = bessel_i0_scaled(c / v) * std::exp(-away) * longitudinal_[i];
        float n = 0.5f * kInvPi;
        if (p < 3) {
            float const x = std::abs(wrap_angle(phi - exit_azimuth(o, p)));
            float const e = std::exp(-x / scale_);
            n = e / (scale_ * square(1 + e) * (1 - 2 * tail_));
        }
        sum.f += o.a[size_t(p)] * (m * n);
        sum.pdf += o.pick[size_t(p)] * (m * n);
    }
    return sum;
}

Vec3 Hair::sample(Vec3 const& wo, Vec3 const& u) const {
    Outgoing const o(*this, wo);
    int p = 0;
    float rest = u.z;
    while (p + 1 < kLobes && rest >= o.pick[size_t(p)]) rest -= o.pick[size_t(p++)];
    // Rounding may leave the last lobe with a rest though its pick is 0.
    float const fresh = std::min(rest / std::max(o.pick[size_t(p)], 1e-7f), kOneMinusEpsilon);

    // M_p: d'Eon et al. 2013, "Importance sampling for physically-based hair fiber models". A von
    // Mises-Fisher direction about the mirrored inclination; only its inclination is kept.
    float const v = variance_[size_t(std::min(p, 2))];
    SinCos const t = tilted(o, p);
    float const below = // 1 - cosine; the logarithm of 0 is for it to cut off
        std::min(-v * std::log(std::exp(-2 / v) * (1 - u.x) + u.x), 2.f);
    float const sine = safe_sqrt(below * (2 - below));
    float const sin_i = -(1 - below) * t.sin + sine * std::cos(2 * kPi * u.y) * t.cos;
    float const cos_i = safe_sqrt((1 - sin_i) * (1 + sin_i));

    float azimuth = 2 * kPi * fresh;
    if (p < 3) {
        float const q = tail_ + fresh * (1 - 2 * tail_);
        float const logistic = scale_ * std::log(q / (1 - q)); // q may round to 0 or 1
        azimuth = exit_azimuth(o, p) + std::min(std::max(logistic, -kPi), kPi);
    }
    float const phi = std::atan2(wo.z, wo.y) + azimuth;
    return normalize(Vec3(sin_i, cos_i * std::cos(phi), cos_i * std::sin(phi)));
}

Color Hair::albedo(Vec3 const& wo) const {
    Outgoing const o(*this, wo);
    return o.a[0] + o.a[1] + o.a[2] + o.a[3];
}

} // namespace weft::lobes
