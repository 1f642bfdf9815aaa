#include "lights/light_bounds.h"

namespace weft::lights {

namespace {

float angle_between(Vec3 const& a, Vec3 const& b) {
    return std::atan2(length(cross(a, b)), dot(a, b));
}

/// The axis and theta_o of a cone around both cones of normals.
void unite_normals(LightBounds& a, LightBounds const& b) {
    float const apart = angle_between(a.axis, b.axis);
    if (std::min(apart + b.theta_o, kPi) <= a.theta_o) return;
    if (std::min(apart + a.theta_o, kPi) <= b.theta_o) {
        a.axis = b.axis;
        a.theta_o = b.theta_o;
        return;
    }
    float const theta = 0.5f * (a.theta_o + apart + b.theta_o);
    Vec3 const aside = b.axis - a.axis * dot(a.axis, b.axis);
    float const aside_length = length(aside);
    if (theta >= kPi || !(aside_length > 1e-4f)) {
        a.theta_o = std::min(kPi, a.theta_o + apart + b.theta_o);
        return;
    }
    float const turn = theta - a.theta_o;
    a.axis = normalize(a.axis * std::cos(turn) + aside * (std::sin(turn) / aside_length));
    a.theta_o = theta;
}

} // namespace

LightBounds bounds_of(PointLight const& light) { return {light.position, light.position}; }

LightBounds bounds_of(SpotLight const& light) {
    LightBounds b{light.position, light.position, light.axis};
    float const bright = std::min(0.5f * light.angle, kPi);
    float const end = std::min(0.5f * (light.angle + light.falloff), kPi);
    // Past 90 degrees the linear falloff stays above the cosine.
    b.theta_o = std::max(bright, end - kPi / 2);
    b.theta_e = end - b.theta_o;
    return b;
}

LightBounds bounds_of(PhotometricLight const& light) {
    LightBounds b{light.position, light.position, light.frame.n};
    // A cone around straight down or straight up, whichever holds all light in less.
    scene::Photometry const& lamp = *light.lamp;
    size_t const count = lamp.vertical.size();
    size_t first = count, last = 0; // angles that are not dark, and the dark ones beside them
    for (size_t i = 0; i < lamp.candela.size(); ++i) {
        if (!(lamp.candela[i] > 0)) continue;
        size_t const v = i % count;
        first = std::min(first, v > 0 ? v - 1 : v);
        last = std::max(last, std::min(v + 1, count - 1));
    }
    if (first == count) return b; // all dark
    float const down = radians(lamp.vertical[last]), up = kPi - radians(lamp.vertical[first]);
    if (up < down) b.axis = -b.axis;
    b.theta_o = std::clamp(std::min(up, down), 0.f, kPi);
    b.theta_e = 0;
    return b;
}

LightBounds bounds_of(Luminaire const& lamp) {
    LightBounds b = match(lamp.source, [](auto const& source) { return bounds_of(source); });
    b.low -= Vec3(lamp.radius);
    b.high += Vec3(lamp.radius);
    return b;
}

LightBounds bounds_of(RectangleEmitter const& emitter, uint32_t) {
    auto const [low, high] = emitter.box();
    return {low, high, emitter.normal(), 0};
}

LightBounds bounds_of(SphereEmitter const& emitter, uint32_t) {
    auto const [low, high] = emitter.box();
    return {low, high};
}

LightBounds bounds_of(DiskEmitter const& emitter, uint32_t) {
    auto const [low, high] = emitter.box();
    return {low, high, emitter.normal(), 0};
}

LightBounds bounds_of(MeshEmitter const& emitter, uint32_t primitive) {
    auto const [low, high] = emitter.box(primitive);
    // What has no area has no normal, and no power.
    bool const flat = emitter.area(primitive) > 0;
    return {low, high, flat ? emitter.normal(primitive) : Vec3(0, 0, 1), 0};
}

LightBounds unite(LightBounds const& a, LightBounds const& b) {
    LightBounds both = a;
    both.low = min(a.low, b.low);
    both.high = max(a.high, b.high);
    both.theta_e = std::max(a.theta_e, b.theta_e);
    both.power = a.power + b.power;
    unite_normals(both, b);
    return both;
}

LightBounds unite(std::span<LightBounds const> all) {
    LightBounds u = all[0];
    double power = 0;
    Vec3 axes(0);
    for (LightBounds const& b : all) {
        u.low = min(u.low, b.low);
        u.high = max(u.high, b.high);
        u.theta_o = std::max(u.theta_o, b.theta_o);
        u.theta_e = std::max(u.theta_e, b.theta_e);
        power += double(b.power);
        axes += b.axis;
    }
    u.power = float(power);
    if (all.size() == 1 || u.theta_o >= kPi) return u;
    // Axes that cancel have no mean: one of them will do, and the cone will be wide.
    if (length(axes) > 1e-3f * float(all.size())) u.axis = normalize(axes);
    // Of all that have no cone of their own, as triangles, the farthest decides.
    LightBounds const* farthest = nullptr;
    float least = 2;
    for (LightBounds const& b : all) {
        if (b.theta_o > 0) {
            u.theta_o = std::max(u.theta_o, angle_between(u.axis, b.axis) + b.theta_o);
        } else if (float const cosine = dot(u.axis, b.axis); cosine < least) {
            least = cosine;
            farthest = &b;
        }
    }
    if (farthest) u.theta_o = std::max(u.theta_o, angle_between(u.axis, farthest->axis));
    // Near 1, cosines tell angles apart by no more than this.
    if (farthest && least > 0.999f) u.theta_o += 5e-4f;
    u.theta_o = std::min(u.theta_o, kPi);
    return u;
}

float orientation_measure(LightBounds const& bounds) {
    float const o = bounds.theta_o, w = std::min(o + bounds.theta_e, kPi);
    // As a sum of positive terms, which narrow cones need to keep their digits.
    return kPi *
           (4 * square(std::sin(0.5f * o)) + (w - o) * std::sin(o) + std::sin(w - o) * std::sin(w));
}

} // namespace weft::lights
