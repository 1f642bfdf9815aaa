// A smooth boundary between two dielectrics: mirror reflection and Snell refraction shared out as
// dielectric_boundary.h says, each with a tint of its own. Radiance that crosses is scaled by
// 1 / eta^2 (see lobe.h).
#pragma once

#include "lobes/dielectric_boundary.h"
#include "lobes/lobe.h"

namespace weft::lobes {

struct SpecularDielectric {
    float eta = 1.5f; ///< index on the far side / index on wo's side, > 0
    Color reflectance{1.f};
    Color transmittance{1.f};
    BoundaryOptions options{};

    static constexpr LobeFlags flags() { return {ScatteringKind::Specular, Sides::Both}; }
    static constexpr float width() { return 0; }
    DeltaSample sample(Vec3 const& wo, Vec3 const& u) const {
        float cos_t;
        auto const [reflected, transmitted] = tinted(wo.z, cos_t);
        float const r = average(reflected), t = average(transmitted);
        if (!(r + t > 0)) return {};
        float const reflect_probability = r / (r + t);
        if (u.z < reflect_probability) {
            return {.wi = {-wo.x, -wo.y, wo.z},
                    .weight = reflected / reflect_probability,
                    .probability = reflect_probability};
        }
        float const probability = t / (r + t), scale = square(eta);
        if (!(probability > 0)) return {};
        return {.wi = refract(wo, {0, 0, 1}, wo.z, cos_t, eta),
                .weight = transmitted / (probability * scale),
                .probability = probability,
                .eta_scale = scale};
    }
    Color albedo(Vec3 const& wo) const {
        float cos_t;
        auto const [reflected, transmitted] = tinted(wo.z, cos_t);
        return reflected + transmitted;
    }

  private:
    BoundarySplit tinted(float cos_o, float& cos_t) const {
        float const fresnel = fresnel_dielectric(cos_o, eta, cos_t);
        BoundarySplit const s = split_light(options, eta, fresnel, cos_o, cos_t);
        return {reflectance * s.reflected, transmittance * s.transmitted};
    }
};

static_assert(DeltaLobe<SpecularDielectric>);

} // namespace weft::lobes
