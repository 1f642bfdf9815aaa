// Where a path scatters: at a point on a surface, or at a point in a medium.
//
// Both answer the same questions (how much light goes from wi to wo, and where may it come from),
// so light sampling and the loop treat them alike. A path reaches one by flying through a medium
// or by meeting a surface (find_vertex.h).
#pragma once

#include <array>
#include <span>
#include <type_traits>

#include "base/feature.h"
#include "integrator/path_state.h"
#include "integrator/place.h"
#include "media/phase.h"

namespace weft::integrator {

/// A point in a medium.
class MediumVertex {
  public:
    MediumVertex() = default;
    /// `g`: asymmetry of Henyey and Greenstein's phase function.
    explicit MediumVertex(float g) : g_(g) {}

    /// A medium has one part.
    static constexpr std::array kKinds{ScatteringKind::Medium};

    lobes::LobeValue eval(Vec3 const& wo, Vec3 const& wi) const {
        FeatureScope const scope(Feature::Media);
        float const phase = media::henyey_greenstein(dot(wo, wi), g_);
        return {Color(phase), phase};
    }
    lobes::BsdfSample sample(Vec3 const& wo, sampling::SampleStream const& stream,
                             uint32_t step) const {
        FeatureScope const scope(Feature::Media);
        Vec2 const u = stream.get2(sampling::Dimension::Phase, step);
        Vec3 const wi = media::sample_henyey_greenstein(wo, g_, u);
        return {.wi = wi,
                .weight = Color(1),
                .pdf = media::henyey_greenstein(dot(wo, wi), g_),
                .scattering = {ScatteringKind::Medium}};
    }

  private:
    float g_ = 0;
};

/// A point on a surface. It stays where it was made: its BSDF is large.
struct SurfaceVertex {
    world::Model const& model;
    shading::SurfacePoint point;
    shading::Shading shading; ///< seen from where the path comes from
    Crossings crossings;      ///< of what goes through
    float straight_radiance;  ///< factor of radiance, of what goes through without refraction

    SurfaceVertex(world::World const& world, PathState const& path, Place const& place)
        : model(world.model(place.hit.object)), point(point_of(world, path.ray, place)),
          shading(world.shade(point, -path.ray.direction, place.ior_outside, path.look)),
          crossings(place.crossings), straight_radiance(place.radiance_through) {}
    SurfaceVertex(SurfaceVertex const&) = delete;

    lobes::Bsdf const& bsdf() const { return shading.bsdf; }
    /// Returns the factor of radiance of what goes through by a scattering of that kind. Lobes that
    /// refract have their own.
    float radiance_through(ScatteringKind kind) const {
        return model.has_interior && kind != ScatteringKind::Straight ? 1 : straight_radiance;
    }
    /// Returns whether light that comes from `wi` passes through the surface on its way to `wo`.
    bool is_through(Vec3 const& wi) const { return !bsdf().reflects(wi); }
    /// Returns where a ray towards `wi` starts.
    Vec3 origin(Vec3 const& wi) const {
        bool const through = is_through(wi);
        if (!through && bsdf().bent_normals() == lobes::BentNormals::Softened)
            return shading::lifted_origin(point, wi);
        return shading::offset_origin(point, (dot(point.ng, point.wo) > 0) != through);
    }
    /// Returns whether the path passes by the sample `s` as if there were no surface.
    bool passes(lobes::BsdfSample const& s) const {
        return model.is_see_through && s.scattering.kind == ScatteringKind::Straight;
    }
};

class Vertex {
  public:
    /// A vertex nowhere, to be moved before anything is asked of it. The room for a surface, some
    /// ten kilobytes, stays uninitialised.
    Vertex() {}
    Vertex(Vertex const&) = delete;
    Vertex& operator=(Vertex const&) = delete;

    lights::LitPoint at;     ///< for light sampling
    Vec3 wo{0, 0, 1};        ///< unit, to where the path comes from
    float t = 0;             ///< length of the path's last straight piece
    uint64_t sets = 0;       ///< of instances that the vertex belongs to, as bits
    float reach = kInfinity; ///< rays that leave the vertex see nothing that is further away

    /// Moves the vertex to where the path's ray meets a surface.
    SurfaceVertex const& move_to_surface(Tracer const& t, PathState const& path,
                                         Place const& place);
    /// Moves the vertex to `distance` along the path's ray, in the medium that it is in.
    void move_into_medium(Tracer const& t, PathState const& path, float distance);

    /// Moves a vertex in a medium that rounding may have put on a surface ahead, or behind it, to
    /// where it is certainly before it. `hit`: of the path's ray with that surface.
    void keep_before(Tracer const& t, PathState const& path, world::Hit const& hit);

    /// Returns the surface that the vertex is on; null in a medium.
    SurfaceVertex const* surface() const { return on_surface_ ? &surface_ : nullptr; }

    /// Returns the part of the light from unit `wi` that goes to `wo`, and the density with which
    /// `sample` gives `wi`.
    lobes::LobeValue eval(Vec3 const& wi) const {
        SurfaceVertex const* const s = surface();
        if (!s) return medium_.eval(wo, wi);
        FeatureScope const scope(Feature::Bsdf);
        return s->bsdf().eval(wo, wi);
    }
    /// Returns the kinds of the parts that `eval_part` tells apart. Where `by_part` is false a
    /// surface has one, of any kind.
    std::span<ScatteringKind const> parts(bool by_part) const {
        if (!surface()) return MediumVertex::kKinds;
        return std::span(kParts).first(by_part ? kParts.size() : 1);
    }
    /// Returns the part of `eval` of that kind.
    lobes::LobeValue eval_part(Vec3 const& wi, ScatteringKind part) const {
        SurfaceVertex const* const s = surface();
        if (!s) return eval(wi);
        FeatureScope const scope(Feature::Bsdf);
        return s->bsdf().eval_part(wo, wi, part);
    }
    /// Samples where the light that goes to `wo` comes from. `by_part`: see Bsdf::sample.
    lobes::BsdfSample sample(sampling::SampleStream const& stream, uint32_t step,
                             bool by_part) const {
        SurfaceVertex const* const s = surface();
        if (!s) return medium_.sample(wo, stream, step);
        FeatureScope const scope(Feature::Bsdf);
        return s->bsdf().sample(wo, stream.get3(sampling::Dimension::Bsdf, step), by_part);
    }

    /// Returns where a ray towards `wi` starts.
    Vec3 origin(Vec3 const& wi) const {
        SurfaceVertex const* const s = surface();
        return s ? s->origin(wi) : at.p;
    }
    /// Returns whether light from `wi` comes from the other side of a surface.
    bool is_through(Vec3 const& wi) const {
        SurfaceVertex const* const s = surface();
        return s && s->is_through(wi);
    }
    /// Returns whether `eval` may be other than 0.
    bool is_smooth() const { return !surface() || surface()->bsdf().has_smooth(); }
    /// Returns whether the path may go on as if there were no vertex.
    bool is_see_through() const { return surface() && surface()->model.is_see_through; }

  private:
    static_assert(std::is_trivially_destructible_v<SurfaceVertex>);
    bool on_surface_ = false;
    MediumVertex medium_; ///< where the vertex is not on a surface
    union {               // neither a variant nor an optional: GCC sets all bytes of these to 0
        SurfaceVertex surface_;
    };
};

} // namespace weft::integrator
