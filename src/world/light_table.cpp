#include "world/light_table.h"

#include "world/world.h"

namespace weft::world {

LightTable::LightTable(std::vector<Light> lights, std::span<lights::LightBounds const> bounds,
                       World const& world)
    : lights_(std::move(lights)), tree_(bounds), world_(&world), textures_(&world.textures()) {
    for (size_t i = 0; i < lights_.size(); ++i)
        if (std::holds_alternative<EnvironmentLight>(lights_[i].kind) ||
            std::holds_alternative<lights::SunDisk>(lights_[i].kind))
            environments_.push_back(int32_t(i));
}

namespace {

LightSample from_delta(lights::DeltaLightSample const& s) {
    LightSample sample;
    if (!(s.distance > 0)) return sample;
    sample.wi = s.wi;
    sample.distance = s.distance;
    sample.radiance = s.irradiance;
    sample.pdf = 1;
    sample.delta = true;
    return sample;
}

} // namespace

void LightTable::commit_lamps(RTCDevice device) {
    std::vector<LampScene::Ball> balls;
    for (size_t i = 0; i < lights_.size(); ++i)
        if (auto const* lamp = std::get_if<Lamp>(&lights_[i].kind); lamp && lamp->luminaire.ball)
            balls.push_back({lamp->luminaire.position(), lamp->luminaire.radius, int32_t(i)});
    if (!balls.empty()) lamps_ = std::make_unique<LampScene>(device, std::move(balls));
}

Color LightTable::gobo(Lamp const& lamp, Vec3 const& d) const {
    if (!lamp.gobo) return Color(1);
    auto const& [projection, texture] = *lamp.gobo;
    if (!(dot(projection.frame.n, d) > 0)) return Color(0);
    return textures_->radiance(texture, projection.uv(d));
}

LightSample LightTable::sample_light(Lamp const& l, Vec3 const& ref, Vec2 u) const {
    if (!l.luminaire.ball) {
        lights::DeltaLightSample s =
            match(l.luminaire.source, [&](auto const& source) { return source.sample(ref); });
        if (l.gobo && s.distance > 0) s.irradiance *= gobo(l, -s.wi);
        return from_delta(s);
    }
    lights::EmitterSample const s = l.luminaire.ball->sample(ref, u);
    LightSample sample;
    if (!(s.pdf > 0)) return sample;
    sample.wi = s.wi;
    sample.distance = s.distance;
    sample.radiance = radiance(l, -s.wi);
    sample.pdf = s.pdf;
    return sample;
}

LightSample LightTable::sample_light(lights::DirectionalLight const& l, Vec3 const& ref,
                                     Vec2) const {
    return from_delta(l.sample(ref));
}

LightSample LightTable::sample_light(AreaLight const& l, Vec3 const& ref, Vec2 u) const {
    lights::EmitterSample const s =
        match(l.emitter, [&](auto const& e) { return e.sample(ref, u); });
    LightSample sample;
    if (!(s.pdf > 0) || dot(s.n, s.wi) >= 0) return sample; // nothing, or its back
    sample.wi = s.wi;
    sample.distance = s.distance;
    if (l.uv_alone) {
        sample.radiance =
            textures_->radiance(l.emission, s.uv) * textures_->opacity(l.opacity, s.uv);
    } else {
        auto const point = world_->point_near(l.object, s.primitive, s.p, -s.wi);
        sample.radiance =
            textures_->radiance(l.emission, point) * textures_->opacity(l.opacity, point);
    }
    sample.pdf = s.pdf;
    sample.object = int32_t(l.object);
    // As far off the light as a ray that leaves it would start.
    Vec3 const extent = abs(s.p) + Vec3(l.extent);
    // Along a flat ray that is further.
    sample.p_error = kRounding * dot(abs(s.n), extent) / std::max(-dot(s.n, s.wi), 1e-4f);
    return sample;
}

LightSample LightTable::sample_light(EnvironmentLight const& l, Vec3 const&, Vec2 u) const {
    auto const s = l.sampler.sample(u);
    LightSample sample;
    sample.wi = normalize(l.to_world.vector(s.direction));
    sample.distance = kInfinity;
    sample.radiance = textures_->radiance(l.texture, s.uv) * l.tint;
    sample.pdf = s.pdf;
    return sample;
}

LightTable::Found LightTable::found_at(EnvironmentLight const& l, Vec3 const& d) const {
    Vec3 const local = normalize(l.to_map.vector(d));
    return {textures_->radiance(l.texture, lights::direction_to_uv(local)) * l.tint,
            l.sampler.pdf(local)};
}

LightSample LightTable::sample_light(lights::SunDisk const& l, Vec3 const&, Vec2 u) const {
    auto const s = l.sample(u);
    LightSample sample;
    sample.wi = s.direction;
    sample.distance = kInfinity;
    sample.radiance = s.radiance;
    sample.pdf = s.pdf;
    return sample;
}

LightTable::Found LightTable::found_at(lights::SunDisk const& l, Vec3 const& d) const {
    return {l.radiance(d), l.pdf(d)};
}

LightSample LightTable::sample(Vec3 const& ref, Vec3 const& n, Vec3 const& u) const {
    auto const choice = tree_.choose(ref, n, u.z);
    if (!(choice.probability > 0)) return {};
    LightSample sample = match(lights_[choice.index].kind, [&](auto const& l) {
        return sample_light(l, ref, {u.x, u.y});
    });
    sample.pdf *= choice.probability;
    sample.light = int32_t(choice.index);
    return sample;
}

float LightTable::pdf(int32_t light, Vec3 const& ref, Vec3 const& n,
                      shading::SurfacePoint const& point) const {
    auto const& area = std::get<AreaLight>(lights_[size_t(light)].kind);
    float const choice = tree_.probability(ref, n, uint32_t(light));
    if (choice == 0) return 0;
    return choice * match(area.emitter, [&](auto const& e) {
               return e.pdf(ref, point.p, point.ng, point.primitive);
           });
}

} // namespace weft::world
