// Each node against a formula of its own, written down again in doubles.
#include <functional>

#include "base/blackbody.h"
#include "tests/shading/networks.h"

using namespace weft;
using namespace weft::testing;

namespace {

using Formula = std::function<double(double, double)>;

/// The node's inputs are the position's x, y, z and literals.
template <class Node>
void check_unary(std::function<double(double)> const& formula) {
    Rng rng(1);
    for (int i = 0; i < 100; ++i) {
        Network net;
        Node node;
        node.in = net.any(place());
        auto const id = net.add(node);
        auto const point = random_point(rng);
        Vec3 const& p = point.p;
        expect_near(net.at(id, point), {formula(p.x), formula(p.y), formula(p.z)}, 1e-6,
                    std::string(Node::info.type));
    }
}

template <class Node>
void check_binary(Formula const& formula) {
    Rng rng(2);
    for (int i = 0; i < 100; ++i) {
        Network net;
        Node node;
        node.in1 = net.any(place());
        Vec3 const b = rng.next3() * 4.f - Vec3(2);
        node.in2.value = AnyValue(b.x, b.y, b.z);
        auto const id = net.add(node);
        auto const point = random_point(rng);
        Vec3 const& p = point.p;
        expect_near(net.at(id, point), {formula(p.x, b.x), formula(p.y, b.y), formula(p.z, b.z)},
                    2e-6, std::string(Node::info.type));
    }
}

TEST(NodeValues, Arithmetic) {
    check_unary<nodes::Absval>([](double x) { return x < 0 ? -x : x; });
    check_unary<nodes::Floor>([](double x) { return std::floor(x); });
    check_unary<nodes::Ceil>([](double x) { return std::ceil(x); });
    check_unary<nodes::Sin>([](double x) { return std::sin(x); });
    check_unary<nodes::Cos>([](double x) { return std::cos(x); });
    check_binary<nodes::Add>([](double a, double b) { return a + b; });
    check_binary<nodes::Subtract>([](double a, double b) { return a - b; });
    check_binary<nodes::Multiply>([](double a, double b) { return a * b; });
    check_binary<nodes::Divide>([](double a, double b) { return a / b; });
    check_binary<nodes::Modulo>([](double a, double b) { return a - b * std::floor(a / b); });
    check_binary<nodes::Power>([](double a, double b) { return a < 0 ? 0 : std::pow(a, b); });
    check_binary<nodes::Min>([](double a, double b) { return a < b ? a : b; });
    check_binary<nodes::Max>([](double a, double b) { return a < b ? b : a; });
}

TEST(NodeValues, NoNanOutOfNumbers) {
    Network net;
    nodes::Divide divide;
    divide.in1.value = AnyValue(1.f), divide.in2.value = AnyValue(0.f);
    EXPECT_EQ(net.at(net.add(divide), {}), Vec3(0));
    nodes::Modulo modulo;
    modulo.in1.value = AnyValue(1.f), modulo.in2.value = AnyValue(0.f);
    EXPECT_EQ(net.at(net.add(modulo), {}), Vec3(0));
    nodes::Power power;
    power.in1.value = AnyValue(-1.f), power.in2.value = AnyValue(0.5f);
    EXPECT_EQ(net.at(net.add(power), {}), Vec3(0));
    EXPECT_EQ(net.at(net.add(nodes::Normalize{}), {}), Vec3(0));
    nodes::Smoothstep step;
    step.low.value = step.high.value = AnyValue(0.5f);
    step.in.value = AnyValue(0.4f, 0.5f, 0.6f);
    EXPECT_EQ(net.at(net.add(step), {}), Vec3(0, 1, 1));
}

TEST(NodeValues, RangesAndMixes) {
    Rng rng(3);
    for (int i = 0; i < 100; ++i) {
        auto const point = random_point(rng);
        Vec3d const p(point.p);
        auto each = [&](auto f) { return Vec3d(f(p.x), f(p.y), f(p.z)); };
        Network net;
        nodes::Clamp clamp;
        clamp.in = net.any(place());
        expect_near(net.at(net.add(clamp), point),
                    each([](double x) { return x < 0   ? 0
                                               : x > 1 ? 1
                                                       : x; }), 0, "clamp");
        nodes::Remap remap{
            net.any(place()), {AnyValue(-1.f)}, {AnyValue(2.f)}, {AnyValue(5.f)}, {AnyValue(-4.f)}};
        expect_near(net.at(net.add(remap), point),
                    each([](double x) { return 5 - 9 * (x + 1) / 3; }), 1e-6, "remap");
        nodes::Smoothstep step{net.any(place()), {AnyValue(-0.5f)}, {AnyValue(1.5f)}};
        expect_near(net.at(net.add(step), point), each([](double x) {
                        double const t = std::min(1., std::max(0., (x + 0.5) / 2));
                        return t * t * (3 - 2 * t);
                    }),
                    1e-6, "smoothstep");
        nodes::Mix mix{net.any(place()), {AnyValue(1, 2, 3)}, {0.3f}};
        expect_near(net.at(net.add(mix), point), p * 0.3 + Vec3d(1, 2, 3) * 0.7, 1e-6, "mix");
        nodes::Invert invert{net.any(place()), {AnyValue(1.f)}};
        expect_near(net.at(net.add(invert), point), Vec3d(1) - p, 1e-6, "invert");
        nodes::Contrast contrast{net.any(place()), {AnyValue(2.f)}, {AnyValue(0.25f)}};
        expect_near(net.at(net.add(contrast), point),
                    each([](double x) { return (x - 0.25) * 2 + 0.25; }), 1e-6, "contrast");
        nodes::Range range;
        range.in = net.any(place()), range.gamma.value = AnyValue(2.f), range.doclamp = true;
        range.outhigh.value = AnyValue(3.f);
        expect_near(net.at(net.add(range), point),
                    each([](double x) { return std::min(3., x < 0 ? 0. : 3 * std::sqrt(x)); }),
                    2e-6, "range");
    }
}

TEST(NodeValues, Vectors) {
    Rng rng(4);
    for (int i = 0; i < 100; ++i) {
        auto const point = random_point(rng);
        Vec3d const p(point.p), b(0.5, -1, 2);
        Network net;
        Input<Vec3> const in = net.input<Vec3>(place());
        Input<Vec3> const literal{Vec3(b)};
        expect_near(net.at(net.add(nodes::DotProduct{in, literal}), point),
                    Vec3d(p.x * 0.5 - p.y + p.z * 2), 1e-6, "dotproduct");
        expect_near(net.at(net.add(nodes::CrossProduct{in, literal}), point),
                    {p.y * 2 + p.z, p.z * 0.5 - p.x * 2, -p.x - p.y * 0.5}, 1e-6, "crossproduct");
        double const l = std::sqrt(p.x * p.x + p.y * p.y + p.z * p.z);
        expect_near(net.at(net.add(nodes::Normalize{in}), point), p / l, 1e-6, "normalize");
        expect_near(net.at(net.add(nodes::Magnitude{in}), point), Vec3d(l), 1e-6, "magnitude");
        for (int k = 0; k < 3; ++k)
            expect_near(net.at(net.add(nodes::Extract{net.any(place()), k}), point), Vec3d(p[k]), 0,
                        "extract");
        nodes::Extract const y{net.any(place()), 1};
        nodes::Combine3 combine{{7}, net.input<float>(y), {9}, nodes::Triple::vector3};
        expect_near(net.at(net.add(combine), point), {7, p.y, 9}, 0, "combine3");
        nodes::Combine2 const pair{net.input<float>(y), {3}};
        nodes::Convert const longer{net.any(pair), nodes::AnyType::vector3};
        expect_near(net.at(net.add(longer), point), {p.y, 3, 0}, 0, "vector2 to vector3");
        nodes::Convert const colour{net.any(place()), nodes::AnyType::color3};
        nodes::Convert const mean{net.any(colour), nodes::AnyType::number};
        expect_near(net.at(net.add(mean), point), Vec3d((p.x + p.y + p.z) / 3), 1e-6, "mean");
    }
}

/// Hue in turns, by the hexagon's corners.
Vec3d hue_to_rgb(double h) {
    auto ramp = [&](double peak) {
        double const d = std::abs(h - peak), turn = std::min(d, 1 - d);
        return std::min(1., std::max(0., 2 - 6 * turn));
    };
    return {ramp(0), ramp(1 / 3.), ramp(2 / 3.)};
}

TEST(NodeValues, Colours) {
    Rng rng(5);
    for (int i = 0; i < 200; ++i) {
        double const h = rng.next(), s = rng.next(), v = 2 * rng.next();
        Vec3d const rgb = (Vec3d(1 - s) + hue_to_rgb(h) * s) * v;
        Color const c{float(rgb.x), float(rgb.y), float(rgb.z)};
        Network net;
        double const turned = h + 0.3 - std::floor(h + 0.3);
        expect_near(net.at(net.add(nodes::HsvAdjust{{c}, {Vec3(0.3f, 0.5f, 2)}}), {}),
                    (Vec3d(1 - 0.5 * s) + hue_to_rgb(turned) * (0.5 * s)) * (2 * v), 1e-5,
                    "hsvadjust");
        double const y = 0.2126 * rgb.x + 0.7152 * rgb.y + 0.0722 * rgb.z;
        expect_near(net.at(net.add(nodes::Luminance{{c}}), {}), Vec3d(y), 1e-6, "luminance");
        expect_near(net.at(net.add(nodes::Saturate{{c}, {1.5f}}), {}),
                    Vec3d(y) + (rgb - Vec3d(y)) * 1.5, 1e-6, "saturate");
        nodes::ColorCorrect correct;
        correct.in.value = c, correct.gamma.value = 2, correct.lift.value = 0.1f;
        correct.gain.value = 1.5f, correct.contrast.value = 0.5f, correct.exposure.value = 1;
        auto channel = [](double x) {
            x = (std::sqrt(x) * 0.9 + 0.1) * 1.5;
            return 2 * (0.5 + (x - 0.5) * 0.5);
        };
        expect_near(net.at(net.add(correct), {}), {channel(rgb.x), channel(rgb.y), channel(rgb.z)},
                    1e-3, "colorcorrect");
    }
}

TEST(NodeValues, Ramps) {
    Network net;
    nodes::ColorRamp ramp;
    ramp.stops.stops = {{0.2f, Color(1, 0, 0)}, {0.6f, Color(0, 1, 0)}, {1, Color(0, 0, 1)}};
    auto at = [&](float x, nodes::RampInterpolation how) {
        ramp.in.value = x, ramp.interpolation = how;
        return net.at(net.add(ramp), {});
    };
    using nodes::RampInterpolation;
    EXPECT_EQ(at(-1, RampInterpolation::linear), Vec3(1, 0, 0));
    EXPECT_EQ(at(2, RampInterpolation::smooth), Vec3(0, 0, 1));
    EXPECT_EQ(at(0.5f, RampInterpolation::constant), Vec3(1, 0, 0));
    expect_near(at(0.3f, RampInterpolation::linear), {0.75, 0.25, 0}, 1e-6, "linear");
    double const t = 0.25 * 0.25 * (3 - 0.5);
    expect_near(at(0.3f, RampInterpolation::smooth), {1 - t, t, 0}, 1e-6, "smooth");
    shading::SurfacePoint point;
    point.uv = {0.25f, 0.75f};
    expect_near(net.at(net.add(nodes::RampLr{}), point), Vec3d(0.25), 1e-6, "ramplr");
    expect_near(net.at(net.add(nodes::RampTb{}), point), Vec3d(0.25), 1e-6, "ramptb");
    nodes::Place2d place2d;
    place2d.pivot.value = {0.5f, 0.5f}, place2d.scale.value = {2, 4}, place2d.rotate.value = 90;
    place2d.offset.value = {0.1f, 0.2f};
    // (-0.25, 0.25) / (2, 4) = (-0.125, 0.0625), turned to (0.0625, 0.125).
    expect_near(net.at(net.add(place2d), point), {0.4625, 0.425, 0}, 1e-6, "place2d");
}

TEST(NodeValues, Surface) {
    Rng rng(6);
    ObjectSpace const space(Affined({0, 2, 0}, {-1, 0, 0}, {0.5, 0, 3}, {1, 2, 3}));
    auto const& [to_world, to_object] = space;
    for (int i = 0; i < 50; ++i) {
        auto point = random_point(rng);
        point.space = space;
        Network net;
        Vec3 const p = net.at(net.add(nodes::Position{}), point);
        expect_near(to_world.point(p), Vec3d(point.p), 1e-5, "position");
        Vec3 const n = net.at(net.add(nodes::Normal{}), point);
        expect_near(normalize(to_object.transposed(n)), Vec3d(point.ns), 1e-5, "normal");
        Vec3 const t = net.at(net.add(nodes::Tangent{nodes::Space::world}), point);
        EXPECT_NEAR(dot(t, point.ns), 0, 1e-5);
        EXPECT_GT(dot(t, point.dpdu), 0);
        Vec3 const uv = net.at(net.add(nodes::Texcoord{}), point);
        EXPECT_EQ(Vec2(uv.x, uv.y), point.uv);
        double const cosine = dot(Vec3d(point.wo), Vec3d(point.ns));
        expect_near(net.at(net.add(nodes::FacingRatio{}), point), Vec3d(std::abs(cosine)), 1e-6,
                    "facingratio");
        expect_near(net.at(net.add(nodes::FacingRatio{{}, false, true}), point), Vec3d(1 - cosine),
                    1e-6, "facingratio");
        Vec3 const r = net.at(net.add(nodes::InstanceRandom{}), point);
        EXPECT_TRUE(r.x >= 0 && r.x < 1);
        auto other = point;
        ++other.object;
        EXPECT_NE(r, net.at(net.add(nodes::InstanceRandom{}), other));
        EXPECT_NE(r, net.at(net.add(nodes::InstanceRandom{1}), point));
    }
}

TEST(NodeValues, BlackbodyFeedsColours) {
    Network net;
    nodes::Blackbody const node{net.input<float>(nodes::Extract{net.any(place()), 0})};
    shading::SurfacePoint point;
    point.p.x = 3000;
    Color const c = blackbody_color(3000);
    EXPECT_EQ(net.at(net.add(node), point), Vec3(c.r, c.g, c.b));
}

} // namespace
