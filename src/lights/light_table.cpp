#include "lights/light_table.h"

namespace weft::lights {

namespace {

/// What a light's power counts as at most, so that those of millions have a finite sum.
constexpr float kMostPower = 1e30f;

} // namespace

void LightList::add(LightKind kind, std::span<LightBounds const> leaves,
                    scene::LightControls const& controls, bool hidden_from_camera) {
    LightBounds all = leaves.empty() ? LightBounds() : unite(leaves);
    all.power = std::min(all.power, kMostPower);
    kinds.push_back(std::move(kind));
    rules.emplace_back(controls, all, all.power, cross_section);
    infos.push_back({controls, source, all.power, hidden_from_camera});
    first_leaf.push_back(uint32_t(bounds.size()));
    for (LightBounds const& leaf : leaves) {
        bounds.push_back(leaf);
        // First to a number, which weight 0 makes 0.
        bounds.back().power =
            std::min(std::min(leaf.power, kMostPower) * controls.weight, kMostPower);
        bounds.back().weight = controls.weight;
    }
}

LightTable::LightTable(LightList list, shading::Textures textures, world::World const& world)
    : kinds_(std::move(list.kinds)), rules_(std::move(list.rules)), infos_(std::move(list.infos)),
      first_leaf_(std::move(list.first_leaf)), tree_(list.bounds), textures_(std::move(textures)) {
    if (!world.area_objects().empty()) light_of_object_.assign(world.object_count(), -1);
    std::vector<LampScene::Ball> balls;
    size_t const leaves = list.bounds.size();
    if (leaves != kinds_.size()) light_of_leaf_.resize(leaves);
    for (size_t i = 0; i < kinds_.size(); ++i) {
        size_t const end = i + 1 < kinds_.size() ? first_leaf_[i + 1] : leaves;
        if (!light_of_leaf_.empty())
            std::fill(light_of_leaf_.begin() + first_leaf_[i],
                      light_of_leaf_.begin() + int64_t(end), uint32_t(i));
        match(kinds_[i], [&](auto const& light) {
            constexpr FoundAs found_as = std::decay_t<decltype(light)>::found_as;
            if constexpr (found_as == FoundAs::Background) {
                background_.push_back(int32_t(i));
            } else if constexpr (found_as == FoundAs::Object) {
                light_of_object_[light.object] = int32_t(i);
            } else if constexpr (found_as == FoundAs::Lamp) {
                if (!light.has_size()) return;
                camera_sees_lamps_ |= !infos_[i].hidden_from_camera;
                balls.push_back({light.luminaire.position(), light.luminaire.radius, int32_t(i)});
            } else {
                static_assert(found_as == FoundAs::Nothing);
            }
        });
        has_controls_ |= rules_[i].in_use;
        has_controls_by_kind_ |= rules_[i].by_kind;
    }
    if (!balls.empty()) lamps_ = std::make_unique<LampScene>(world.device(), std::move(balls));
}

size_t LightTable::memory_bytes() const {
    return tree_.memory_bytes() + light_of_leaf_.size() * sizeof(uint32_t);
}

LightSample LightTable::sample_chosen(world::World const& world, LightTree::Choice const& choice,
                                      Vec3 const& ref, Vec2 u) const {
    FeatureScope const scope(Feature::LightSampling);
    uint32_t const light = light_of_leaf_.empty() ? choice.index : light_of_leaf_[choice.index];
    LightSample sample = match(kinds_[light], [&](auto const& l) {
        return l.sample(context(world), ref, u, choice.index - first_leaf_[light]);
    });
    sample.pdf *= choice.probability;
    sample.light = int32_t(light);
    return sample;
}

float LightTable::pdf(int32_t light, LitPoint const& at, shading::SurfacePoint const& point) const {
    auto const& area = std::get<AreaLight>(kind(light));
    uint32_t const part = area.parts() > 1 ? point.primitive : 0;
    float const chosen = chance(at, first_leaf_[size_t(light)] + part);
    return chosen == 0 ? 0 : chosen * area.pdf(at.p, point, part);
}

} // namespace weft::lights
