// What glTF files mean, by files small enough to read.
#include "io/gltf.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

#include "scene/check.h"

using namespace weft;

namespace {

/// Base64 of the bytes of plain values.
template <class T>
std::string data_uri(std::vector<T> const& values) {
    constexpr char kDigits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string bytes(values.size() * sizeof(T), '\0'), text;
    std::memcpy(bytes.data(), values.data(), bytes.size());
    bytes.resize((bytes.size() + 2) / 3 * 3);
    for (size_t i = 0; i < bytes.size(); i += 3) {
        uint32_t bits = 0;
        for (size_t k = 0; k < 3; ++k) bits = bits << 8 | static_cast<unsigned char>(bytes[i + k]);
        for (int shift = 18; shift >= 0; shift -= 6) text += kDigits[bits >> shift & 63];
    }
    return "\"data:application/octet-stream;base64," + text + "\"";
}

/// One unit square in z = 0 with normals +z and uvs whose v runs downwards, as glTF has it;
/// `rest` is further JSON at the root and may name the mesh 0; `extra` goes into its primitive.
std::string square(std::string const& rest, std::string const& extra = "") {
    std::vector<float> const numbers{0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, // positions
                                     0, 0, 2, 0, 0, 2, 0, 0, 2, 0, 0, 2, // normals, of any length
                                     0, 1, 1, 1, 1, 0, 0, 0};            // uvs
    return R"({"asset":{"version":"2.0"},"meshes":[{"primitives":[{"attributes":{"POSITION":0,
        "NORMAL":1,"TEXCOORD_0":2},"indices":3)" +
           extra + R"(}]}],"accessors":[
        {"bufferView":0,"componentType":5126,"count":4,"type":"VEC3"},
        {"bufferView":0,"byteOffset":48,"componentType":5126,"count":4,"type":"VEC3"},
        {"bufferView":0,"byteOffset":96,"componentType":5126,"count":4,"type":"VEC2"},
        {"bufferView":1,"componentType":5121,"count":6,"type":"SCALAR"}],
        "bufferViews":[{"buffer":0,"byteLength":128},{"buffer":1,"byteLength":6}],
        "buffers":[{"byteLength":128,"uri":)" +
           data_uri(numbers) + R"(},{"byteLength":6,"uri":)" +
           data_uri(std::vector<uint8_t>{0, 1, 2, 0, 2, 3}) + "}]" + rest + "}";
}

struct Loaded {
    scene::Scene scene;
    image::TextureCache textures;
    io::GltfContents contents;
    explicit Loaded(std::string const& json) {
        contents = io::read_gltf(json, "test.gltf", "/nonexistent/folder", scene, textures);
    }
    scene::Mesh const& mesh(size_t i) const { return *scene.meshes[i]; }
    scene::Instance const& instance(size_t i) const {
        return scene.instances[size_t(contents.instances[i].index)];
    }
    scene::Disney const& disney() const {
        return std::get<scene::Disney>(scene.materials[size_t(instance(0).traits.bsdf.index)]);
    }
};

void expect_near(Vec3d const& a, Vec3d const& b) {
    EXPECT_NEAR(a.x, b.x, 1e-6);
    EXPECT_NEAR(a.y, b.y, 1e-6);
    EXPECT_NEAR(a.z, b.z, 1e-6);
}

TEST(Gltf, MeshHasUnitNormalsAndUpwardV) {
    Loaded const l(square(R"(,"nodes":[{"mesh":0}])"));
    ASSERT_EQ(l.scene.meshes.size(), 1u);
    scene::Mesh const& m = l.mesh(0);
    ASSERT_EQ(m.positions.size(), 4u);
    EXPECT_EQ(m.triangles.size(), 2u);
    EXPECT_EQ(m.normals[0], Vec3(0, 0, 1));
    EXPECT_EQ(m.uvs[0], Vec2(0, 0));
    EXPECT_EQ(m.uvs[2], Vec2(1, 1));
    EXPECT_TRUE(l.contents.warnings.empty());
}

TEST(Gltf, StripsAndFans) {
    Loaded const strip(square(R"(,"nodes":[{"mesh":0}])", R"(,"mode":5)"));
    // The indices 0 1 2 0 2 3 as a strip: 012, 1.02 turned, (202 and 023 ...) without repeats.
    EXPECT_EQ(strip.mesh(0).triangles[0], (scene::Mesh::Triangle{{0, 1, 2}}));
    EXPECT_EQ(strip.mesh(0).triangles[1], (scene::Mesh::Triangle{{1, 0, 2}}));
    Loaded const fan(square(R"(,"nodes":[{"mesh":0}])", R"(,"mode":6)"));
    EXPECT_EQ(fan.mesh(0).triangles[0], (scene::Mesh::Triangle{{0, 1, 2}}));
    EXPECT_EQ(fan.mesh(0).triangles.back(), (scene::Mesh::Triangle{{0, 2, 3}}));
    Loaded const points(square(R"(,"nodes":[{"mesh":0}])", R"(,"mode":0)"));
    EXPECT_TRUE(points.contents.instances.empty());
    ASSERT_EQ(points.contents.warnings.size(), 1u);
    EXPECT_EQ(points.contents.warnings[0],
              "test.gltf: meshes[0].primitives[0].mode: points and lines are left out");
}

TEST(Gltf, SparseAndNormalisedAccessors) {
    std::vector<int16_t> const quantised{32767, 0, 0, 0, -32768, 0, 0, 0, 16384, 0, 0, 0};
    std::vector<uint8_t> const sparse{2, 0, 0, 0, 0, 0, 128, 63, 0, 0, 0, 0, 0, 0, 0, 0};
    std::string const head = R"({"asset":{"version":"2.0"},"nodes":[{"mesh":0}],"meshes":[
        {"primitives":[{"attributes":{"POSITION":0}}]}],"accessors":[)";
    Loaded const l(head + R"({"bufferView":0,"componentType":5122,"normalized":true,"count":3,
        "type":"VEC3"}],"bufferViews":[{"buffer":0,"byteLength":24,"byteStride":8}],
        "buffers":[{"byteLength":24,"uri":)" +
                   data_uri(quantised) + "}]}");
    EXPECT_EQ(l.mesh(0).positions[0], Vec3(1, 0, 0));
    EXPECT_EQ(l.mesh(0).positions[1], Vec3(-1, 0, 0));
    EXPECT_TRUE(l.mesh(0).normals.empty()); // none in the file: facets show
    Loaded const s(head + R"({"componentType":5126,"count":3,"type":"VEC3","sparse":{"count":1,
        "indices":{"bufferView":0,"componentType":5121},"values":{"bufferView":0,"byteOffset":4}}}],
        "bufferViews":[{"buffer":0,"byteLength":16}],"buffers":[{"byteLength":16,"uri":)" +
                   data_uri(sparse) + "}]}");
    EXPECT_EQ(s.mesh(0).positions[0], Vec3(0, 0, 0));
    EXPECT_EQ(s.mesh(0).positions[2], Vec3(1, 0, 0));
}

TEST(Gltf, NodesComposeAndShareMeshes) {
    Loaded const l(square(R"(,"nodes":[
        {"translation":[10,0,0],"rotation":[0,0,0.70710678118,0.70710678118],"children":[1,2]},
        {"mesh":0,"scale":[2,3,4]},
        {"mesh":0,"matrix":[1,0,0,0, 0,1,0,0, 0,0,1,0, 5,6,7,1]}])"));
    ASSERT_EQ(l.contents.instances.size(), 2u);
    EXPECT_EQ(l.scene.meshes.size(), 1u);
    EXPECT_EQ(l.instance(0).shape.index, l.instance(1).shape.index);
    // A quarter turn about z takes x to y.
    expect_near(l.instance(0).transform.point({1, 0, 0}), {10, 2, 0});
    expect_near(l.instance(0).transform.point({0, 1, 0}), {7, 0, 0});
    expect_near(l.instance(1).transform.point({0, 0, 0}), {4, 5, 7});
    EXPECT_EQ(to_string(l.scene.instance_locations[1]), "test.gltf: nodes[2]");
}

TEST(Gltf, ScenesMeetTheRulesOfAllScenes) {
    Loaded l(square(R"(,"nodes":[{"mesh":0,"name":"card"}])"));
    l.scene.contents.camera = {0};
    l.scene.cameras.emplace_back();
    l.scene.contents.instances = l.contents.instances;
    EXPECT_NO_THROW(scene::check(l.scene));
    l.scene.instances[0].traits.group = "a b";
    try {
        scene::check(l.scene);
        ADD_FAILURE() << "no error";
    } catch (InputError const& e) {
        EXPECT_STREQ(e.what(),
                     "test.gltf: nodes[0]: 'group' of <instance> expects letters, digits, "
                     "_ and -, found 'a b'");
    }
}

TEST(Gltf, NodesOfNoExtentAreToldAndLeftOut) {
    Loaded const l(square(R"(,"nodes":[{"mesh":0,"scale":[0,0,0]},{"mesh":0}])"));
    EXPECT_EQ(l.contents.instances.size(), 1u);
    EXPECT_EQ(l.contents.warnings.size(), 1u);
}

TEST(Gltf, GpuInstancing) {
    Loaded const l(square(R"(,"nodes":[{"mesh":0,"translation":[0,0,9],"extensions":{
        "EXT_mesh_gpu_instancing":{"attributes":{"TRANSLATION":0}}}}])"));
    ASSERT_EQ(l.contents.instances.size(), 4u);
    expect_near(l.instance(2).transform.origin, {1, 1, 9});
}

TEST(Gltf, Cameras) {
    Loaded const l(square(R"(,"nodes":[{"camera":0,"translation":[1,2,3],"scale":[2,2,2]},
        {"camera":1}],"cameras":[
        {"type":"perspective","perspective":{"yfov":1.0471975512,"aspectRatio":2,"znear":0.1}},
        {"type":"orthographic","orthographic":{"xmag":3,"ymag":1.5,"znear":0,"zfar":9}}])"));
    ASSERT_EQ(l.contents.cameras.size(), 2u);
    auto const& p = std::get<scene::Perspective>(l.scene.cameras[0]);
    EXPECT_NEAR(p.fov, 60, 1e-4);
    EXPECT_EQ(p.fov_axis, scene::FovAxis::y);
    EXPECT_EQ(p.view.width, 2 * p.view.height);
    // It looks along -z, image x is +x, and image y (downwards) is -y.
    expect_near(p.view.transform.z, {0, 0, -1});
    expect_near(p.view.transform.x, {1, 0, 0});
    expect_near(p.view.transform.y, {0, -1, 0});
    expect_near(p.view.transform.origin, {1, 2, 3});
    auto const& o = std::get<scene::Orthographic>(l.scene.cameras[1]);
    EXPECT_FLOAT_EQ(o.scale, 1.5f);
    EXPECT_EQ(o.view.width, 2 * o.view.height);
}

TEST(Gltf, LampsArePhotometric) {
    Loaded const l(square(R"(,"nodes":[
        {"translation":[1,2,3],"extensions":{"KHR_lights_punctual":{"light":0}}},
        {"extensions":{"KHR_lights_punctual":{"light":1}}},
        {"rotation":[0.70710678118,0,0,0.70710678118],
         "extensions":{"KHR_lights_punctual":{"light":2}}}],
        "extensionsUsed":["KHR_lights_punctual"],"extensions":{"KHR_lights_punctual":{"lights":[
        {"type":"point","intensity":683,"color":[1,0.5,0]},
        {"type":"directional","intensity":1366},
        {"type":"spot","intensity":683,"spot":{"innerConeAngle":0.2,"outerConeAngle":0.3}}]}})"));
    ASSERT_EQ(l.contents.lights.size(), 3u);
    auto const& point = std::get<scene::PointLight>(l.scene.lights[0]);
    EXPECT_NEAR(point.power.value.r, 4 * kPi, 1e-5); // 683 cd are 1 W/sr
    EXPECT_NEAR(point.power.value.g, 2 * kPi, 1e-5);
    EXPECT_EQ(point.position, Vec3(1, 2, 3));
    auto const& sun = std::get<scene::DirectionalLight>(l.scene.lights[1]);
    EXPECT_NEAR(sun.intensity.value.r, 2, 1e-6);
    expect_near(Vec3d(sun.direction), {0, 0, 1}); // towards the lamp, which shines along -z
    auto const& spot = std::get<scene::SpotLight>(l.scene.lights[2]);
    EXPECT_NEAR(spot.angle, degrees(0.4f), 1e-4);
    EXPECT_NEAR(spot.falloff, degrees(0.2f), 1e-4);
    expect_near(Vec3d(spot.direction), {0, 1, 0}); // -z, turned a quarter about x
}

TEST(Gltf, DefaultMaterialIsMetalAndFactorsAreTaken) {
    Loaded const plain(square(R"(,"nodes":[{"mesh":0}])"));
    EXPECT_EQ(plain.disney().metallic.value, 1);
    EXPECT_EQ(plain.disney().roughness.value, 1);
    EXPECT_EQ(plain.disney().normal, scene::Input<Vec3>{Vec3(0)});
    Loaded const l(square(R"(,"nodes":[{"mesh":0}],"materials":[{
        "pbrMetallicRoughness":{"baseColorFactor":[0.1,0.2,0.3,0.25],"metallicFactor":0,
                                "roughnessFactor":0.4},
        "alphaMode":"BLEND","emissiveFactor":[1,0.5,0],"extensions":{
        "KHR_materials_emissive_strength":{"emissiveStrength":4},
        "KHR_materials_ior":{"ior":1.33},
        "KHR_materials_specular":{"specularFactor":0.5,"specularColorFactor":[1,0.5,0.5]},
        "KHR_materials_clearcoat":{"clearcoatFactor":0.7,"clearcoatRoughnessFactor":0.2},
        "KHR_materials_sheen":{"sheenColorFactor":[0.5,0.25,0],"sheenRoughnessFactor":0.3},
        "KHR_materials_iridescence":{"iridescenceFactor":1,"iridescenceIor":1.4,
                                     "iridescenceThicknessMaximum":350},
        "KHR_materials_transmission":{"transmissionFactor":0.9},
        "KHR_materials_volume":{"thicknessFactor":1,"attenuationDistance":2,
                                "attenuationColor":[1,0.5,0.25]}}}])",
                          R"(,"material":0)"));
    scene::Disney const& m = l.disney();
    EXPECT_EQ(m.base_color.value, Color(0.1f, 0.2f, 0.3f));
    EXPECT_FLOAT_EQ(m.roughness.value, 0.4f);
    EXPECT_FLOAT_EQ(m.opacity.value, 0.25f);
    EXPECT_FLOAT_EQ(m.ior.value, 1.33f);
    EXPECT_FLOAT_EQ(m.specular.value, 0.25f);
    EXPECT_EQ(m.specular_tint.value, Color(1, 0.5f, 0.5f));
    EXPECT_FLOAT_EQ(m.clearcoat.value, 0.7f);
    EXPECT_FLOAT_EQ(m.clearcoat_roughness.value, 0.2f);
    EXPECT_FLOAT_EQ(m.sheen.value, 0.5f);
    EXPECT_EQ(m.sheen_tint.value, Color(1, 0.5f, 0));
    EXPECT_FLOAT_EQ(m.thin_film_thickness.value, 350);
    EXPECT_FLOAT_EQ(m.thin_film_ior.value, 1.4f);
    EXPECT_FLOAT_EQ(m.transmission.value, 0.9f);
    ASSERT_TRUE(l.instance(0).traits.medium);
    Color const absorption = l.scene.media[size_t(l.instance(0).traits.medium.index)].absorption;
    EXPECT_NEAR(absorption.r, 0, 1e-6);
    EXPECT_NEAR(absorption.g, std::log(2.) / 2, 1e-6);
    EXPECT_NEAR(absorption.b, std::log(4.) / 2, 1e-6);
    ASSERT_EQ(l.contents.emissive.size(), 1u);
    EXPECT_EQ(m.emission_color.value, Color(1, 0.5f, 0));
    EXPECT_EQ(m.emission_strength.value, 4);
    EXPECT_EQ(l.contents.radiance, 4);
    EXPECT_TRUE(l.contents.warnings.empty());
}

TEST(Gltf, AnisotropyKeepsRatioAndProductOfWidths) {
    Loaded const l(square(R"(,"nodes":[{"mesh":0}],"materials":[{"pbrMetallicRoughness":{
        "roughnessFactor":0.5},"extensions":{"KHR_materials_anisotropy":{
        "anisotropyStrength":0.6,"anisotropyRotation":-1.5707963268}}}])",
                          R"(,"material":0)"));
    double const b = 0.25, t = b + (1 - b) * 0.36;
    double const alpha = std::pow(double(l.disney().roughness.value), 2),
                 aspect = std::sqrt(1 - 0.9 * double(l.disney().anisotropic.value));
    EXPECT_NEAR(alpha / aspect * (alpha * aspect), t * b, 1e-6);
    EXPECT_NEAR(aspect * aspect, b / t, 1e-6);
    EXPECT_NEAR(l.disney().anisotropic_rotation.value, 0.75, 1e-6);
}

/// A PNG of one pixel with red 1, green 0.5 (128), blue 0, alpha 0.25 (64).
constexpr char kPixel[] =
    "data:image/png;base64,iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAYAAAAfFcSJAAAADUlEQVR4nGP438DgAAAFwQ"
    "HAlgyCpgAAAABJRU5ErkJggg==";

std::string textured(std::string const& material) {
    return square(R"(,"nodes":[{"mesh":0}],"textures":[{"source":0,"sampler":0}],
        "samplers":[{"wrapS":33071,"wrapT":33071,"magFilter":9728}],"images":[{"uri":")" +
                      std::string(kPixel) + R"("}],"materials":[)" + material + "]",
                  R"(,"material":0)");
}

/// The node that feeds an input, which must be of that type.
template <class Node>
Node const& node(Loaded const& l, scene::TextureId id) {
    static Node const none{};
    if (!id) {
        ADD_FAILURE() << "no node";
        return none;
    }
    auto const* found = std::get_if<Node>(&l.scene.textures[size_t(id.index)]);
    EXPECT_TRUE(found) << "another node";
    return found ? *found : none;
}

/// The texel of an image of one.
image::Texel texel(Loaded const& l, scene::TextureId id) {
    auto const& image = node<scene::ImageTexture>(l, id);
    return l.scene.images.at(size_t(image.filename.resource))->texel(0, 0, 0);
}

TEST(Gltf, FactorsAndChannelsBecomeNodesOfOneImage) {
    Loaded const l(textured(R"({"pbrMetallicRoughness":{"baseColorTexture":{"index":0},
        "baseColorFactor":[0.5,1,1,1],"metallicRoughnessTexture":{"index":0},
        "roughnessFactor":0.5},"alphaMode":"MASK","alphaCutoff":0.3})"));
    scene::Disney const& m = l.disney();
    auto const& base = node<scene::nodes::Multiply>(l, m.base_color.texture);
    EXPECT_EQ(base.in2.value, scene::AnyValue(0.5f, 1, 1));
    image::Texel const color = texel(l, base.in1.texture);
    EXPECT_NEAR(color[0], 1, 1e-6f);
    EXPECT_NEAR(color[1], srgb_to_linear(128 / 255.f), 1e-6f);
    auto const& image = node<scene::ImageTexture>(l, base.in1.texture);
    EXPECT_EQ(image.border, scene::TextureBorder::clamp);
    EXPECT_EQ(image.filter, scene::TextureFilter::nearest);

    auto const& roughness = node<scene::nodes::Multiply>(l, m.roughness.texture);
    EXPECT_EQ(roughness.in2.value, scene::AnyValue(0.5f));
    auto const& green = node<scene::nodes::Extract>(l, roughness.in1.texture);
    EXPECT_EQ(green.index, 1);
    EXPECT_NEAR(texel(l, green.in.texture)[1], 128 / 255.f, 1e-6f);        // not decoded
    auto const& blue = node<scene::nodes::Extract>(l, m.metallic.texture); // its factor is 1
    EXPECT_EQ(blue.index, 2);
    EXPECT_EQ(blue.in.texture, green.in.texture);

    auto const& mask = node<scene::nodes::Smoothstep>(l, m.opacity.texture);
    EXPECT_EQ(mask.low.value, scene::AnyValue(0.3f));
    EXPECT_EQ(mask.high.value, mask.low.value);
    auto const& alpha = node<scene::nodes::Extract>(l, mask.in.texture);
    EXPECT_NEAR(texel(l, alpha.in.texture)[0], 64 / 255.f, 1e-6f);
    EXPECT_EQ(l.scene.images.size(), 3u); // as colours, as data, and the alpha
    EXPECT_TRUE(l.contents.warnings.empty());
}

TEST(Gltf, NormalMapsFeedTheirLayers) {
    std::string const coat = R"("extensions":{"KHR_materials_clearcoat":{"clearcoatFactor":1)";
    Loaded const one(textured(R"({"normalTexture":{"index":0,"scale":0.5},)" + coat + "}}}"));
    auto const& map = node<scene::nodes::NormalMap>(one, one.disney().normal.texture);
    EXPECT_EQ(map.scale.value, 0.5f);
    EXPECT_EQ(map.handedness, scene::nodes::Handedness::opengl);
    EXPECT_NEAR(texel(one, map.in.texture)[1], 128 / 255.f, 1e-6f);
    // The coat lies smoothly over the bumps.
    node<scene::nodes::Normal>(one, one.disney().clearcoat_normal.texture);
    Loaded const two(textured("{" + coat + R"(,"clearcoatNormalTexture":{"index":0}}}})"));
    EXPECT_FALSE(two.disney().normal.texture);
    node<scene::nodes::NormalMap>(two, two.disney().clearcoat_normal.texture);
}

/// glTF's uv after a transform, as the extension's matrices say (Translation * Rotation * Scale).
Vec2 transformed(Vec2 uv, Vec2 offset, float rotation, Vec2 scale) {
    float const c = std::cos(rotation), s = std::sin(rotation);
    Vec2 const p(uv.x * scale.x, uv.y * scale.y);
    return {c * p.x + s * p.y + offset.x, -s * p.x + c * p.y + offset.y};
}

TEST(Gltf, TextureTransformsBecomePlacements) {
    Loaded const l(textured(R"({"pbrMetallicRoughness":{"baseColorTexture":{"index":0,
        "extensions":{"KHR_texture_transform":{"offset":[0.25,0.5],"scale":[2,4],
        "rotation":0.3}}},"metallicRoughnessTexture":{"index":0}}})"));
    scene::Disney const& m = l.disney();
    auto const& base = node<scene::ImageTexture>(l, m.base_color.texture);
    auto const& place = node<scene::nodes::Place2d>(l, base.texcoord.texture);
    auto const& other = node<scene::nodes::Extract>(l, m.roughness.texture);
    EXPECT_FALSE(node<scene::ImageTexture>(l, other.in.texture).texcoord.texture);
    // As MaterialX defines place2d.
    auto placed = [&](Vec2 uv) {
        Vec2 p = uv - place.pivot.value;
        p = {p.x / place.scale.value.x, p.y / place.scale.value.y};
        float const angle = radians(place.rotate.value), c = std::cos(angle), s = std::sin(angle);
        return Vec2(c * p.x + s * p.y, c * p.y - s * p.x) - place.offset.value + place.pivot.value;
    };
    for (Vec2 const& uv : {Vec2(0, 0), Vec2(1, 0), Vec2(0, 1), Vec2(0.3f, 0.7f)}) {
        Vec2 const expected = transformed(uv, {0.25f, 0.5f}, 0.3f, {2, 4});
        Vec2 const found = placed({uv.x, 1 - uv.y});
        EXPECT_NEAR(found.x, expected.x, 1e-5f);
        EXPECT_NEAR(found.y, 1 - expected.y, 1e-5f);
    }
    EXPECT_TRUE(l.contents.warnings.empty());
}

TEST(Gltf, FurtherUvsAndColoursAreProperties) {
    // The positions' first two numbers as a second set of uvs, the normals as colours.
    std::string json = textured(R"({"pbrMetallicRoughness":{"baseColorTexture":{"index":0,
        "texCoord":1}},"normalTexture":{"index":0}})");
    std::string const attributes = R"("TEXCOORD_0":2)";
    json.replace(json.find(attributes), attributes.size(),
                 R"("TEXCOORD_0":2,"TEXCOORD_1":2,"COLOR_0":1)");
    Loaded const l(json);
    auto const& base = node<scene::nodes::Multiply>(l, l.disney().base_color.texture);
    auto const& image = node<scene::ImageTexture>(l, base.in1.texture);
    EXPECT_EQ(node<scene::nodes::GeomPropValue>(l, image.texcoord.texture).geomprop, "TEXCOORD_1");
    EXPECT_EQ(node<scene::nodes::GeomPropValue>(l, base.in2.texture).geomprop, "color");
    ASSERT_EQ(l.mesh(0).attributes.size(), 1u);
    EXPECT_EQ(l.mesh(0).attributes[0].values.size(), 8u);
    EXPECT_EQ(l.mesh(0).attributes[0].values[1], l.mesh(0).uvs[0].y);
    EXPECT_EQ(l.mesh(0).colors.size(), 4u);
    EXPECT_TRUE(l.contents.warnings.empty());
}

TEST(Gltf, MirroredRepetitionFoldsTheUvs) {
    std::string json = textured(R"({"pbrMetallicRoughness":{"baseColorTexture":{"index":0}}})");
    json.replace(json.find(R"("wrapT":33071)"), 13, R"("wrapT":33648)");
    Loaded const l(json);
    auto const& image = node<scene::ImageTexture>(l, l.disney().base_color.texture);
    EXPECT_EQ(image.border, scene::TextureBorder::clamp);
    auto const& uv = node<scene::nodes::Combine2>(l, image.texcoord.texture);
    EXPECT_EQ(node<scene::nodes::Extract>(l, uv.in1.texture).index, 0); // clamped by the border
    auto const& v = node<scene::nodes::Subtract>(l, uv.in2.texture);    // 1 - |v mod 2 - 1|
    auto const& centred =
        node<scene::nodes::Subtract>(l, node<scene::nodes::Absval>(l, v.in2.texture).in.texture);
    auto const& modulo = node<scene::nodes::Modulo>(l, centred.in1.texture);
    EXPECT_EQ(modulo.in2.value, scene::AnyValue(2.f));
    EXPECT_EQ(node<scene::nodes::Extract>(l, modulo.in1.texture).index, 1);
    EXPECT_TRUE(l.contents.warnings.empty());
}

TEST(Gltf, UnlitShinesWithItsBaseColour) {
    Loaded const l(square(R"(,"nodes":[{"mesh":0}],"materials":[{"pbrMetallicRoughness":{
        "baseColorFactor":[0.1,0.2,0.3,1]},"extensions":{"KHR_materials_unlit":{}}}])",
                          R"(,"material":0)"));
    EXPECT_EQ(l.disney().emission_color.value, Color(0.1f, 0.2f, 0.3f));
    EXPECT_EQ(l.disney().emission_strength.value, 1);
    EXPECT_EQ(l.disney().base_color.value, Color(0));
    EXPECT_TRUE(l.contents.emissive.empty());
    EXPECT_EQ(l.contents.unlit.size(), 1u);
}

TEST(Gltf, TellsWhatItLeavesOut) {
    Loaded const l(square(R"(,"nodes":[{"mesh":0,"skin":0}],"skins":[{}],"animations":[{}],
        "extensionsUsed":["VENDOR_magic"],"unknown":1,
        "materials":[{"occlusionTexture":{"index":0},"metalness":1}])",
                          R"(,"material":0,"targets":[{}])"));
    std::string all;
    for (std::string const& w : l.contents.warnings) all += w + "\n";
    for (char const* place : {"nodes[0].skin:", "animations:", "skins:", "extensionsUsed[0]:",
                              "unknown:", "materials[0].occlusionTexture:",
                              "materials[0].metalness:", "meshes[0].primitives[0].targets:"})
        EXPECT_NE(all.find(std::string("test.gltf: ") + place), std::string::npos) << place << "\n"
                                                                                   << all;
}

} // namespace
