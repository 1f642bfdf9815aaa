#include "integrator/first_hit.h"

#include "integrator/find_vertex.h"

namespace weft::integrator {

namespace {

Color as_color(Vec3 const& v) { return {v.x, v.y, v.z}; }
Color direction_color(Vec3 const& v) { return as_color((v + Vec3(1)) * 0.5f); }

/// Returns f(SurfaceVertex) of the surface that the path scatters at first; `otherwise` where there
/// is none.
template <class F>
Color of_first_surface(Tracer const& t, world::Ray const& ray, media::MediumStack const& media,
                       Color const& otherwise, F const& f) {
    PathState path(t.settings, ray, media);
    Vertex here;
    SurfaceVertex const* const surface = find_first_surface(t, path, here);
    return surface ? f(*surface) : otherwise;
}

} // namespace

Color draw(scene::CameraIntegrator const& i, Tracer const&, world::Ray const& ray,
           media::MediumStack const&) {
    if (!i.grid) return as_color(ray.direction);
    // Where the ray meets the plane z = 1.
    float const distance = (1 - ray.origin.z) / ray.direction.z;
    Vec3 const p = ray.origin + ray.direction * distance;
    auto on_line = [&](float x) { return std::fmod(std::abs(x) * i.grid_frequency, 1.f) < 0.1f; };
    return on_line(p.x) || on_line(p.y) ? i.grid_color : direction_color(ray.direction);
}

Color draw(scene::AovIntegrator const& i, Tracer const& t, world::Ray const& ray,
           media::MediumStack const& media) {
    Color const nothing(i.variable == scene::AovVariable::normals ? 0.5f : 0.f);
    return of_first_surface(t, ray, media, nothing,
                            [&](SurfaceVertex const& surface) {
                                shading::SurfacePoint const& point = surface.point;
                                switch (i.variable) {
                                case scene::AovVariable::normals:
                                    return direction_color(point.ns);
                                case scene::AovVariable::distance:
                                    return Color(length(point.p - ray.origin));
                                case scene::AovVariable::uv:
                                    return Color(point.uv.x, point.uv.y, 0);
                                case scene::AovVariable::bvh:
                                    return Color(1);
                                }
                                return Color(0);
                            }) /
           i.scale;
}

Color draw(scene::NormalIntegrator const& i, Tracer const& t, world::Ray const& ray,
           media::MediumStack const& media) {
    return of_first_surface(t, ray, media, Color(0), [&](SurfaceVertex const& surface) {
        return i.remap ? direction_color(surface.point.ns) : as_color(surface.point.ns);
    });
}

Color draw(scene::AlbedoIntegrator const&, Tracer const& t, world::Ray const& ray,
           media::MediumStack const& media) {
    return of_first_surface(t, ray, media, Color(0), [&](SurfaceVertex const& surface) {
        return surface.bsdf().albedo(-ray.direction);
    });
}

} // namespace weft::integrator
