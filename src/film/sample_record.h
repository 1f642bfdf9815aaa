// What one sample hands to a film beyond its colour. A thread has one record and uses it for sample
// after sample, so that nothing is allocated along a path.
//
// Light is told apart by its path's first bounce, and a bounce may be shared: where light sampling
// connects a surface to a light, or a path goes on to where several lobes could have sent it, each
// kind of lobe has its share of the value (as Cycles does), and so has each layer of the material.
// The shares are set once per bounce, so that light sampling and scattering agree on the
// components' means as they do on the beauty's.
#pragma once

#include <array>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "base/color.h"
#include "base/vec.h"
#include "film/layout.h"
#include "film/path_log.h"

namespace weft::film {

/// The components of light by the path's first scattering: each RayKind but the camera's, which is
/// the order of Aov::direct_diffuse and so on.
inline constexpr size_t kComponents = kRayKinds - 1;

/// The three Cryptomattes, in the order of Aov::crypto_object and so on.
inline constexpr size_t kCryptomattes = 3;

/// What the things of a scene are called: light groups, layers and Cryptomatte ids, by the indices
/// that contributions, lobes and surfaces carry.
struct SceneTags {
    std::vector<std::string> layers{kDefaultGroup};
    std::vector<std::string> light_groups{kDefaultGroup};
    std::vector<uint16_t> group_of_light, group_of_object;

    struct Cryptomatte {
        std::vector<uint32_t> id_of_object; ///< bits of a float; 0: none
        std::map<std::string, uint32_t> manifest;
    };
    std::array<Cryptomatte, kCryptomattes> cryptomattes;
};

/// The first surface that a camera ray scatters at.
struct FirstSurface {
    uint32_t object = 0;
    float depth = 0; ///< along the camera's axis
    Vec3 p{0, 0, 0}, n{0, 0, 1}, ng{0, 0, 1};
    Vec2 uv{0, 0};
    Color albedo;
};

class SampleRecord {
  public:
    /// Both outlive the record.
    SampleRecord(Layout const& layout, SceneTags const& tags)
        : layout_(layout), tags_(tags), values_(size_t(layout.sums() - layout.first_recorded())) {
        layer_shares_.reserve(layout.options().layers.size());
    }

    /// Forgets the last sample.
    void clear();

    void add(Contribution const& c) {
        if (layout_.has_light()) add_light(c);
        if (log_)
            log_->push_back({.kind = PathEvent::Kind::Light,
                             .value = c.value,
                             .sampled = c.is_sampled(),
                             .object = c.object,
                             .light = c.light,
                             .bounces = c.bounces()});
    }
    void add_removed(Color const& value) { add_to(Aov::removed, value); }
    /// Light on a shadow catcher: with nothing in its way but other catchers, and as it is.
    void add_caught(Color const& lit, Color const& shadowed) {
        add_to(Aov::shadow_catcher, lit);
        add_to(Aov::shadow_catcher, shadowed, 1);
    }
    /// Before what comes over the path's first bounce is added: what takes part in the bounce, each
    /// with its share, per channel. All add up to 1.
    void clear_shares();
    void add_share(RayKind component, uint16_t layer, Color const& share);
    /// Each takes the place of what was said before.
    void set_surface(FirstSurface const& surface) {
        surface_ = surface;
        has_surface_ = true;
    }
    void forget_surface() { has_surface_ = false; }
    void set_alpha(float alpha) { alpha_ = alpha; }
    /// The guides of a denoiser; later calls change nothing.
    void set_guides(Color const& albedo, Vec3 const& normal);
    bool has_guides() const { return has_guides_; }

    /// Keeps what happens along paths from here on; null: nothing.
    void keep_log(PathLog* log) { log_ = log; }
    PathLog* log() const { return log_; }

    /// Writes what was set into `values`: once, when the path is done. False where a number is not
    /// finite; all is 0 then.
    bool finish();

    Layout const& layout() const { return layout_; }
    /// The summed numbers, from layout.first_recorded() on.
    std::span<float const> values() const { return values_; }
    /// Null where the path met no surface.
    FirstSurface const* surface() const { return has_surface_ ? &surface_ : nullptr; }
    /// 0 where the path met no surface, or there is no such id.
    uint32_t cryptomatte_id(size_t which) const {
        auto const& ids = tags_.cryptomattes[which].id_of_object;
        return has_surface_ && surface_.object < ids.size() ? ids[surface_.object] : 0;
    }

  private:
    void add_light(Contribution const& c);
    void add_to(Aov aov, Color const& value, int index = 0);
    void add_to(Aov aov, Vec3 const& v) { add_to(aov, Color(v.x, v.y, v.z)); }

    Layout const& layout_;
    SceneTags const& tags_;
    std::vector<float> values_;
    struct LayerShare {
        uint16_t layer;
        Color share;
    };
    std::array<Color, kComponents> component_shares_{};
    std::vector<LayerShare> layer_shares_; ///< one for each layer
    FirstSurface surface_;
    Color guide_albedo_;
    Vec3 guide_normal_{0, 0, 0};
    PathLog* log_ = nullptr;
    float alpha_ = 1;
    bool has_surface_ = false, has_guides_ = false;
};

} // namespace weft::film
