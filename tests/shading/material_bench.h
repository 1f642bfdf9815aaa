// Materials on a flat patch in the x-y plane, u along x: their lobes seen from anywhere, and the
// power that these send out, by the samples' weights and by evaluating even directions.
#pragma once

#include "base/hash.h"
#include "base/warp.h"
#include "shading/materials.h"
#include "tests/support/statistics.h"

namespace weft::testing {

/// Owns a scene of materials, compiled one after another.
class MaterialBench {
  public:
    scene::MaterialId add(scene::Material material) {
        scene_.materials.push_back(std::move(material));
        scene_.material_locations.emplace_back();
        scene_.material_names.emplace_back();
        return {int32_t(scene_.materials.size()) - 1};
    }
    scene::LayerId add(scene::Layer const& layer) {
        scene_.layers.push_back(layer);
        return {int32_t(scene_.layers.size()) - 1};
    }
    /// An input fed by a new node.
    template <class T>
    scene::Input<T> input(scene::Texture node) {
        scene_.textures.push_back(std::move(node));
        scene_.texture_locations.emplace_back();
        scene::Input<T> in;
        in.texture = {int32_t(scene_.textures.size()) - 1};
        return in;
    }
    /// Says what the last material is called, and where it stands.
    void name_last(std::string const& name, SourceLocation const& where) {
        scene_.material_names.back() = name;
        scene_.material_locations.back() = where;
    }
    scene::Scene const& scene() const { return scene_; }
    shading::Materials const& materials() const { return materials_; }
    void compile() {
        materials_ = shading::Materials(scene_);
        shading::GraphCompiler compiler(scene_);
        for (size_t i = 0; i < scene_.materials.size(); ++i)
            materials_.compile(scene_, {int32_t(i)}, compiler);
    }
    /// After `compile`. `wo` below the patch leaves the object.
    shading::Shading shade(scene::MaterialId id, Vec3 const& wo, bool secondary = false,
                           Vec2 uv = {0.5f, 0.3f}) const {
        shading::SurfacePoint point;
        point.dpdu = {1, 0, 0};
        point.dpdv = {0, 1, 0};
        point.wo = wo;
        point.uv = uv;
        bool const entering = wo.z > 0;
        shading::View const view{.wo = wo,
                                 .ng = {0, 0, entering ? 1.f : -1.f},
                                 .entering = entering,
                                 .look = {secondary}};
        shading::Shading shading(empty_bsdf(point, view));
        materials_.shade(id, point, view, shading);
        return shading;
    }

  private:
    scene::Scene scene_;
    shading::Materials materials_;
};

/// A unit vector above the patch, or below it for a negative cosine.
inline Vec3 towards(float cosine, float azimuth = 0.4f) {
    float const s = safe_sqrt(1 - cosine * cosine);
    return {s * std::cos(azimuth), s * std::sin(azimuth), cosine};
}

/// The power per unit of cosine-weighted light sent towards `wi`: what `eval` says, where crossing
/// to another index does not scale it. For a patch whose normals agree.
inline Color power(lobes::Bsdf const& bsdf, Vec3 const& wo, Vec3 const& wi) {
    Color sum(0);
    for (int k = 0; k < bsdf.size(); ++k) {
        Vec3 const o = bsdf.frame(bsdf[k]).to_local(wo), i = bsdf.frame(bsdf[k]).to_local(wi);
        match(bsdf[k].kind, [&](auto const& lobe) {
            if constexpr (lobes::SmoothLobe<std::remove_cvref_t<decltype(lobe)>>)
                sum += bsdf[k].weight * lobe.eval(o, i).f * eta_scale_towards(lobe, i);
        });
    }
    return sum;
}

/// Sums by channel; the estimate is that of the channel whose mean is the greatest.
struct ColorSums {
    std::array<double, 3> sum{}, squares{};
    int count = 0;
    void add(Color const& c) {
        ++count;
        for (int k = 0; k < 3; ++k) {
            sum[size_t(k)] += double(c[k]);
            squares[size_t(k)] += double(c[k]) * double(c[k]);
        }
    }
    Estimate greatest() const {
        size_t const k = size_t(std::max_element(sum.begin(), sum.end()) - sum.begin());
        double const mean = sum[k] / count;
        return {mean, std::max(squares[k] / count - mean * mean, 0.0) / (count - 1)};
    }
};

/// The mean of f / density over a Fibonacci lattice of the two numbers that place a direction.
template <class L>
Color lattice_power(L const& lobe, Vec3 const& wo) {
    constexpr int samples = 6765;
    std::array<double, 3> sum{};
    for (int i = 0; i < samples; ++i) {
        double const turn = 0.61803398874989484820 * i;
        Vec3 const u(float(turn - std::floor(turn)), float((i + 0.5) / samples), 0.5f);
        Vec3 const wi = lobe.sample(wo, u);
        lobes::LobeValue const v = wi == Vec3(0) ? lobes::LobeValue{} : lobe.eval(wo, wi);
        if (!(v.pdf > 0)) continue;
        float const scale = eta_scale_towards(lobe, wi) / v.pdf;
        for (int k = 0; k < 3; ++k) sum[size_t(k)] += double(v.f[k] * scale) / samples;
    }
    return {float(sum[0]), float(sum[1]), float(sum[2])};
}
/// Reflection and refraction each by themselves, so that no number decides between them.
template <class D>
Color lattice_power(lobes::MicrofacetDielectric<D> const& l, Vec3 const& wo) {
    auto const part = [&](Color const& r, Color const& t) {
        lobes::MicrofacetDielectric<D> one(l.distribution(), l.eta(), r, t, l.options(),
                                           l.compensated());
        one.look_up(wo);
        return is_black(r) && is_black(t) ? Color(0) : lattice_power<decltype(one)>(one, wo);
    };
    return part(l.reflectance(), Color(0)) + part(Color(0), l.transmittance());
}
/// The sent power without noise: to some 2e-4.
inline Color integrated_power(lobes::Bsdf const& bsdf, Vec3 const& wo) {
    Color sum(0);
    for (int i = 0; i < bsdf.size(); ++i) {
        Vec3 const o = bsdf.frame(bsdf[i]).to_local(wo);
        sum += bsdf[i].weight * match(bsdf[i].kind, [&](auto const& lobe) {
                   using L = std::remove_cvref_t<decltype(lobe)>;
                   if constexpr (lobes::SmoothLobe<L>)
                       return lattice_power(lobe, o);
                   else
                       return lobe.albedo(o);
               });
    }
    return sum;
}

/// The sent power by the weights of samples.
inline Estimate sampled_power(lobes::Bsdf const& bsdf, Vec3 const& wo, int samples, uint64_t seed) {
    Rng rng(seed);
    ColorSums sums;
    for (int n = 0; n < samples; ++n) {
        lobes::BsdfSample const s = bsdf.sample(wo, rng.next3());
        if (!(s.pdf > 0))
            sums.add(Color(0));
        else if (is_delta(s.scattering.kind))
            sums.add(s.weight * s.eta_scale);
        else
            sums.add(power(bsdf, wo, s.wi) * (1 / s.pdf));
    }
    return sums.greatest();
}

/// The same of the smooth lobes, by directions of cosine density over both hemispheres.
inline Estimate evaluated_power(lobes::Bsdf const& bsdf, Vec3 const& wo, int samples,
                                uint64_t seed) {
    Rng rng(seed);
    ColorSums sums;
    for (int n = 0; n < samples; ++n) {
        Vec3 const u = rng.next3();
        Vec3 wi = square_to_cosine_hemisphere({u.x, u.y});
        float const pdf = 0.5f * cosine_hemisphere_pdf(wi.z);
        if (u.z < 0.5f) wi.z = -wi.z;
        sums.add(pdf > 0 ? power(bsdf, wo, wi) * (1 / pdf) : Color(0));
    }
    return sums.greatest();
}

} // namespace weft::testing
