#include "io/gltf_view.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "base/match.h"
#include "scene/scene_vectors.h"

namespace weft::io::gltf {

namespace {

constexpr int kHeight = 720; ///< of pictures whose size the file does not say

double degrees(double radians) { return radians * 180 / double(kPi); }

/// The frame of a camera that looks along `forward`, image x along `right` as far as possible.
Affined view(Vec3d const& forward, Vec3d const& right, Vec3d const& origin) {
    Vec3d const z = normalize(forward);
    Vec3d const x = normalize(right - z * dot(z, right));
    return {x, cross(z, x), z, origin};
}

int width_of(double aspect) { return int(std::clamp(std::round(kHeight * aspect), 1., 65536.)); }

/// The linear part at unit scale, or an InputError at `where`.
Affined pose(Affined const& to_world, SourceLocation const& where) {
    Affined const m = view(-to_world.z, to_world.x, to_world.origin);
    if (!(std::abs(m.determinant() - 1) < 1e-6))
        throw InputError(where, "expected a node that turns and moves its camera or lamp, found "
                                "one whose scale is 0");
    return m;
}

double required(Object& o, char const* key, Range range) {
    if (!o.has(key)) o.report().fail(o.path_of(key), "expected a number, found none");
    return o.number(key, 0, range);
}

} // namespace

scene::Camera read_camera(Object& camera, Affined const& to_world) {
    std::string const type = camera.text("type");
    auto lens = camera.object(type);
    if ((type != "perspective" && type != "orthographic") || !lens)
        camera.report().fail(camera.path_of("type"),
                             "expected perspective or orthographic, and an object of that name, "
                             "found " +
                                 in_quotes(type));
    scene::Viewpoint viewpoint{.height = kHeight,
                               .transform = pose(to_world, camera.report().at(camera.path()))};
    for (char const* key : {"znear", "zfar"}) lens->ignore(key);
    scene::Camera result;
    if (type == "perspective") {
        scene::Perspective c;
        c.fov_axis = scene::FovAxis::y;
        c.fov = float(std::clamp(degrees(required(*lens, "yfov", kNotNegative)), 0.001, 179.9));
        viewpoint.width = width_of(lens->number("aspectRatio", 16. / 9, kNotNegative));
        c.view = viewpoint;
        result = c;
    } else {
        scene::Orthographic c;
        double const x = std::abs(required(*lens, "xmag", {})),
                     y = std::abs(required(*lens, "ymag", {}));
        if (!(float(x) > 0 && float(y) > 0))
            lens->report().fail(lens->path(), "expected xmag and ymag other than 0, found 0");
        c.fov_axis = scene::FovAxis::y;
        c.scale = float(y);
        viewpoint.width = width_of(x / y);
        c.view = viewpoint;
        result = c;
    }
    lens->finish();
    camera.finish();
    return result;
}

scene::Light read_light(Object& light, Affined const& to_world) {
    Report& report = light.report();
    std::string const type = light.text("type");
    float const intensity =
        float(light.number("intensity", 1, kNotNegative) / double(scene::kLumensPerWatt));
    Color const color = light.color("color", Color(1), kNotNegative) * intensity;
    if (light.has("range")) {
        light.ignore("range");
        report.warn(light.path_of("range"), "is left out: light does not end");
    }
    Vec3 const position(to_world.origin);
    auto shines = [&] { return Vec3(pose(to_world, report.at(light.path())).z); };
    scene::Light result;
    if (type == "point") {
        result = scene::PointLight{.position = position, .power = {color * (4 * kPi)}};
    } else if (type == "directional") {
        result = scene::DirectionalLight{.direction = -shines(), .intensity = {color}};
    } else if (type == "spot") {
        scene::SpotLight spot{.position = position, .direction = shines(), .intensity = {color}};
        Json const defaults = Json::object();
        Object cone =
            light.object("spot").value_or(Object(report, defaults, light.path_of("spot")));
        double const inner = cone.number("innerConeAngle", 0, {0, double(kPi) / 2}),
                     outer = cone.number("outerConeAngle", double(kPi) / 4, {0, double(kPi) / 2});
        if (!(inner <= outer) || outer == 0)
            report.fail(cone.path(), "expected an outer cone wider than the inner one, found none");
        spot.angle = float(degrees(2 * inner));
        spot.falloff = float(degrees(2 * (outer - inner)));
        cone.finish();
        result = spot;
    } else {
        report.fail(light.path_of("type"),
                    "expected point, spot or directional, found " + in_quotes(type));
    }
    light.finish();
    return result;
}

namespace {

/// The corners of each instance's bounding box, in the world.
std::vector<Vec3d> box_corners(scene::Scene const& scene,
                               std::vector<scene::InstanceId> const& instances) {
    std::map<int32_t, std::pair<Vec3, Vec3>> boxes; // by mesh
    std::vector<Vec3d> corners;
    for (scene::InstanceId id : instances) {
        scene::Instance const& instance = scene.instances[size_t(id.index)];
        auto const& shape = std::get<scene::MeshShape>(scene.shapes[size_t(instance.shape.index)]);
        int32_t const mesh = shape.filename.resource;
        auto const [it, fresh] = boxes.emplace(mesh, std::pair(Vec3(kInfinity), Vec3(-kInfinity)));
        auto& [low, high] = it->second;
        if (fresh)
            for (Vec3 const& p : scene.meshes[size_t(mesh)]->positions)
                for (int c = 0; c < 3; ++c) {
                    low[c] = std::min(low[c], p[c]);
                    high[c] = std::max(high[c], p[c]);
                }
        for (int i = 0; i < 8; ++i)
            corners.push_back(instance.transform.point(Vec3d(double(i & 1 ? high.x : low.x),
                                                             double(i & 2 ? high.y : low.y),
                                                             double(i & 4 ? high.z : low.z))));
    }
    return corners;
}

Vec3d middle(std::vector<Vec3d> const& corners) {
    Vec3d low = corners.front(), high = corners.front();
    for (Vec3d const& p : corners)
        for (int c = 0; c < 3; ++c) {
            low[c] = std::min(low[c], p[c]);
            high[c] = std::max(high[c], p[c]);
        }
    return (low + high) * 0.5;
}

} // namespace

bool light_a_room(scene::Scene const& scene, std::vector<scene::LightId> const& lamps,
                  std::vector<scene::InstanceId> const& instances) {
    Vec3d const center = middle(box_corners(scene, instances));
    auto at_center = [&](Color const& intensity, Vec3 const& position) {
        return double(max_component(intensity)) / length_squared(Vec3d(position) - center);
    };
    double irradiance = 0;
    for (scene::LightId id : lamps)
        irradiance +=
            match(scene.lights[size_t(id.index)],
                  Overloaded{[&](scene::PointLight const& l) {
                                 return at_center(l.power.value * (1 / (4 * kPi)), l.position);
                             },
                             [&](scene::SpotLight const& l) {
                                 return at_center(l.intensity.value, l.position);
                             },
                             [](scene::DirectionalLight const& l) {
                                 return double(max_component(l.intensity.value));
                             },
                             [](auto const&) { return 0.; }});
    return irradiance >= 0.1;
}

scene::Camera frame_all(scene::Scene const& scene, std::vector<scene::InstanceId> const& instances,
                        SourceLocation const& where) {
    std::vector<Vec3d> const corners = box_corners(scene, instances);
    if (corners.empty())
        throw InputError(where, "expected a mesh in the default scene, found none");
    Vec3d const center = middle(corners);
    double const turn = double(kPi) / 6, rise = double(kPi) / 10;
    Vec3d const back(std::sin(turn) * std::cos(rise), std::sin(rise),
                     std::cos(turn) * std::cos(rise));
    scene::Perspective camera;
    camera.fov = 40;
    camera.view.width = kHeight * 16 / 9;
    camera.view.height = kHeight;
    Affined frame = view(-back, {back.z, 0, -back.x}, center);
    // A point at (x, y, z) from the centre is in view from a distance d where |x| < t (z + d).
    constexpr double kMargin = 0.94;
    double const tx = kMargin * std::tan(double(radians(camera.fov / 2))), ty = tx * 9 / 16;
    double distance = 1e-6 * (1 + length(center));
    for (Vec3d const& p : corners) {
        Vec3d const q = frame.transposed(p - center);
        distance = std::max(distance, std::max(std::abs(q.x) / tx, std::abs(q.y) / ty) - q.z);
    }
    frame.origin = center + back * distance;
    camera.view.transform = frame;
    return camera;
}

scene::EnvironmentLight make_studio(scene::Scene& scene, scene::Camera const& camera) {
    constexpr int kWidth = 256;
    auto smooth = [](float from, float to, float x) {
        float const t = std::clamp((x - from) / (to - from), 0.f, 1.f);
        return t * t * (3 - 2 * t);
    };
    // In the studio's own axes the camera stands at +z, +x is to its right.
    auto lamp = [&](Vec3 const& d, Vec3 const& towards, float angle) {
        return smooth(std::cos(radians(angle + 6)), std::cos(radians(angle)),
                      dot(d, normalize(towards)));
    };
    constexpr int kRows = kWidth / 2;
    std::vector<float> map; // grey
    for (int y = 0; y < kRows; ++y)
        for (int x = 0; x < kWidth; ++x) {
            // The map's lower edge is the zenith: v, which runs upwards, is the angle from +y.
            float const theta = (1 - (float(y) + 0.5f) / float(kRows)) * kPi;
            float const phi = (0.5f - (float(x) + 0.5f) / float(kWidth)) * 2 * kPi;
            Vec3 const d(std::sin(theta) * std::cos(phi), std::cos(theta),
                         std::sin(theta) * std::sin(phi));
            map.push_back(lerp(0.25f, 0.6f, smooth(-0.6f, 0.8f, d.y)) +
                          4 * lamp(d, {-0.6f, 0.7f, 0.7f}, 20) +
                          0.8f * lamp(d, {1, 0.25f, 0.3f}, 24));
        }
    scene::ImageTexture texture;
    texture.filename = {"studio", int32_t(scene.images.size())};
    texture.linear = true;
    std::vector<std::byte> texels(map.size() * sizeof(float));
    std::memcpy(texels.data(), map.data(), texels.size());
    scene.images.push_back(std::make_shared<image::Texture const>(
        image::Texture::in_memory({image::TexelType::f32, 1}, kWidth, kRows, std::move(texels))));
    scene::EnvironmentLight light;
    light.texture.texture =
        scene::add(scene, schema::TextureKind{}, std::move(texture), {"studio"});
    Affined const& eye = match(
        camera, [](auto const& c) -> auto& { return c.view.transform; });
    // Horizontally from the scene to the camera; one that looks down has its own "down" there.
    Vec3d back(-eye.z.x, 0, -eye.z.z);
    if (length_squared(back) < 1e-6) back = {eye.y.x, 0, eye.y.z};
    back = normalize(back);
    light.transform = {{back.z, 0, -back.x}, {0, 1, 0}, back, Vec3d(0)};
    return light;
}

} // namespace weft::io::gltf
