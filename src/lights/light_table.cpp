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
    lights.push_back({std::move(kind),
                      controls,
                      {controls, all, all.power, cross_section},
                      source,
                      all.power,
                      hidden_from_camera});
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
    : lights_(std::move(list.lights)), first_leaf_(std::move(list.first_leaf)), tree_(list.bounds),
      textures_(std::move(textures)) {
    if (!world.area_objects().empty()) light_of_object_.assign(world.object_count(), -1);
    std::vector<LampScene::Ball> balls;
    size_t const leaves = list.bounds.size();
    if (leaves != lights_.size()) light_of_leaf_.resize(leaves);
    for (size_t i = 0; i < lights_.size(); ++i) {
        size_t const end = i + 1 < lights_.size() ? first_leaf_[i + 1] : leaves;
        if (!light_of_leaf_.empty())
            std::fill(light_of_leaf_.begin() + first_leaf_[i],
                      light_of_leaf_.begin() + int64_t(end), uint32_t(i));
        if (std::holds_alternative<EnvironmentLight>(lights_[i].kind) ||
            std::holds_alternative<SunDisk>(lights_[i].kind))
            environments_.push_back(int32_t(i));
        if (auto const* area = std::get_if<AreaLight>(&lights_[i].kind))
            light_of_object_[area->object] = int32_t(i);
        if (auto const* lamp = std::get_if<Lamp>(&lights_[i].kind); lamp && lamp->luminaire.ball) {
            camera_sees_lamps_ |= !lights_[i].hidden_from_camera;
            balls.push_back({lamp->luminaire.position(), lamp->luminaire.radius, int32_t(i)});
        }
        has_controls_ |= lights_[i].rules.in_use;
        has_controls_by_kind_ |= lights_[i].rules.by_kind;
    }
    if (!balls.empty()) lamps_ = std::make_unique<LampScene>(world.device(), std::move(balls));
}

size_t LightTable::memory_bytes() const {
    return tree_.memory_bytes() + light_of_leaf_.size() * sizeof(uint32_t);
}

namespace {

LightSample from_delta(DeltaLightSample const& s) {
    LightSample sample;
    if (!(s.distance > 0)) return sample;
    sample.wi = s.wi;
    sample.distance = s.distance;
    sample.radiance = s.irradiance;
    sample.pdf = 1;
    sample.delta = true;
    return sample;
}

/// Of an environment or a disk: {direction, radiance, pdf}.
template <class Sample>
LightSample from_infinity(Sample const& s) {
    LightSample sample;
    sample.wi = s.direction;
    sample.distance = kInfinity;
    sample.radiance = s.radiance;
    sample.pdf = s.pdf;
    return sample;
}

} // namespace

Color LightTable::gobo(Lamp const& lamp, Vec3 const& d) const {
    if (!lamp.gobo) return Color(1);
    auto const& [projection, texture] = *lamp.gobo;
    if (!(dot(projection.frame.n, d) > 0)) return Color(0);
    return textures_.radiance(texture, projection.uv(d));
}

LightSample LightTable::sample_light(world::World const&, Lamp const& l, Vec3 const& ref, Vec2 u,
                                     uint32_t) const {
    if (!l.luminaire.ball) {
        DeltaLightSample s =
            match(l.luminaire.source, [&](auto const& source) { return source.sample(ref); });
        if (l.gobo && s.distance > 0) s.irradiance *= gobo(l, -s.wi);
        return from_delta(s);
    }
    EmitterSample const s = l.luminaire.ball->sample(ref, u);
    LightSample sample;
    if (!(s.pdf > 0)) return sample;
    sample.wi = s.wi;
    sample.distance = s.distance;
    sample.radiance = radiance(l, -s.wi);
    sample.pdf = s.pdf;
    return sample;
}

LightSample LightTable::sample_light(world::World const&, DirectionalLight const& l,
                                     Vec3 const& ref, Vec2, uint32_t) const {
    return from_delta(l.sample(ref));
}

LightSample LightTable::sample_light(world::World const& world, AreaLight const& l, Vec3 const& ref,
                                     Vec2 u, uint32_t part) const {
    EmitterSample const s = match(l.emitter, [&](auto const& e) {
        if constexpr (requires { e.at_uv(ref, u); })
            if (l.texture) return l.texture->sample(e, ref, u);
        return e.sample(ref, u, part);
    });
    LightSample sample;
    if (!(s.pdf > 0) || dot(s.n, s.wi) >= 0) return sample; // nothing, or its back
    float const towards = l.spread.factor(s.n, -s.wi);
    if (towards == 0) return sample;
    sample.wi = s.wi;
    sample.distance = s.distance;
    shading::Textures const& textures = world.textures();
    if (l.uv_alone) {
        sample.radiance = textures.radiance(l.emission, s.uv) * textures.opacity(l.opacity, s.uv);
    } else {
        auto const point = world.point_near(l.object, s.primitive, s.p, -s.wi);
        sample.radiance = textures.radiance(l.emission, point) * textures.opacity(l.opacity, point);
    }
    sample.radiance *= towards;
    sample.pdf = s.pdf;
    sample.object = int32_t(l.object);
    // As far off the light as a ray that leaves it would start.
    Vec3 const extent = abs(s.p) + Vec3(l.extent);
    // Along a flat ray that is further.
    sample.p_error = world::kRounding * dot(abs(s.n), extent) / std::max(-dot(s.n, s.wi), 1e-4f);
    return sample;
}

LightSample LightTable::sample_light(world::World const&, EnvironmentLight const& l,
                                     Vec3 const& ref, Vec2 u, uint32_t) const {
    return from_infinity(l.sample(textures_, ref, u));
}

LightTable::Found LightTable::found_at(EnvironmentLight const& l, Vec3 const& ref,
                                       Vec3 const& d) const {
    auto const s = l.found(textures_, ref, d);
    return {s.radiance, s.pdf};
}

LightSample LightTable::sample_light(world::World const&, SunDisk const& l, Vec3 const&, Vec2 u,
                                     uint32_t) const {
    return from_infinity(l.sample(u));
}

LightTable::Found LightTable::found_at(SunDisk const& l, Vec3 const&, Vec3 const& d) const {
    return {l.radiance(d), l.pdf(d)};
}

LightSample LightTable::sample_chosen(world::World const& world, LightTree::Choice const& choice,
                                      Vec3 const& ref, Vec2 u) const {
    FeatureScope const scope(Feature::LightSampling);
    uint32_t const light = light_of_leaf_.empty() ? choice.index : light_of_leaf_[choice.index];
    LightSample sample = match(lights_[light].kind, [&](auto const& l) {
        return sample_light(world, l, ref, u, choice.index - first_leaf_[light]);
    });
    sample.pdf *= choice.probability;
    sample.light = int32_t(light);
    return sample;
}

float LightTable::pdf(int32_t light, LitPoint const& at, shading::SurfacePoint const& point) const {
    auto const& area = std::get<AreaLight>(lights_[size_t(light)].kind);
    return match(area.emitter, [&](auto const& e) {
        uint32_t const part = e.primitives() > 1 ? point.primitive : 0;
        float const chosen = chance(at, first_leaf_[size_t(light)] + part);
        if (chosen == 0) return 0.f;
        if constexpr (requires { e.at_uv(at.p, point.uv); })
            if (area.texture)
                return chosen * area.texture->pdf(e, at.p, point.p, point.ng, point.uv);
        return chosen * e.pdf(at.p, point.p, point.ng, part);
    });
}

} // namespace weft::lights
