// Scenes made by hand meet the rules that files meet.
#include "scene/check.h"

#include <gtest/gtest.h>

#include <functional>
#include <limits>

#include "base/match.h"
#include "scene/scene_vectors.h"

namespace weft::scene {
namespace {

/// A lit sphere: everything in it has the index 0.
Scene valid_scene() {
    Scene s;
    s.contents.camera = add(s, CameraKind{}, Perspective{});
    Instance ball;
    ball.shape = add(s, ShapeKind{}, Sphere{});
    ball.traits.bsdf = add(s, MaterialKind{}, Diffuse{});
    s.contents.instances = {add(s, InstanceKind{}, ball)};
    s.contents.lights = {add(s, LightKind{}, PointLight{})};
    return s;
}

/// What `check` says of the scene; "" where it is valid.
std::string message(Scene const& scene) {
    try {
        check(scene);
        return "";
    } catch (InputError const& e) {
        return e.what();
    }
}

/// Appends `object` to a valid scene.
template <class Kind, class T>
Scene scene_with(Kind kind, T object) {
    Scene s = valid_scene();
    add(s, kind, std::move(object));
    return s;
}
Scene with_light(Light light) { return scene_with(LightKind{}, std::move(light)); }
Scene with_material(Material material) { return scene_with(MaterialKind{}, std::move(material)); }
Scene with_node(Texture node) { return scene_with(schema::TextureKind{}, std::move(node)); }
Scene changed(std::function<void(Scene&)> const& change) {
    Scene s = valid_scene();
    change(s);
    return s;
}

TEST(Check, ValidScenesPass) {
    EXPECT_EQ(message(valid_scene()), "");
    EXPECT_EQ(message(with_material(Mix{.bsdfs = {{0}, {0}}})), "");
    EXPECT_EQ(message(with_light(AreaLight{.instance = {0}})),
              "light 1: <light type=\"area\"> expects an instance with an <emission>, found one "
              "without");
}

TEST(Check, RulesOfMaterials) {
    EXPECT_EQ(message(with_material(Mix{.bsdfs = {{0}}})),
              "bsdf 1: <bsdf type=\"mix\"> expects two child tags <bsdf>, found 1");
    EXPECT_EQ(message(with_material(Secondary{})),
              "bsdf 1: <bsdf type=\"secondary\"> expects two child tags <bsdf>, found 0");
    EXPECT_EQ(message(with_material(Layered{})),
              "bsdf 1: <bsdf type=\"layered\"> expects a child tag <layer>, found none");
    EXPECT_EQ(message(with_material(Coat{})),
              "bsdf 1: <bsdf type=\"coat\"> expects a <bsdf>, found none: What lies below.");
    Scene s = with_material(VolumeBoundary{});
    add(s, LayerKind{}, Layer{.bsdf = {1}});
    EXPECT_EQ(message(s), "layer 0: <layer> expects a surface to be made of, found <bsdf "
                          "type=\"volume\">");
    EXPECT_EQ(message(scene_with(LayerKind{}, Layer{.bsdf = {0}, .label = "a b"})),
              "layer 0: 'label' of <layer> expects letters, digits, _ and -, found 'a b'");
}

TEST(Check, RulesOfLights) {
    EXPECT_EQ(message(with_light(DirectionalLight{.direction = Vec3(0, 0, 0)})),
              "light 1: 'direction' of <light type=\"directional\"> expects a direction, found a "
              "vector of length 0");
    EXPECT_EQ(message(with_light(PointLight{.intensity = {Color(2)}})),
              "light 1: <light type=\"point\"> expects 'power' or 'intensity', found both");
    EXPECT_EQ(
        message(with_light(SkyLight{.date = "today"})),
        "light 1: 'date' of <light type=\"sky\"> expects a day, as 2026-06-21, found 'today'");
    SpotLight spot;
    spot.angle = spot.falloff = 0;
    spot.intensity = {Color(0)};
    spot.power = {Color(1)};
    EXPECT_EQ(
        message(with_light(spot)),
        "light 1: 'power' of <light type=\"spot\"> expects an angle and falloff of more than 0 "
        "together, found 0");
    PointLight named;
    named.controls.group = "key/1";
    EXPECT_EQ(message(with_light(named)),
              "light 1: 'group' of <light type=\"point\"> expects letters, "
              "digits, _ and -, found 'key/1'");
    Portal sheared;
    sheared.transform.y = {1, 1, 0};
    EXPECT_EQ(message(scene_with(PortalKind{}, sheared)),
              "portal 0: <portal> expects a transform that leaves it a rectangle, found one that "
              "shears it");
}

TEST(Check, ParametersAreInRange) {
    float const nan = std::numeric_limits<float>::quiet_NaN(),
                infinity = std::numeric_limits<float>::infinity();
    EXPECT_EQ(message(with_material(Diffuse{.albedo = {Color(0.5f, 1.5f, 0)}})),
              "bsdf 1: 'albedo' of <bsdf type=\"diffuse\"> expects a value of at least 0 and at "
              "most 1, found '0.5,1.5,0'");
    EXPECT_EQ(message(with_material(Diffuse{.roughness = {nan}})),
              "bsdf 1: 'roughness' of <bsdf type=\"diffuse\"> expects a value of at least 0 and "
              "at most 1, found 'nan'");
    EXPECT_EQ(
        message(with_light(PointLight{.position = Vec3(0, infinity, 0)})),
        "light 1: 'position' of <light type=\"point\"> expects a finite value, found '0,inf,0'");
    EXPECT_EQ(
        message(with_light(PointLight{.power = {Color(infinity)}})),
        "light 1: 'power' of <light type=\"point\"> expects a value of at least 0, found 'inf'");
    EXPECT_EQ(message(with_material(RoughConductor{.distribution = Microfacets(7)})),
              "bsdf 1: 'distribution' of <bsdf type=\"roughconductor\"> expects one of 2 choices, "
              "found number 7");
    EXPECT_EQ(message(changed([](Scene& s) { s.instances[0].transform.z = Vec3d(0); })),
              "instance 0: expected a transform that can be inverted, found one of determinant 0");
    nodes::ColorRamp ramp;
    ramp.stops.stops = {{1, Color(0)}, {0, Color(1)}};
    EXPECT_EQ(message(with_node(ramp))
                  .rfind("texture 0: 'stops' of <texture type=\"colorramp\"> "
                         "expects 'position: color;",
                         0),
              0u);
}

TEST(Check, DefaultsAreInRange) {
    for_each_vector(kObjectVectors, [&]<class Kind, class T>(ObjectVector<Kind, T> const&) {
        auto const expect_fine = [](auto object) {
            std::string const found = message(scene_with(Kind{}, object));
            EXPECT_EQ(found.find("expects a value of"), std::string::npos) << found;
            EXPECT_EQ(found.find("finite"), std::string::npos) << found;
        };
        if constexpr (requires { T::info; })
            expect_fine(T{});
        else
            for_each_type<T>([&]<class Object>() { expect_fine(Object{}); });
    });
}

TEST(Check, IndicesLeadSomewhere) {
    EXPECT_EQ(message({}), "scene: <scene> expects a <camera>, found none: The point of view.");
    EXPECT_EQ(message(changed([](Scene& s) { s.instances[0].traits.bsdf = {3}; })),
              "instance 0: 'bsdf' of <instance> expects one of the scene's 1 objects <bsdf>, found "
              "index 3");
    EXPECT_EQ(
        message(changed([](Scene& s) { s.instances[0].traits.medium = {-2}; })),
        "instance 0: 'medium' of <instance> expects one of the scene's 0 objects <medium>, found "
        "index -2");
    EXPECT_EQ(message(changed([](Scene& s) { s.instances[0].shape = {}; })),
              "instance 0: <instance> expects a <shape>, found none: What is put there.");
    EXPECT_EQ(
        message(changed([](Scene& s) { s.contents.lights.push_back({}); })),
        "scene: 'light' of <scene> expects one of the scene's 1 objects <light>, found index -1");
    EXPECT_EQ(message(with_material(Diffuse{.albedo = {Color(0), {2}}})),
              "bsdf 1: 'albedo' of <bsdf type=\"diffuse\"> expects one of the scene's 0 objects "
              "<texture>, found index 2");
}

TEST(Check, FilesAreThere) {
    EXPECT_EQ(
        message(scene_with(ShapeKind{}, MeshShape{.filename = {"bunny.ply"}})),
        "shape 1: 'filename' of <shape type=\"mesh\"> expects one of the scene's 0 files of its "
        "sort, found index -1");
    EXPECT_EQ(
        message(with_node(ImageTexture{})),
        "texture 0: <texture type=\"image\"> expects 'filename' (file), found none: PNG, JPEG, "
        "EXR, HDR, TIFF, ...; relative to the scene file. <UDIM> in the name stands for the "
        "numbers of tiles, 1001 + u + 10 v.");
    EXPECT_EQ(
        message(with_node(ImageTexture{.filename = {"<UDIM>.exr", 0}})),
        "texture 0: 'filename' of <texture type=\"image\"> expects one of the scene's 0 files of "
        "its sort, found index 0");
    EXPECT_EQ(
        message(with_light(IesLight{.filename = {"lamp.ies", 4}})),
        "light 1: 'filename' of <light type=\"ies\"> expects one of the scene's 0 files of its "
        "sort, found index 4");
    EXPECT_EQ(message(changed([](Scene& s) { s.meshes.emplace_back(); })),
              "mesh 0: expected a loaded file, found none");
    EXPECT_EQ(message(changed([](Scene& s) {
                  s.udims = {{{1001, 5}}};
              })),
              "set of images 0: expected one of the scene's 0 images, found index 5");
    Mesh mesh;
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    mesh.triangles = {{{0, 1, 3}}};
    EXPECT_EQ(message(changed([&](Scene& s) { s.meshes = {std::make_shared<Mesh const>(mesh)}; })),
              "mesh 0: triangle 0 uses vertex 3, but the mesh has 3 vertices, counted from 0");
    for (Photometry const& lamp :
         {Photometry{{0}, {0}, {1}}, Photometry{{0, 90}, {0, 90}, {1, 1, 1, 1}},
          Photometry{{90, 0}, {0}, {1, 1}}, Photometry{{0, 90}, {0}, {1}},
          Photometry{{0, 90}, {0}, {1, -1}}, Photometry{{0, 90}, {}, {}}})
        EXPECT_NE(message(changed([&](Scene& s) {
                      s.photometries = {std::make_shared<Photometry const>(lamp)};
                  })),
                  "");
}

TEST(Check, TypesOfNodesFit) {
    Scene s = with_node(nodes::Normal{});
    EXPECT_EQ(message(s), "");
    std::get<Diffuse>(s.materials[0]).albedo.texture = {0};
    EXPECT_EQ(message(s), "bsdf 0: 'albedo' of <bsdf type=\"diffuse\"> expects a color, found a "
                          "vector3; `convert` and `extract` make one of the other");
    Scene clash = with_node(nodes::Normal{});
    add(clash, schema::TextureKind{}, nodes::Texcoord{});
    add(clash, schema::TextureKind{}, nodes::Add{{{}, {0}}, {{}, {1}}});
    EXPECT_EQ(
        message(clash),
        "texture 2: 'in2' of <texture type=\"add\"> expects a vector3 as the inputs before it, "
        "found a vector2; `convert` and `extract` make one of the other");
    Scene normal = with_node(nodes::Texcoord{});
    normal.instances[0].traits.normal = {0};
    EXPECT_EQ(message(normal),
              "instance 0: 'normal' of <instance> expects a color or a vector3, found a vector2");
}

TEST(Check, NothingContainsItself) {
    Scene node = with_node(nodes::Absval{{{}, {0}}});
    EXPECT_EQ(message(node), "texture 0: <texture type=\"absval\"> contains itself");
    EXPECT_EQ(message(with_material(Mix{.bsdfs = {{0}, {1}}})),
              "bsdf 1: <bsdf type=\"mix\"> contains itself");
    Group of_itself;
    of_itself.instances.push_back({0});
    Scene group = scene_with(ShapeKind{}, of_itself);
    group.instances[0].shape = {1};
    EXPECT_NE(message(group).find("contains itself"), std::string::npos);

    // A chain of nodes in an order that needs the longest way down.
    auto const chain = [](int length) {
        Scene s = with_node(nodes::Absval{});
        for (int i = 1; i < length; ++i)
            add(s, schema::TextureKind{}, nodes::Absval{{{}, {i - 1}}});
        std::reverse(s.textures.begin(), s.textures.end());
        for (int i = 0; i + 1 < length; ++i)
            std::get<nodes::Absval>(s.textures[size_t(i)]).in.texture = {i + 1};
        return s;
    };
    EXPECT_EQ(message(chain(kMaxDepth - 1)), "");
    EXPECT_NE(message(chain(kMaxDepth + 2)).find("expected objects nested at most 1000 deep"),
              std::string::npos);
}

TEST(Check, GroupsMayNotMultiplyBeyondMemory) {
    Scene s = valid_scene();
    InstanceId inner{0};
    for (int level = 0; level < 9; ++level) {
        Group ten;
        ten.instances.assign(10, inner);
        Instance outer;
        outer.shape = add(s, ShapeKind{}, ten);
        inner = add(s, InstanceKind{}, outer);
    }
    s.contents.instances = {inner};
    EXPECT_EQ(message(s),
              "scene: <scene> expects at most 1e+08 objects, found 1e+09 by its groups");
}

TEST(Check, MessagesHaveAPlaceWhereThereIsOne) {
    Scene s = valid_scene();
    add(s, MaterialKind{}, Mix{}, {"shot.xml", 3, 7}, "gold");
    EXPECT_EQ(message(s),
              "shot.xml:3:7: <bsdf type=\"mix\"> expects two child tags <bsdf>, found 0");
    s.material_locations.clear();
    EXPECT_EQ(message(s),
              "bsdf 1 'gold': <bsdf type=\"mix\"> expects two child tags <bsdf>, found 0");
}

} // namespace
} // namespace weft::scene
