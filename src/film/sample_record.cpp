#include "film/sample_record.h"

#include <algorithm>
#include <cmath>

namespace weft::film {

void SampleRecord::clear() {
    std::fill(values_.begin(), values_.end(), 0.f);
    clear_shares();
    has_surface_ = has_guides_ = false;
    alpha_ = 1;
}

void SampleRecord::clear_shares() {
    component_shares_ = {};
    layer_shares_.clear();
}

void SampleRecord::add_share(RayKind component, uint16_t layer, Color const& share) {
    component_shares_[size_t(component) - 1] += share;
    if (!layout_.has(Aov::layers)) return;
    for (LayerShare& s : layer_shares_)
        if (s.layer == layer) {
            s.share += share;
            return;
        }
    layer_shares_.push_back({layer, share});
}

void SampleRecord::add_to(Aov aov, Color const& value, int index) {
    int const offset = layout_.offset(aov);
    if (offset < 0) return;
    float* const to = &values_[size_t(offset - layout_.first_recorded() + 3 * index)];
    to[0] += value.r;
    to[1] += value.g;
    to[2] += value.b;
}

void SampleRecord::add_light(Contribution const& c) {
    if (layout_.has(Aov::light_groups)) {
        uint16_t const group = c.light >= 0 ? tags_.group_of_light[size_t(c.light)]
                                            : tags_.group_of_object[size_t(c.object)];
        add_to(Aov::light_groups, c.value, group);
    }
    uint32_t const bounces = c.bounces();
    if (bounces == 0) {
        add_to(Aov::layers, c.value);
        add_to(c.found == Found::InBackground ? Aov::background : Aov::emission, c.value);
        return;
    }
    int const first = int(bounces == 1 ? Aov::direct_diffuse : Aov::indirect_diffuse);
    for (size_t i = 0; i < kComponents; ++i)
        add_to(Aov(first + 2 * int(i)), c.value * component_shares_[i]);
    for (LayerShare const& s : layer_shares_) add_to(Aov::layers, c.value * s.share, s.layer);
}

void SampleRecord::set_guides(Color const& albedo, Vec3 const& normal) {
    if (has_guides_) return;
    guide_albedo_ = albedo;
    guide_normal_ = normal;
    has_guides_ = true;
}

bool SampleRecord::finish() {
    if (int const at = layout_.offset(Aov::alpha); at >= 0)
        values_[size_t(at - layout_.first_recorded())] = alpha_;
    if (has_surface_) {
        add_to(Aov::normal, surface_.n);
        add_to(Aov::normal_geometric, surface_.ng);
        add_to(Aov::albedo, surface_.albedo);
    }
    if (has_guides_) {
        add_to(Aov::denoise_albedo, guide_albedo_);
        add_to(Aov::denoise_normal, guide_normal_);
    }
    if (std::all_of(values_.begin(), values_.end(), [](float v) { return std::isfinite(v); }))
        return true;
    clear();
    return false;
}

} // namespace weft::film
