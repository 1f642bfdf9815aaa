// The half of the lints that is about lights.
#include <algorithm>
#include <fmt/format.h>
#include <map>
#include <set>

#include "base/hash.h"
#include "base/warp.h"
#include "lights/lints.h"

namespace weft::lights {

namespace {

/// Irradiance that no lamp gives a whole scene, in suns (about 1000 W/m^2).
constexpr double kSun = 1000, kManySuns = 1000;
constexpr size_t kManyTriangles = 100'000;

std::string type_of(scene::Light const& light) {
    return "<light type=\"" + match(light, [](auto const& l) { return std::string(l.info.type); }) +
           "\">";
}

class LightLints {
  public:
    explicit LightLints(Stage const& stage)
        : world_(stage.world()), lights_(stage.lights()), scene_(world_.scene()),
          radius_(double(world_.radius())) {}

    std::vector<std::string> all() {
        for (size_t i = 0; i < lights_.size(); ++i) {
            int32_t const light = int32_t(i);
            if (lights_.info(light).controls.weight == 0) continue; // on purpose
            look_at_power(light);
            look_around(light);
            if (auto const* area = std::get_if<AreaLight>(&lights_.kind(light)))
                count_triangles(*area);
        }
        look_at_mirrors();
        return std::move(warnings_);
    }

  private:
    void look_at_power(int32_t light);
    void look_around(int32_t light);
    void count_triangles(AreaLight const& light);
    void look_at_mirrors();

    std::string name_of(int32_t light) const {
        int32_t const source = lights_.info(light).source;
        if (source < 0) return "a light";
        return to_string(location_of(scene_, scene::LightId{source})) + ": " +
               type_of(scene_.lights[size_t(source)]);
    }
    std::string name_of(uint32_t object) const {
        scene::InstanceId const instance{world_.object(object).source_instance};
        std::string const name(scene::name_of(scene_, instance));
        return "the instance" + (name.empty() ? "" : " '" + name + "'") + " at " +
               to_string(location_of(scene_, instance));
    }
    /// A lamp hung from a group that is there a hundred times is one thing to say.
    void warn(std::string text) {
        if (said_.insert(text).second) warnings_.push_back(std::move(text));
    }

    bool lets_light_through(world::Ray const& ray, world::Hit const& hit) const;
    uint32_t enclosure_of(Vec3 const& p, int32_t own) const;
    bool separates(uint32_t object, Vec3 const& a, Vec3 const& b) const;

    world::World const& world_;
    LightTable const& lights_;
    scene::Scene const& scene_;
    double radius_; ///< of the scene, in its units; 1 where nothing is there
    std::vector<std::string> warnings_;
    std::set<std::string> said_;
};

void LightLints::look_at_power(int32_t light) {
    float const power = lights_.info(light).power;
    if (!(power > 0)) {
        warn(name_of(light) + " gives no light: give it a power, intensity or emission above 0, or "
                              "remove it");
        return;
    }
    bool const infinite = match(lights_.kind(light), [](auto const& l) { return l.at_infinity; });
    double const section = kPi * std::max(radius_ * radius_, 1e-12);
    double const irradiance = double(power) / (infinite ? section : 4 * section);
    if (irradiance < kManySuns * kSun) return;
    warn(
        fmt::format("{} lights the scene {:.1g} times as bright as the sun does: watts or radiance "
                    "may be meant for a scene in other units; make it weaker",
                    name_of(light), irradiance / kSun));
}

void LightLints::count_triangles(AreaLight const& light) {
    size_t const count = light.parts();
    if (count <= kManyTriangles) return;
    warn(fmt::format("{} is a light of {} triangles, each of which is sampled for itself: about {} "
                     "MB; emission on a simpler mesh is found faster",
                     name_of(light.object), count, count * 150 / 1'000'000));
}

/// Whether some light passes the surface that was hit.
bool LightLints::lets_light_through(world::Ray const& ray, world::Hit const& hit) const {
    world::Model const& m = world_.model(hit.object);
    if (m.has_alpha || m.is_see_through || m.is_null || m.has_interior) return true;
    auto const point = world_.surface(ray, hit);
    auto const shading = world_.shade(point, -ray.direction);
    return any(shading.bsdf.sides(), lobes::Sides::Transmission);
}

/// The opaque object whose inside is all that can be seen from `p`; UINT32_MAX if there is none.
/// `own`: the light's own surface, which does not count; -1 none.
uint32_t LightLints::enclosure_of(Vec3 const& p, int32_t own) const {
    constexpr int directions = 48;
    uint32_t found = UINT32_MAX;
    Rng rng(1);
    for (int i = 0; i < directions; ++i) {
        world::Ray ray;
        ray.origin = p;
        ray.direction = square_to_sphere({(float(i) + rng.next()) / float(directions), rng.next()});
        world::Hit hit = world_.intersect_solid(ray);
        for (int k = 0; k < 8 && hit && int32_t(hit.object) == own; ++k) {
            ray.origin = shading::offset_origin(world_.surface(ray, hit), ray.direction);
            hit = world_.intersect_solid(ray);
        }
        if (!hit || (found != UINT32_MAX && hit.object != found)) return UINT32_MAX;
        if (dot(world_.surface(ray, hit).ng, ray.direction) < 0) return UINT32_MAX; // a front
        if (lets_light_through(ray, hit)) return UINT32_MAX;
        found = hit.object;
    }
    return found;
}

/// Whether a straight line from `a` to `b` crosses `object` an odd number of times.
bool LightLints::separates(uint32_t object, Vec3 const& a, Vec3 const& b) const {
    world::Ray ray;
    ray.origin = a;
    ray.direction = normalize(b - a);
    ray.t_max = length(b - a);
    bool odd = false;
    for (int k = 0; k < 1000; ++k) {
        world::Hit const hit = world_.intersect_solid(ray);
        if (!hit) break;
        odd ^= hit.object == object;
        Vec3 const origin = shading::offset_origin(world_.surface(ray, hit), ray.direction);
        ray.t_max -= dot(origin - ray.origin, ray.direction);
        ray.origin = origin;
        if (!(ray.t_max > 0)) break;
    }
    return odd;
}

void LightLints::look_around(int32_t light) {
    // What is at infinity cannot be inside of anything.
    std::vector<Vec3> points;
    int32_t own = -1;
    match(lights_.kind(light), [&]<class L>(L const& l) {
        if constexpr (!L::at_infinity) points = l.places();
        if constexpr (L::found_as == FoundAs::Object) own = int32_t(l.object);
    });
    // Rays cannot start further out (Embree's FLT_LARGE), nor is anything there to be inside of.
    constexpr float farthest = 1e18f;
    uint32_t found = UINT32_MAX;
    for (Vec3 const& p : points) {
        if (!(max_component(abs(p)) < farthest)) return;
        uint32_t const here = enclosure_of(p, own);
        if (here == UINT32_MAX || (found != UINT32_MAX && found != here)) return;
        found = here;
    }
    // A room may be modelled by its outside; then the camera is in it, too.
    if (found == UINT32_MAX || !separates(found, points[0], world_.camera().position())) return;
    warn(fmt::format("{} is inside of {}, which is opaque: none of its light gets out; move it, or "
                     "make that transparent",
                     name_of(light), name_of(found)));
}

/// Lights without size are points in a mirror, which no ray meets, and cast no light through glass.
void LightLints::look_at_mirrors() {
    size_t point_light = lights_.size();
    for (size_t i = lights_.size(); i-- > 0;)
        if (!match(lights_.kind(int32_t(i)), [](auto const& l) { return l.has_size(); }))
            point_light = i;
    if (point_light == lights_.size()) return;
    constexpr int side = 48, picks = 8;
    std::map<uint32_t, int> seen; // object -> rays that meet it as a mirror
    Vec2i const size = world_.camera().size();
    for (int i = 0; i < side * side; ++i) {
        Vec2 const raster((float(i % side) + 0.5f) / side * float(size.x),
                          (float(i / side) + 0.5f) / side * float(size.y));
        world::Ray const ray = world_.camera().ray(raster, Vec2(0.5f), 0.5f);
        world::Hit const hit = world_.intersect(ray, uint32_t(i));
        if (!hit || world_.model(hit.object).is_null) continue;
        auto const shading = world_.shade(world_.surface(ray, hit), -ray.direction);
        int mirrored = 0;
        for (int k = 0; k < picks; ++k) {
            auto const s =
                shading.bsdf.sample(-ray.direction, {0.5f, 0.5f, (float(k) + 0.5f) / picks});
            mirrored += s.pdf > 0 && s.scattering.kind == ScatteringKind::Specular;
        }
        if (2 * mirrored > picks) ++seen[hit.object];
    }
    auto const most = std::max_element(
        seen.begin(), seen.end(), [](auto const& a, auto const& b) { return a.second < b.second; });
    if (most == seen.end() || most->second * 200 < side * side) return; // half a percent
    warn(fmt::format("{} has no size, so the mirrors and clear glass of the picture (such as {}) "
                     "neither show it nor pass its light on: use an area light, or some roughness",
                     name_of(int32_t(point_light)), name_of(most->first)));
}

} // namespace

std::vector<std::string> light_warnings(Stage const& stage) { return LightLints(stage).all(); }

} // namespace weft::lights
