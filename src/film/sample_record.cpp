#include "film/sample_record.h"

#include <algorithm>
#include <cmath>

namespace weft::film {

namespace {

/// The AOVs of light whose path is first scattered into a ray of this kind.
struct ComponentAovs {
    Aov direct, indirect;
};

ComponentAovs aovs_of(RayKind kind) {
    switch (kind) {
    case RayKind::camera: // light that is not scattered
        return {Aov::emission, Aov::emission};
    case RayKind::diffuse:
        return {Aov::direct_diffuse, Aov::indirect_diffuse};
    case RayKind::glossy:
        return {Aov::direct_specular, Aov::indirect_specular};
    case RayKind::transmission:
        return {Aov::direct_transmission, Aov::indirect_transmission};
    case RayKind::volume:
        return {Aov::direct_volume, Aov::indirect_volume};
    case RayKind::subsurface:
        break;
    }
    return {Aov::direct_subsurface, Aov::indirect_subsurface};
}

} // namespace

void SampleRecord::clear() {
    drop();
    set(Aov::alpha, 1.f); // until the path finds that it sees the background
}

void SampleRecord::drop() {
    std::fill(values_.begin(), values_.end(), 0.f);
    clear_shares();
    has_surface_ = has_guides_ = false;
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
    if (c.is_sharp) add_to(Aov::denoise_kept, c.value);
    uint32_t const bounces = c.bounces();
    if (bounces == 0) {
        add_to(Aov::layers, c.value);
        add_to(c.found == Found::InBackground ? Aov::background : Aov::emission, c.value);
        return;
    }
    for (size_t i = 0; i < kComponents; ++i) {
        ComponentAovs const aovs = aovs_of(RayKind(i + 1));
        add_to(bounces == 1 ? aovs.direct : aovs.indirect, c.value * component_shares_[i]);
    }
    for (LayerShare const& s : layer_shares_) add_to(Aov::layers, c.value * s.share, s.layer);
}

void SampleRecord::set_numbers(Aov aov, float const* numbers) {
    scene::AovInfo const& info = info_of(aov);
    if (!layout_.has(aov)) return;
    float* const to = info.how == Accumulation::Nearest
                          ? &nearest_[size_t(kNearestOffsets[size_t(aov)])]
                          : &values_[size_t(layout_.offset(aov) - layout_.first_recorded())];
    std::copy_n(numbers, info.channels(), to);
}

void SampleRecord::forget_surface() {
    has_surface_ = false;
    constexpr float zeros[4]{};
    for (scene::AovInfo const& info : scene::kAovs)
        if (info.source == AovSource::FirstSurface && info.how == Accumulation::Mean)
            set_numbers(info.aov, zeros);
}

void SampleRecord::set_guides(Color const& albedo, Vec3 const& normal) {
    if (has_guides_) return;
    set(Aov::denoise_albedo, albedo);
    set(Aov::denoise_normal, normal);
    has_guides_ = true;
}

bool SampleRecord::finish() {
    if (std::all_of(values_.begin(), values_.end(), [](float v) { return std::isfinite(v); }))
        return true;
    drop();
    return false;
}

} // namespace weft::film
