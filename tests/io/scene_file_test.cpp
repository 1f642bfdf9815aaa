// What a scene file means: spellings, references, includes, transforms, overrides, jobs.
#include "base/match.h"
#include "io/scene_file.h"
#include "io/xml_document.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <unistd.h>

using namespace weft;
namespace fs = std::filesystem;

namespace {

std::string const kCamera = "<camera type='perspective' width='4' height='4'/>";

io::SceneFile parse(std::string const& text, std::vector<std::string> const& overrides = {}) {
    return io::parse_scene(text, "s.xml", "", overrides);
}

/// The scene of a file that is `inner` beside a camera.
std::shared_ptr<scene::Scene const> parse_inner(std::string const& inner,
                                                std::vector<std::string> const& overrides = {}) {
    return parse("<scene>" + kCamera + inner + "</scene>", overrides).jobs.front().scene;
}

template <class T>
T first_light(std::string const& text) {
    return std::get<T>(parse_inner(text)->lights.at(0));
}

template <class T>
T material(std::string const& text) {
    auto const scene = parse_inner("<instance><shape type='sphere'/>" + text + "</instance>");
    return std::get<T>(scene->materials.at(0));
}

Affined transform(std::string const& inner) {
    return parse_inner("<instance><shape type='sphere'/><transform>" + inner +
                       "</transform></instance>")
        ->instances.at(0)
        .transform;
}

void expect_near(Vec3d const& a, Vec3d const& b) {
    EXPECT_LT(length(a - b), 1e-12)
        << a.x << ' ' << a.y << ' ' << a.z << " instead of " << b.x << ' ' << b.y << ' ' << b.z;
}

std::string error_of(std::string const& text) {
    try {
        parse(text);
    } catch (InputError const& e) {
        return e.what();
    }
    return "no error";
}

/// A scratch folder, removed in the end.
struct Scratch {
    fs::path path;
    Scratch() {
        std::string name = (fs::temp_directory_path() / "weft_io_XXXXXX").string();
        path = ::mkdtemp(name.data());
    }
    ~Scratch() { fs::remove_all(path); }
    void write(fs::path const& name, std::string const& text) const {
        fs::create_directories((path / name).parent_path());
        std::ofstream(path / name) << text;
    }
};

TEST(SceneFile, AttributesAndChildTagsAreEqual) {
    auto const a = first_light<scene::PointLight>(
        "<light type='point' position='1,2,3' power='4' weight='0.5'/>");
    auto const b = first_light<scene::PointLight>(
        "<light type='point'><vector name='position' value='1, 2 3'/><color name='power' "
        "value='4,4,4'/><float name='weight' value='5e-1'/></light>");
    EXPECT_EQ(a.position, Vec3(1, 2, 3));
    EXPECT_EQ(a.power.value, Color(4));
    EXPECT_EQ(a.controls.weight, 0.5f);
    EXPECT_EQ(a.position, b.position);
    EXPECT_EQ(a.power, b.power);
    EXPECT_EQ(a.controls.weight, b.controls.weight);
}

TEST(SceneFile, ConstantTexturesAreTheirValue) {
    auto const glass = material<scene::Dielectric>(
        "<bsdf type='dielectric'><texture name='ior' type='constant' value='1.33'/>"
        "<texture name='transmittance' type='constant' value='0.1,0.2,0.3'/></bsdf>");
    EXPECT_EQ(glass.ior.value, 1.33f);
    EXPECT_FALSE(glass.ior.texture);
    EXPECT_EQ(glass.transmittance.value, Color(0.1f, 0.2f, 0.3f));
    EXPECT_FALSE(glass.transmittance.texture);
    auto const fog = material<scene::VolumeBoundary>(
        "<bsdf type='volume'><texture name='scatter' type='constant' value='2'/></bsdf>");
    EXPECT_EQ(fog.scatter, Color(2));
    auto const tiles = material<scene::Diffuse>(
        "<bsdf type='diffuse'><texture name='albedo' type='checkerboard' scale='3'/></bsdf>");
    EXPECT_TRUE(tiles.albedo.texture);
}

TEST(SceneFile, EnvironmentTakesANamelessTexture) {
    auto const sky = first_light<scene::EnvironmentLight>(
        "<light type='envmap'><texture type='checkerboard'/></light>");
    EXPECT_TRUE(sky.texture.texture);
}

TEST(SceneFile, ReferencesShareObjects) {
    auto const scene = parse("<bsdf id='m' type='diffuse' albedo='0.25'/><scene>" + kCamera +
                             "<shape id='s' type='sphere'/>"
                             "<instance><ref id='s'/><ref id='m'/></instance>"
                             "<instance><ref name='shape' id='s'/><ref name='bsdf' id='m'/>"
                             "</instance><ref id='s'/></scene>")
                           .jobs.front()
                           .scene;
    EXPECT_EQ(scene->materials.size(), 1u);
    EXPECT_EQ(scene->shapes.size(), 1u);
    ASSERT_EQ(scene->contents.instances.size(), 3u);
    EXPECT_EQ(scene->instances[0].traits.bsdf, scene->instances[1].traits.bsdf);
    EXPECT_FALSE(scene->instances[2].traits.bsdf) << "a reference to a shape is a bare shape";
}

TEST(SceneFile, BareShapesAreInstances) {
    auto const scene = parse_inner("<shape type='sphere'/><shape id='d' type='rectangle'/>"
                                   "<shape type='group'><shape type='sphere'/>"
                                   "<shape id='e' type='rectangle'/></shape>");
    EXPECT_EQ(scene->contents.instances.size(), 2u) << "a shape with an id is a definition";
    auto const& group = std::get<scene::Group>(scene->shapes[size_t(
        scene->instances[size_t(scene->contents.instances[1].index)].shape.index)]);
    EXPECT_EQ(group.instances.size(), 2u) << "but a group's members are members";
}

TEST(SceneFile, InstancesRememberWhereTheyStand) {
    auto const scene = parse_inner("\r\n\t<instance id='ball'>\r\n<shape type='sphere'/></instance>"
                                   "\n  <light type='point'/>");
    EXPECT_EQ(to_string(scene->instance_locations.at(0)), "s.xml:2:2");
    EXPECT_EQ(scene->instance_names.at(0).str(), "ball");
    EXPECT_EQ(to_string(scene->light_locations.at(0)), "s.xml:4:3");
}

TEST(SceneFile, LocationsOfAttributes) {
    // The name stands in a value and in another name before.
    EXPECT_EQ(error_of("<scene>" + kCamera +
                       "\r\n\t<light name=\"light\"\r\n\t\ttype='point' "
                       "weight = \"1\" powe=\"weight powe='1'\" power='1'/></scene>"),
              "s.xml:3:29: unknown parameter 'powe' of <light type=\"point\"> (did you mean "
              "'power'?)");
    EXPECT_EQ(error_of("\xef\xbb\xbf<scene id='a' width='4'>" + kCamera + "</scene>"),
              "s.xml:1:15: unknown parameter 'width' of <scene>; known: camera, light, instance, "
              "medium, type, id, name");
}

TEST(SceneFile, LongTextsAreCutInMessages) {
    std::string const message = error_of("<scene><camera type='perspective' fov='" +
                                         std::string(100000, 'x') + "'/></scene>");
    EXPECT_LT(message.size(), 400u);
    EXPECT_NE(message.find("xxx...'"), std::string::npos);
}

TEST(SceneFile, LongTextsOfNoCharactersAreCutInMessages) {
    // Bytes that only go on with a character, and none that begins one.
    EXPECT_EQ(in_quotes(std::string(300, char(0x98))).size(), 196 + 5);
}

TEST(SceneFile, MessagesAreOneLine) {
    EXPECT_EQ(error_of("<bsdf id='m' type='a&#10;b'/><scene>" + kCamera +
                       "<instance><ref name='shape' id='m'/></instance></scene>"),
              "s.xml:1:96: expected a <shape>, found <bsdf type=\"a b\">");
}

TEST(SceneFile, TransformsApplyInOrder) {
    // Scaled, then moved: the point (1, 0, 0) goes to 2 + 5; the other way round to 2 (1 + 5).
    expect_near(transform("<scale value='2'/><translate x='5'/>").point({1, 0, 0}), {7, 0, 0});
    expect_near(transform("<translate value='5,0,0'/><scale x='2' y='2' z='2'/>").point({1, 0, 0}),
                {12, 0, 0});
    expect_near(transform("<rotate axis='0,0,2' angle='90'/>").point({1, 0, 0}), {0, 1, 0});
    expect_near(transform("<scale x='-1'/>").point({1, 2, 3}), {-1, 2, 3});
}

TEST(SceneFile, MatricesAreRowMajor) {
    char const* const text = "1,2,0,7, 0,1,0,8, 0,3,1,9, 0,0,0,1";
    Affined const m = transform("<matrix value='" + std::string(text) + "'/>");
    expect_near(m.point({0, 0, 0}), {7, 8, 9});
    expect_near(m.vector({0, 1, 0}), {2, 1, 3});
    auto const scene = parse_inner("<instance transform='" + std::string(text) +
                                   "'><shape type='sphere'/></instance>");
    EXPECT_EQ(scene->instances[0].transform, m) << "the attribute's form";
    expect_near(transform("<matrix value='2,0,0,2, 0,2,0,4, 0,0,2,6, 0,0,0,2'/>").point({1, 1, 1}),
                {2, 3, 4});
}

TEST(SceneFile, LookatMapsUpToDown) {
    // +z to the target; +y, the picture's downward axis, to the half plane of `up`.
    Affined const m = transform("<lookat origin='1,2,3' target='1,2,8' up='0,3,4'/>");
    expect_near(m.point({0, 0, 0}), {1, 2, 3});
    expect_near(m.vector({0, 0, 1}), {0, 0, 1});
    expect_near(m.vector({0, 1, 0}), {0, 1, 0});
    expect_near(m.vector({1, 0, 0}), {1, 0, 0});
    EXPECT_NEAR(m.determinant(), 1, 1e-12);
    Affined const side = transform("<lookat origin='0,0,0' target='9,0,0' up='0,1,0'/>");
    expect_near(side.vector({0, 0, 1}), {1, 0, 0});
    expect_near(side.vector({1, 0, 0}), {0, 0, -1});
}

TEST(SceneFile, TransformsMayBeShared) {
    auto const scene = parse("<transform id='t'><translate x='3'/></transform><scene>" + kCamera +
                             "<instance><shape type='sphere'/><ref id='t'/></instance></scene>")
                           .jobs.front()
                           .scene;
    expect_near(scene->instances[0].transform.origin, {3, 0, 0});
}

TEST(SceneFile, OverridesSetParameters) {
    std::string const inner =
        "<light id='lamp' type='point'><color name='power' value='1'/></light>"
        "<light type='point'/>"
        "<instance id='ball'><shape type='sphere'/>"
        "<bsdf type='diffuse'><texture name='albedo' type='checkerboard'/>"
        "</bsdf></instance>";
    auto power = [](scene::Scene const& s, size_t i) {
        return std::get<scene::PointLight>(s.lights[i]).power.value;
    };
    auto const one =
        parse_inner(inner, {"lamp.power=7", "camera.fov=30.5", "ball.bsdf.albedo=0.5"});
    EXPECT_EQ(power(*one, 0), Color(7));
    EXPECT_EQ(power(*one, 1), Color(1));
    EXPECT_EQ(std::get<scene::Perspective>(one->cameras[0]).fov, 30.5f);
    auto const& albedo = std::get<scene::Diffuse>(one->materials[0]).albedo;
    EXPECT_EQ(albedo.value, Color(0.5f));
    EXPECT_FALSE(albedo.texture);
    auto const all = parse_inner(inner, {"light.power=7", "lamp.power=1,2,3"});
    EXPECT_EQ(power(*all, 0), Color(1, 2, 3));
    EXPECT_EQ(power(*all, 1), Color(7)) << "a tag means every object of that tag";
    EXPECT_TRUE(std::holds_alternative<scene::Orthographic>(
        parse("<scene><camera type='orthographic'/></scene>", {"scene.camera.scale=2"})
            .jobs[0]
            .scene->cameras[0]));
}

TEST(SceneFile, IntegratorsShareAScene) {
    io::SceneFile const file = parse(
        "<integrator type='path' depth='3'><ref id='room'/><sampler type='halton' count='8'/>"
        "<image id='a'/></integrator>"
        "<scene id='room'>" +
        kCamera +
        "</scene>"
        "<integrator type='aov' variable='uv'><ref id='room'/><image id='b'/></integrator>"
        "<postprocess type='denoising'><ref name='input' id='a'/><image id='c'/></postprocess>"
        "<integrator type='albedo'><ref id='room'/><image id='d'/></integrator>"
        "<postprocess type='denoising'><ref name='input' id='c'/><ref name='albedo' id='d'/>"
        "<image id='e'/></postprocess>");
    ASSERT_EQ(file.jobs.size(), 3u);
    EXPECT_EQ(file.jobs[0].scene, file.jobs[1].scene);
    EXPECT_EQ(std::get<scene::PathIntegrator>(file.jobs[0].integrator).depth, 3);
    EXPECT_EQ(std::get<scene::AovIntegrator>(file.jobs[1].integrator).variable,
              scene::AovVariable::uv);
    EXPECT_EQ(match(file.jobs[0].sampler, [](auto const& s) { return s.count; }), 8);
    EXPECT_EQ(match(file.jobs[1].sampler, [](auto const& s) { return s.count; }), 64);
    EXPECT_EQ(file.jobs[0].image_name, "a");
    EXPECT_EQ(file.jobs[1].image_name, "b");
    EXPECT_TRUE(file.warnings.empty());

    ASSERT_EQ(file.postprocesses.size(), 2u);
    EXPECT_EQ(file.postprocesses[0].jobs_before, 2u);
    EXPECT_EQ(file.postprocesses[1].jobs_before, 3u);
    auto const pictures = scene::pictures_of(file.postprocesses[1].postprocess);
    auto name = [&](scene::ImageId id) { return file.pictures.at(size_t(id.index)).name; };
    ASSERT_EQ(pictures.inputs.size(), 2u);
    EXPECT_EQ(pictures.inputs[0].first, "input");
    EXPECT_EQ(name(pictures.inputs[0].second), "c");
    EXPECT_EQ(pictures.inputs[1].first, "albedo");
    EXPECT_EQ(name(pictures.inputs[1].second), "d");
    EXPECT_EQ(pictures.inputs[1].second, file.jobs[2].target.image);
    EXPECT_EQ(name(pictures.output), "e");
}

TEST(SceneFile, TwoIntegratorsOfOnePictureAreToldApart) {
    std::string const path =
        "<integrator type='path'><scene>" + kCamera + "</scene><image id='a'/></integrator>\n";
    EXPECT_EQ(parse(path + path).warnings,
              std::vector<std::string>{"s.xml:2:1: writes the same picture 'a.exr' as the "
                                       "integrator at s.xml:1:1"});
    EXPECT_EQ(parse(path + "<postprocess type='denoising'><ref name='input' id='a'/><ref id='a'/>"
                           "</postprocess>")
                  .warnings,
              std::vector<std::string>{"s.xml:2:1: writes the same picture 'a.exr' as the "
                                       "integrator at s.xml:1:1"});
}

TEST(SceneFile, TestsHoldAnIntegrator) {
    io::SceneFile const file =
        parse("<test type='image' id='x' mae='0.5'><float name='me' value='0.25'/>"
              "<bsdf id='unused' type='diffuse'/><integrator type='direct'><scene>" +
              kCamera + "</scene><image id='y'/></integrator></test>");
    ASSERT_EQ(file.jobs.size(), 1u);
    ASSERT_TRUE(file.jobs[0].test);
    EXPECT_EQ(file.jobs[0].test->mae, 0.5f);
    EXPECT_EQ(file.jobs[0].test->me, 0.25f);
    EXPECT_EQ(file.jobs[0].image_name, "x");
}

TEST(SceneFile, ALoneSceneIsRenderedByPath) {
    io::SceneFile const file = parse("<scene id='room' type='default'>" + kCamera + "</scene>");
    ASSERT_EQ(file.jobs.size(), 1u);
    EXPECT_TRUE(std::holds_alternative<scene::PathIntegrator>(file.jobs[0].integrator));
    EXPECT_EQ(file.jobs[0].image_name, "room");
    EXPECT_FALSE(file.jobs[0].test);
}

TEST(SceneFile, IncludesNestAndKeepTheirFolders) {
    Scratch const scratch;
    scratch.write("main.xml", "<include filename='parts/materials.xml'/>\n<scene>" + kCamera +
                                  "<include filename='./parts/../parts/ball.xml'/></scene>");
    scratch.write("parts/materials.xml", "<include filename='more/red.xml'/>");
    scratch.write("parts/more/red.xml", "<bsdf id='red' type='diffuse' albedo='1,0,0'/>");
    scratch.write(
        "parts/ball.xml",
        "<instance><shape type='mesh' filename='meshes/t.ply'/><ref id='red'/></instance>\n"
        "<instance><shape type='mesh' filename='../parts/meshes/t.ply'/></instance>");
    scratch.write("parts/meshes/t.ply",
                  "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
                  "property float z\nelement face 1\nproperty list uchar int vertex_indices\n"
                  "end_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n");
    io::SceneFile const file = io::read_scene_file((scratch.path / "main.xml").string());
    scene::Scene const& scene = *file.jobs.at(0).scene;
    EXPECT_EQ(std::get<scene::Diffuse>(scene.materials.at(0)).albedo.value, Color(1, 0, 0));
    ASSERT_EQ(scene.meshes.size(), 1u) << "one file is read once, however its path is written";
    EXPECT_EQ(scene.meshes[0]->triangles.size(), 1u);
    EXPECT_EQ(to_string(scene.instance_locations.at(1)),
              (scratch.path / "parts/ball.xml").string() + ":2:1");
    EXPECT_EQ(file.jobs[0].folder, scratch.path.string());
}

TEST(SceneFile, MaterialsOfTheLibraryAreIncludedFromAnywhere) {
    Scratch const scratch;
    scratch.write("main.xml",
                  "<include filename='materials/gold.xml'/><scene>" + kCamera +
                      "<instance><shape type='sphere'/><ref id='gold'/></instance></scene>");
    std::string const path = (scratch.path / "main.xml").string();
    io::SceneFile file = io::read_scene_file(path);
    ASSERT_EQ(file.jobs.at(0).scene->materials.size(), 1u);
    EXPECT_TRUE(std::holds_alternative<scene::Disney>(file.jobs[0].scene->materials[0]));

    // What lies beside the scene goes first, and any other name is a file that is missing.
    scratch.write("materials/gold.xml", "<bsdf id='gold' type='diffuse' albedo='1,0,0'/>");
    file = io::read_scene_file(path);
    EXPECT_TRUE(std::holds_alternative<scene::Diffuse>(file.jobs.at(0).scene->materials.at(0)));
    for (char const* name :
         {"materials/gold", "materials/gol.xml", "gold.xml", "./materials/chrome.xml"}) {
        scratch.write("other.xml", std::string("<include filename='") + name + "'/>");
        EXPECT_THROW(io::read_scene_file((scratch.path / "other.xml").string()), InputError)
            << name;
    }
}

TEST(SceneFile, IncludesMayNotMultiplyWithoutBound) {
    Scratch const scratch;
    for (int i = 0; i < 30; ++i) {
        std::string const next = "<include filename='" + std::to_string(i + 1) + ".xml'/>";
        scratch.write(std::to_string(i) + ".xml", next + next);
    }
    scratch.write("30.xml", "");
    try {
        io::read_scene_file((scratch.path / "0.xml").string());
        ADD_FAILURE() << "no error";
    } catch (InputError const& e) {
        EXPECT_NE(std::string(e.what()).find("expected at most 10000 includes"), std::string::npos)
            << e.what();
    }
}

TEST(SceneFile, ShippedScenesAreRead) {
    int scenes = 0;
    for (auto const& entry : fs::directory_iterator(fs::path(WEFT_SOURCE_DIR) / "scenes")) {
        if (entry.path().extension() != ".xml") continue;
        ++scenes;
        SCOPED_TRACE(entry.path());
        try {
            EXPECT_EQ(io::read_scene_file(entry.path().string()).warnings,
                      std::vector<std::string>());
        } catch (InputError const& e) {
            ADD_FAILURE() << e.what();
        }
    }
    EXPECT_GT(scenes, 0);
}

TEST(SceneFile, AConstantTextureIsExact) {
    // The mean of three equal numbers need not be the number.
    for (int i = 1; i < 1000; ++i) {
        float const v = float(i) / 1000;
        std::string const text = schema::number_text(v);
        EXPECT_EQ(material<scene::Principled>("<bsdf type='principled'><texture name='metallic' "
                                              "type='constant' value='" +
                                              text + "'/></bsdf>")
                      .metallic.value,
                  v);
    }
}

} // namespace
