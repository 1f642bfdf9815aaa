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

/// The components of light by the path's first scattering: each RayKind but the camera's.
inline constexpr size_t kComponents = kRayKinds - 1;

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
    std::array<Cryptomatte, kCryptomattes> cryptomattes; ///< of kCryptomatteAovs
};

class SampleRecord {
  public:
    /// Both outlive the record.
    SampleRecord(Layout const& layout, SceneTags const& tags)
        : layout_(layout), tags_(tags), values_(size_t(layout.sums() - layout.first_recorded())) {
        layer_shares_.reserve(layout.options().layers.size());
        clear();
    }

    /// Forgets the last sample: a new one begins.
    void clear();
    /// Drops the sample at hand: all numbers become 0.
    void drop();

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
    /// Sets an AOV that the path sets; nothing happens where it is not asked for. The value, of as
    /// many numbers as the AOV has, takes the place of what was set before.
    void set(Aov aov, float value) { set_numbers(aov, &value); }
    void set(Aov aov, Vec2 const& v) { set_numbers(aov, std::array{v.x, v.y}.data()); }
    void set(Aov aov, Vec3 const& v) { set_numbers(aov, std::array{v.x, v.y, v.z}.data()); }
    void set(Aov aov, Color const& c) { set_numbers(aov, std::array{c.r, c.g, c.b}.data()); }
    /// Adds light on a shadow catcher: with nothing in its way but other catchers, and as it is.
    void add_caught(Color const& lit, Color const& shadowed) {
        add_to(Aov::shadow_catcher, lit);
        add_to(Aov::shadow_catcher, shadowed, 1);
    }
    /// Before what comes over the path's first bounce is added: what takes part in the bounce, each
    /// with its share, per channel. All add up to 1.
    void clear_shares();
    void add_share(RayKind component, uint16_t layer, Color const& share);
    /// Says that the path has met the object whose AOVs of source FirstSurface are set next.
    void meet_surface(uint32_t object) {
        object_ = object;
        has_surface_ = true;
    }
    /// Takes the surface back, and all AOVs of source FirstSurface.
    void forget_surface();
    /// Sets the guides of a denoiser; later calls change nothing.
    void set_guides(Color const& albedo, Vec3 const& normal);
    bool has_guides() const { return has_guides_; }

    /// Keeps what happens along paths from here on; null: nothing.
    void keep_log(PathLog* log) { log_ = log; }
    PathLog* log() const { return log_; }

    /// Returns whether all numbers are finite, to be asked once, when the path is done. Where they
    /// are not, the sample is dropped.
    bool finish();

    Layout const& layout() const { return layout_; }
    /// The summed numbers, from layout.first_recorded() on.
    std::span<float const> values() const { return values_; }
    /// The numbers that the film keeps of the nearest surface; null where the path met none.
    std::array<float, kNearestNumbers> const* nearest() const {
        return has_surface_ ? &nearest_ : nullptr;
    }
    /// Returns the id of a Cryptomatte, by its place in kCryptomatteAovs; 0 where the path met no
    /// surface, or the surface has no such id.
    uint32_t cryptomatte_id(size_t which) const {
        auto const& ids = tags_.cryptomattes[which].id_of_object;
        return has_surface_ && object_ < ids.size() ? ids[object_] : 0;
    }

  private:
    void add_light(Contribution const& c);
    void add_to(Aov aov, Color const& value, int index = 0);
    void set_numbers(Aov aov, float const* numbers);

    Layout const& layout_;
    SceneTags const& tags_;
    std::vector<float> values_;
    struct LayerShare {
        uint16_t layer;
        Color share;
    };
    std::array<Color, kComponents> component_shares_{};
    std::vector<LayerShare> layer_shares_; ///< one for each layer
    std::array<float, kNearestNumbers> nearest_{};
    PathLog* log_ = nullptr;
    uint32_t object_ = 0; ///< of the first surface
    bool has_surface_ = false, has_guides_ = false;
};

} // namespace weft::film
