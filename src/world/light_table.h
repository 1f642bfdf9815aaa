// All lights of a world, and how one is chosen and sampled.
#pragma once

#include <bit>
#include <memory>
#include <optional>
#include <variant>
#include <vector>

#include "base/feature.h"
#include "base/hash.h"
#include "base/match.h"
#include "lights/delta_lights.h"
#include "lights/emitter_geometry.h"
#include "lights/emitter_texture.h"
#include "lights/light_tree.h"
#include "lights/luminaire.h"
#include "lights/spread.h"
#include "lights/sun_disk.h"
#include "scene/scene.h"
#include "shading/textures.h"
#include "world/environment_light.h"
#include "world/lamp_scene.h"
#include "world/light_rules.h"

namespace weft::world {

class World;

/// An emissive object, sampled over its surface. One of a mirrored or flat shape emits from the
/// front alone.
struct AreaLight {
    lights::Emitter emitter;
    shading::Emission emission;
    shading::Opacity opacity; ///< rays that look for it miss it where it is not there
    lights::Spread spread;
    std::optional<lights::EmitterTexture> texture; ///< where the emission varies much
    float extent = 0;                              ///< about its size: the root of its area
    uint32_t object = 0;                           ///< of the world
    bool uv_alone = true;                          ///< emission and alpha depend on uv alone
};

/// An image in front of a spot, black outside of its unit square.
struct Gobo {
    lights::GoboProjection projection;
    scene::Input<Color> texture;
};

/// A point or a ball that shines.
struct Lamp {
    lights::Luminaire luminaire;
    std::optional<Gobo> gobo;
};

using LightKind =
    std::variant<Lamp, lights::DirectionalLight, AreaLight, EnvironmentLight, lights::SunDisk>;

struct Light {
    LightKind kind;
    scene::LightControls controls;
    LightRules rules;
    int32_t source = -1;             ///< of the scene's lights, for messages
    float power = 0;                 ///< luminance of all that it emits
    bool hidden_from_camera = false; ///< a lamp, seen by bounced rays alone
};

/// A point to be lit, as far as the choice of lights goes.
struct LitPoint {
    Vec3 p{0, 0, 0};
    Vec3 n{0, 0, 0};      ///< unit normal; 0 in a medium
    uint32_t choices = 1; ///< up to so many lights at once
};

struct LightSample {
    Vec3 wi{0, 0, 1};
    float distance = 0; ///< infinite for lights at infinity
    Color radiance;     ///< for delta lights: irradiance on a facing surface
    float pdf = 0;      ///< per solid angle, times the chance of the light
    bool delta = false; ///< `pdf` is the chance of the light alone
    float p_error = 0;  ///< how near to the light a shadow ray may go
    int32_t light = -1;
    int32_t object = -1; ///< whose surface it is; -1: none
};

/// The lights while they are collected, and the leaves that the light tree is to have: one for
/// each light, but for meshes one for each triangle.
struct LightList {
    std::vector<Light> lights;
    std::vector<lights::LightBounds> bounds; ///< per leaf
    std::vector<uint32_t> first_leaf;        ///< per light
    float cross_section = 1; ///< of the scene, for the power of what shines from infinity
    int32_t source = -1;     ///< which of the scene's lights the next ones are

    /// `leaves`: their powers are the luminance of what each emits in all.
    void add(LightKind kind, std::span<lights::LightBounds const> leaves,
             scene::LightControls const& controls, bool hidden_from_camera = false);
    /// A light of one leaf.
    void add(LightKind kind, lights::LightBounds where, float power,
             scene::LightControls const& controls, bool hidden_from_camera = false) {
        where.power = power;
        add(std::move(kind), std::span(&where, 1), controls, hidden_from_camera);
    }
    /// A light that is no object: hiding it from the camera is no control that takes light away.
    void add_lamp(LightKind kind, lights::LightBounds const& where, float power,
                  scene::LightControls controls) {
        bool const hidden = !controls.visible_to_camera;
        controls.visible_to_camera = true;
        add(std::move(kind), where, power, controls, hidden);
    }
};

class LightTable {
  public:
    LightTable() = default;
    /// `world`: whose lights they are; outlives the table.
    LightTable(LightList list, World const& world);

    size_t size() const { return lights_.size(); }
    Light const& operator[](int32_t i) const { return lights_[size_t(i)]; }
    /// Makes the lamps that have a size known to rays.
    void commit_lamps(RTCDevice device);
    /// Whether no light is ever sampled.
    bool empty() const { return tree_.empty(); }
    /// Calls f(LightSample) for each light that is chosen to illuminate `at`, with a point on it:
    /// none, one, or up to `at.choices` different ones, whose contributions add up. u.z chooses the
    /// lights, u.xy places the points: at the same place of each light, as each should see them
    /// stratified over the samples of a pixel. Numbers by the order of choice would not be.
    template <class F>
    void sample(LitPoint const& at, Vec3 const& u, F&& f) const {
        tree_.choose_each(at.p, at.n, with_more_digits(u), at.choices, [&](auto const& choice) {
            LightSample const s = sample_chosen(choice, at.p, {u.x, u.y});
            if (s.pdf > 0) f(s);
        });
    }
    /// The density with which `sample` gives a point that a ray found on the light.
    float pdf(int32_t light, LitPoint const& at, shading::SurfacePoint const& point) const;

    /// Radiance from unit direction `d` of all lights infinitely far away that rays can meet, each
    /// with the density with which `sample` gives that direction: calls f(light, radiance, pdf).
    template <class F>
    void environment(LitPoint const& at, Vec3 const& d, F&& f) const {
        FeatureScope const scope(Feature::LightSampling);
        for (int32_t i : environments_) {
            Found const found = match(lights_[size_t(i)].kind,
                                      [&](auto const& light) { return found_at(light, at.p, d); });
            f(i, found.radiance, chance(at, first_leaf_[size_t(i)]) * found.pdf);
        }
    }

    /// What choosing among the lights takes, in bytes.
    size_t memory_bytes() const;

    /// Whether any lamp of a size is not hidden from the camera.
    bool camera_sees_lamps() const { return camera_sees_lamps_; }

    /// Radiance of all lamps that the ray meets before its t_max, each with the density with which
    /// `sample` at `at`, a point on the ray's line, gives its direction: calls f(light, p,
    /// radiance, pdf) with the point where it is met.
    template <class F>
    void lamps(Ray const& ray, LitPoint const& at, F&& f) const {
        if (!lamps_) return;
        FeatureScope const scope(Feature::LightSampling);
        lamps_->each(ray, at.p, [&](LampScene::Meeting const& met) {
            auto const& lamp = std::get<Lamp>(lights_[size_t(met.light)].kind);
            Vec3 const p = ray.origin + ray.direction * met.t;
            float const pdf = chance(at, first_leaf_[size_t(met.light)]) *
                              lamp.luminaire.ball->pdf(at.p, p, met.n);
            f(met.light, p, radiance(lamp, -ray.direction), pdf);
        });
    }

  private:
    /// The third random number has 24 digits, of which a million leaves take 20. The others say how
    /// it goes on.
    static double with_more_digits(Vec3 const& u) {
        uint32_t const rest =
            hash_combine(std::bit_cast<uint32_t>(u.x), std::bit_cast<uint32_t>(u.y));
        return double(u.z) + double(rest) * 0x1p-56;
    }
    /// That a leaf of the tree is among those that `sample` chooses.
    float chance(LitPoint const& at, uint32_t leaf) const {
        return tree_.probability(at.p, at.n, leaf, at.choices);
    }
    LightSample sample_chosen(lights::LightTree::Choice const& choice, Vec3 const& ref,
                              Vec2 u) const;

    /// What a ray that leaves the scene finds of a light.
    struct Found {
        Color radiance;
        float pdf = 0; ///< per solid angle, of the light alone
    };
    Found found_at(EnvironmentLight const& light, Vec3 const& ref, Vec3 const& d) const;
    Found found_at(lights::SunDisk const& light, Vec3 const& ref, Vec3 const& d) const;
    template <class Other>
    Found found_at(Other const&, Vec3 const&, Vec3 const&) const {
        return {};
    }
    /// What the lamp's image lets through along `d`, away from it.
    Color gobo(Lamp const& lamp, Vec3 const& d) const;
    Color radiance(Lamp const& lamp, Vec3 const& d) const {
        return lamp.luminaire.radiance(d) * gobo(lamp, d);
    }
    LightSample sample_light(Lamp const&, Vec3 const& ref, Vec2 u, uint32_t) const;
    LightSample sample_light(lights::DirectionalLight const&, Vec3 const& ref, Vec2,
                             uint32_t) const;
    LightSample sample_light(AreaLight const&, Vec3 const& ref, Vec2 u, uint32_t part) const;
    LightSample sample_light(EnvironmentLight const&, Vec3 const& ref, Vec2 u, uint32_t) const;
    LightSample sample_light(lights::SunDisk const&, Vec3 const&, Vec2 u, uint32_t) const;

    std::vector<Light> lights_;
    std::vector<uint32_t> first_leaf_;    ///< of the tree, per light
    std::vector<uint32_t> light_of_leaf_; ///< empty where each light has one leaf
    std::vector<int32_t> environments_;   ///< lights that rays meet infinitely far away
    std::unique_ptr<LampScene> lamps_;    ///< null: no lamp has a size
    bool camera_sees_lamps_ = false;
    lights::LightTree tree_;
    World const* world_ = nullptr;
    shading::Textures const* textures_ = nullptr; ///< of the world
};

} // namespace weft::world
