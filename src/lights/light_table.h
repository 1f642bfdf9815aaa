// All lights of a world, and how one is chosen and sampled.
#pragma once

#include <bit>
#include <memory>
#include <vector>

#include "base/feature.h"
#include "base/hash.h"
#include "base/match.h"
#include "lights/lamp_scene.h"
#include "lights/light.h"
#include "lights/light_list.h"
#include "lights/light_tree.h"
#include "world/world.h"

namespace weft::lights {

class LightTable {
  public:
    LightTable() = default;
    /// `textures`: of gobos; `world`: of the objects that are lights. Throws
    /// std::runtime_error where memory is short.
    LightTable(LightList list, shading::Textures textures, world::World const& world);

    size_t size() const { return kinds_.size(); }
    // `i`: below size().
    LightKind const& kind(int32_t i) const { return kinds_[size_t(i)]; }
    LightRules const& rules(int32_t i) const { return rules_[size_t(i)]; }
    LightInfo const& info(int32_t i) const { return infos_[size_t(i)]; }
    /// Returns the light that samples an object of the world; -1: none.
    int32_t of_object(uint32_t object) const {
        return light_of_object_.empty() ? -1 : light_of_object_[object];
    }
    /// Returns whether no light is ever sampled.
    bool empty() const { return tree_.empty(); }
    /// Calls f(LightSample) for each light that is chosen to illuminate `at`, with a point on it:
    /// none, one, or up to `at.choices` different ones, whose contributions add up. u.z chooses the
    /// lights, u.xy places the points: at the same place of each light, as each should see them
    /// stratified over the samples of a pixel. Numbers by the order of choice would not be.
    /// `world`: the one that the table was made for.
    template <class F>
    void sample(world::World const& world, LitPoint const& at, Vec3 const& u, F&& f) const {
        tree_.choose_each(at.p, at.n, with_more_digits(u), at.choices, [&](auto const& choice) {
            LightSample const s = sample_chosen(world, choice, at.p, {u.x, u.y});
            if (s.pdf > 0) f(s);
        });
    }
    /// Returns the density with which `sample` gives a point that a ray found on the light.
    float pdf(int32_t light, LitPoint const& at, shading::SurfacePoint const& point) const;

    /// Calls f(light, radiance, pdf) for each light in the background: its radiance from unit
    /// direction `d`, and the density with which `sample` gives that direction.
    template <class F>
    void background(world::World const& world, LitPoint const& at, Vec3 const& d, F&& f) const {
        FeatureScope const scope(Feature::LightSampling);
        for (int32_t i : background_) {
            LightSeen const seen = match(kind(i), [&](auto const& light) -> LightSeen {
                if constexpr (std::decay_t<decltype(light)>::found_as == FoundAs::Background)
                    return light.seen(context(world), at.p, d);
                else
                    return {}; // `background_` has none of these
            });
            f(i, seen.radiance, chance(at, first_leaf_[size_t(i)]) * seen.pdf);
        }
    }

    /// Returns what choosing among the lights takes, in bytes.
    size_t memory_bytes() const;

    /// Returns whether any light heeds controls (scene/light_controls.h).
    bool has_controls() const { return has_controls_; }
    /// Returns whether these depend on the kind of scattering.
    bool has_controls_by_kind() const { return has_controls_by_kind_; }
    /// Returns whether any lamp with a size is not hidden from the camera.
    bool camera_sees_lamps() const { return camera_sees_lamps_; }

    /// Calls f(light, p, radiance, pdf) for each lamp that the ray meets before its t_max: the
    /// point where it is met, its radiance, and the density with which `sample` at `at`, a point on
    /// the ray's line, gives the ray's direction.
    template <class F>
    void lamps(world::World const& world, world::Ray const& ray, LitPoint const& at, F&& f) const {
        if (!lamps_) return;
        FeatureScope const scope(Feature::LightSampling);
        lamps_->each(ray, at.p, [&](LampScene::Meeting const& met) {
            auto const& lamp = std::get<Lamp>(kind(met.light));
            Vec3 const p = ray.origin + ray.direction * met.t;
            float const pdf = chance(at, first_leaf_[size_t(met.light)]) * lamp.pdf(at.p, p, met.n);
            f(met.light, p, lamp.radiance(context(world), -ray.direction), pdf);
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
    /// Returns the chance that a leaf of the tree is among those that `sample` chooses.
    float chance(LitPoint const& at, uint32_t leaf) const {
        return tree_.probability(at.p, at.n, leaf, at.choices);
    }
    LightSample sample_chosen(world::World const& world, LightTree::Choice const& choice,
                              Vec3 const& ref, Vec2 u) const;

    LightContext context(world::World const& world) const { return {world, textures_}; }

    std::vector<LightKind> kinds_;
    std::vector<LightRules> rules_;
    std::vector<LightInfo> infos_;
    std::vector<uint32_t> first_leaf_;     ///< of the tree, per light
    std::vector<uint32_t> light_of_leaf_;  ///< empty where each light has one leaf
    std::vector<int32_t> light_of_object_; ///< empty where no object is a light
    std::vector<int32_t> background_;      ///< lights that are found as FoundAs::Background
    std::unique_ptr<LampScene> lamps_;     ///< null: no lamp has a size
    bool camera_sees_lamps_ = false;
    bool has_controls_ = false, has_controls_by_kind_ = false;
    LightTree tree_;
    shading::Textures textures_; ///< of gobos
};

} // namespace weft::lights
