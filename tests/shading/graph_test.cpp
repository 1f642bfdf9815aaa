// The compiler: folding, sharing, conversions, limits; and the nodes that run parts of their own.
#include "shading/materials.h"

#include "tests/shading/networks.h"
#include "tests/support/textures.h"

using namespace weft;
using namespace weft::testing;

namespace {

/// Feeds all inputs with constant nodes, half of them by a node that depends on others.
struct FeedConstants {
    Network& net;
    Rng& rng;

    Color color() {
        Vec3 const v = rng.next3();
        return {v.x, v.y, v.z};
    }
    template <class T>
    void operator()(std::string_view, Input<T>& in, schema::Attr const& attr) {
        auto const wanted = schema::input_type<T>;
        if (wanted == scene::ValueType::vector2) {
            in = net.input<T>(nodes::Combine2{{rng.next()}, {rng.next()}});
        } else if (wanted == scene::ValueType::vector3) {
            nodes::Combine3 triple{{rng.next()}, {rng.next()}, {rng.next()}};
            triple.output = nodes::Triple::vector3;
            in = net.input<T>(triple);
        } else {
            float const scale = std::isfinite(attr.min) && attr.min > 1 ? 4000.f : 1.f;
            nodes::Multiply product{net.any(scene::ConstantTexture{color()}), {AnyValue(scale)}};
            in = net.input<T>(product);
        }
    }
    template <class T>
    void operator()(std::string_view, T&, schema::Attr const&) {}
};

TEST(Graph, FoldedEqualsUnfolded) {
    Rng rng(1);
    for_each_type<scene::Texture>([&]<class Node>() {
        if constexpr (!std::is_same_v<Node, scene::ImageTexture> &&
                      !std::is_same_v<Node, nodes::GeomPropValue>) {
            for (int i = 0; i < 20; ++i) {
                Network net;
                Node node{};
                FeedConstants feed{net, rng};
                node.describe(feed);
                auto const id = net.add(node);
                auto const point = random_point(rng);
                auto const folded = net.compile(id), unfolded = net.compile(id, false);
                EXPECT_EQ(folded.result.type, unfolded.result.type);
                EXPECT_LE(folded.instructions.size(), unfolded.instructions.size());
                Vec3 a = shading::evaluate(folded, point), b = shading::evaluate(unfolded, point);
                if (folded.result.type == scene::ValueType::vector2) a.z = b.z = 0;
                expect_near(a, Vec3d(b), 1e-6, std::string(Node::info.type));
            }
        }
    });
}

TEST(Graph, ConstantsTakeNoInstruction) {
    Network net;
    auto id = net.add(nodes::Multiply{net.any(scene::ConstantTexture{Color(0.5f, 1, 2)}),
                                      net.any(nodes::Blackbody{{4000}})});
    auto const program = net.compile(id);
    EXPECT_TRUE(program.instructions.empty());
    EXPECT_EQ(program.result.type, scene::ValueType::color);
    EXPECT_EQ(program.needs, shading::Needs::nothing);
}

TEST(Graph, ASharedNodeRunsOnce) {
    Network net;
    scene::RoughConductor metal;
    metal.reflectance.texture = metal.roughness.texture = net.add(scene::Checkerboard{});
    shading::GraphCompiler compiler(net.scene);
    auto const program = compiler.compile(metal, {});
    EXPECT_EQ(program.instructions.size(), 2u) << "the checkerboard and its mean";
    // A chain of sums of the one before with itself: 2^40 nodes as a tree.
    auto id = net.add(nodes::Noise3d{});
    for (int i = 0; i < 40; ++i) {
        nodes::Add sum;
        sum.in1.texture = sum.in2.texture = id;
        id = net.add(sum);
    }
    EXPECT_EQ(net.compile(id).instructions.size(), 41u);
}

TEST(Graph, InputsOfMaterialsReadRegisters) {
    Network net;
    scene::Principled plastic;
    plastic.base_color = net.input<Color>(nodes::Convert{net.any(place())});
    plastic.roughness = net.input<float>(nodes::Extract{net.any(place()), 1});
    plastic.metallic = net.input<float>(nodes::Convert{net.any(place())});
    shading::GraphCompiler compiler(net.scene);
    auto const program = compiler.compile(plastic, {});
    shading::SurfacePoint point;
    point.p = {0.25f, 0.5f, 1};
    shading::Values values;
    shading::evaluate(program, point, values);
    EXPECT_EQ(values(plastic.base_color), Color(0.25f, 0.5f, 1));
    EXPECT_EQ(values(plastic.roughness), 0.5f);
    EXPECT_EQ(values(plastic.metallic), average(Color(0.25f, 0.5f, 1)));
    EXPECT_EQ(values(plastic.specular), 0.5f);
}

TEST(Graph, CalculatedValuesStayInTheParametersRange) {
    Network net;
    scene::Principled plastic;
    plastic.base_color = net.input<Color>(nodes::Convert{net.any(place())});
    plastic.roughness.texture =
        net.add(nodes::Add{net.any(scene::ConstantTexture{Color(1)}), {AnyValue(1.f)}});
    shading::GraphCompiler compiler(net.scene);
    auto const program = compiler.compile(plastic, {});
    EXPECT_EQ(plastic.roughness, Input<float>{1}) << "folded and limited";
    shading::SurfacePoint point;
    point.p = {-1, 0.5f, 3};
    shading::Values values;
    shading::evaluate(program, point, values);
    EXPECT_EQ(values(plastic.base_color), Color(0, 0.5f, 1));
}

TEST(Graph, ImagesFeedNumbersWithTheirMean) {
    Network net;
    net.scene.images.push_back(texture_of(1, 1, 3, {0.1f, 0.2f, 0.7f}));
    scene::ImageTexture node;
    node.filename.resource = 0;
    scene::Dielectric glass;
    glass.ior = net.input<float>(node);
    shading::GraphCompiler compiler(net.scene);
    auto const program = compiler.compile(glass, {});
    shading::Values values;
    shading::evaluate(program, {}, values);
    EXPECT_EQ(values(glass.ior), average(Color(0.1f, 0.2f, 0.7f)));
    EXPECT_EQ(program.needs, shading::Needs::uv);
}

TEST(Graph, UdimTilesLieSideBySide) {
    Network net;
    for (float value : {0.25f, 0.75f}) net.scene.images.push_back(texture_of(1, 1, 1, {value}));
    net.scene.udims = {{{1001, 0}, {1012, 1}}};
    scene::ImageTexture node;
    node.filename = {"skin.<UDIM>.png", 0};
    auto const program = net.compile(net.add(node));
    auto at = [&](float u, float v) {
        shading::SurfacePoint point;
        point.uv = {u, v};
        return shading::evaluate(program, point).x;
    };
    EXPECT_EQ(at(0.5f, 0.999f), 0.25f);
    EXPECT_EQ(at(1.5f, 1.001f), 0.75f);
    EXPECT_EQ(at(1.5f, 0.5f), 0) << "no such tile";
    EXPECT_EQ(at(-0.5f, 0.5f), 0);
    EXPECT_EQ(at(10.5f, 0.5f), 0);
}

TEST(Graph, TooLargeIsALocatedError) {
    Network net;
    auto id = net.add(nodes::Noise3d{});
    for (int i = 0; i < shading::kMaxRegisters; ++i) {
        nodes::Sin wave;
        wave.in.texture = id;
        id = net.add(wave);
    }
    SourceLocation const where{"big.xml", 3, 4};
    try {
        shading::GraphCompiler(net.scene).compile(id, where);
        ADD_FAILURE() << "no error";
    } catch (InputError const& e) {
        EXPECT_EQ(std::string(e.what()),
                  "big.xml:3:4: expected at most 128 nodes in the network below, found more");
    }
    // Bumps of bumps multiply.
    auto height = net.add(nodes::Noise3d{});
    for (int i = 0; i < 8; ++i) {
        nodes::Bump bump;
        bump.height.texture = height;
        height = net.add(nodes::Extract{net.any(bump), 0});
    }
    EXPECT_THROW(shading::GraphCompiler(net.scene).compile(height, where), InputError);
}

/// height = a sin(k x) on the plane z = 0, by position or by u = x / 2.
Vec3 bumped(float x, float a, float k, bool by_uv, bool has_uv, float step = 0) {
    Network net;
    nodes::Extract const coordinate{by_uv ? net.any(nodes::Texcoord{}) : net.any(place()), 0};
    nodes::Sin const wave{
        net.any(nodes::Multiply{net.any(coordinate), {AnyValue(by_uv ? 2 * k : k)}})};
    shading::SurfacePoint point;
    point.p = {x, 0.3f, 0};
    if (has_uv) {
        point.uv = {x / 2, 0.1f};
        point.dpdu = {2, 0, 0}, point.dpdv = {0.5f, 1, 0};
        point.uv.x -= 0.1f * 0.25f; // p = 2 u + 0.5 v
    }
    return net.at(net.add(nodes::Bump{net.input<float>(wave), {a}, {}, {step}}), point);
}

TEST(Bump, IsTheNormalOfASineField) {
    constexpr float a = 0.05f, k = 7;
    for (int i = 0; i < 100; ++i) {
        float const x = 0.02f * float(i);
        Vec3d const expected = normalize(Vec3d(-a * k * std::cos(double(k) * x), 0, 1));
        expect_near(bumped(x, a, k, false, true), expected, 5e-4, "by position, with uvs");
        expect_near(bumped(x, a, k, false, false), expected, 5e-4, "by position, without uvs");
    }
}

TEST(Bump, SeesDetailFinerThanTheUvSquareByAStep) {
    constexpr float a = 2e-4f, k = 2 * kPi / 1e-3f; // waves of the length that is chosen otherwise
    for (int i = 0; i < 100; ++i) {
        float const x = 1e-5f * float(i);
        Vec3d const expected = normalize(Vec3d(-a * k * std::cos(double(k) * x), 0, 1));
        expect_near(bumped(x, a, k, false, true, 1e-5f), expected, 2e-3, "with a step");
        expect_near(bumped(x, a, k, false, false, 1e-5f), expected, 2e-3, "without uvs");
    }
}

TEST(Bump, FollowsUvsOnSkewedTangents) {
    constexpr float a = 0.05f, k = 7;
    for (int i = 0; i < 100; ++i) {
        // u = (x - 0.5 y) / 2 on the plane: dh/dx = a k cos(2 k u), dh/dy = -half of that.
        float const x = 0.02f * float(i), u = x / 2 - 0.025f;
        double const slope = a * k * std::cos(2. * k * u);
        expect_near(bumped(x, a, k, true, true), normalize(Vec3d(-slope, 0.5 * slope, 1)), 5e-4,
                    "by uv");
    }
}

TEST(Bump, WorksWithNoise) {
    Rng rng(2);
    for (int i = 0; i < 50; ++i) {
        auto point = random_point(rng);
        Network net;
        nodes::Noise3d noise;
        noise.amplitude.value = 0.2f;
        auto const height = net.add(noise);
        nodes::Bump bump;
        bump.height.texture = height;
        Vec3 const n = net.at(net.add(bump), point);
        // The gradient by differences of another step.
        Vec3d gradient;
        for (int axis = 0; axis < 3; ++axis) {
            auto moved = [&](float d) {
                auto at = point;
                at.p[axis] += d;
                return double(net.at(height, at).x);
            };
            gradient[axis] = (moved(4e-3f) - moved(-4e-3f)) / 8e-3;
        }
        Vec3d const normal(point.ns);
        Vec3d const along = gradient - normal * dot(gradient, normal);
        expect_near(n, normalize(normal - along), 3e-3, "bump of noise");
    }
}

TEST(NormalMap, MirroredUvsMirrorTheBitangent) {
    auto mapped = [](Vec3 const& dpdu, Vec3 const& dpdv, AnyValue const& in, float scale,
                     nodes::Handedness handedness) {
        shading::SurfacePoint point;
        point.dpdu = dpdu, point.dpdv = dpdv;
        Network net;
        return net.at(net.add(nodes::NormalMap{{in}, {scale}, handedness, {}}), point);
    };
    using nodes::Handedness;
    AnyValue const u(0.8f, 0.5f, 0.9f), v(0.5f, 0.8f, 0.9f);
    Vec3d const lean_x = normalize(Vec3d(0.6, 0, 0.8)), lean_y = normalize(Vec3d(0, 0.6, 0.8));
    Vec3 const x(1, 0, 0), y(0, 1, 0);
    // Red leans to growing u, green to growing v, whichever way these run.
    expect_near(mapped(x, y, u, 1, Handedness::opengl), lean_x, 1e-6, "red");
    expect_near(mapped(x, y, v, 1, Handedness::opengl), lean_y, 1e-6, "green");
    expect_near(mapped(-x, y, u, 1, Handedness::opengl), lean_x * Vec3d(-1, 1, 1), 1e-6,
                "red, u mirrored");
    expect_near(mapped(-x, y, v, 1, Handedness::opengl), lean_y, 1e-6, "green, u mirrored");
    expect_near(mapped(x, -y, v, 1, Handedness::opengl), lean_y * Vec3d(1, -1, 1), 1e-6,
                "green, v mirrored");
    expect_near(mapped(x, y, v, 1, Handedness::directx), lean_y * Vec3d(1, -1, 1), 1e-6,
                "green down");
    expect_near(mapped(x, y, u, 0, Handedness::opengl), {0, 0, 1}, 1e-6, "no strength");
    expect_near(mapped(x, y, u, 0.5f, Handedness::opengl), normalize(Vec3d(0.3, 0, 0.8)), 1e-6,
                "half strength");
}

TEST(Triplanar, BlendsThreeProjections) {
    Network net;
    nodes::Extract const u{net.any(nodes::Texcoord{}), 0};
    nodes::Triplanar const node{net.any(u), {2}, {1}, nodes::Space::world};
    auto const id = net.add(node);
    shading::SurfacePoint point;
    point.p = {0.1f, 0.2f, 0.3f};
    point.ns = {0, 0, 1};
    EXPECT_FLOAT_EQ(net.at(id, point).x, 0.2f) << "from above: u is x";
    point.ns = {1, 0, 0};
    EXPECT_FLOAT_EQ(net.at(id, point).x, 0.4f) << "from the side: u is y";
    point.ns = normalize(Vec3(3, 0, 1));
    EXPECT_NEAR(net.at(id, point).x, 0.75f * 0.4f + 0.25f * 0.2f, 1e-6);
}

} // namespace
