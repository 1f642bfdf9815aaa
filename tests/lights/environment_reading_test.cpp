// How environment maps are read: radiance in a direction, irradiance, and the mean over the sphere
// against closed forms, for all kinds of files, turned maps, poles and the seam.
#include <gtest/gtest.h>

#include "base/hash.h"
#include "image/texture_cache.h"
#include "image/texture_file.h"
#include "tests/lights/environment_closed_forms.h"
#include "tests/support/scenes.h"

namespace weft::lights {
namespace {

using namespace weft::testing;
using namespace weft::lights::testing;

double const kTolerance = 5e-4; // of the closed forms

/// The channels are the map's times these, which halves and HDR files hold exactly.
double const kChannels[]{1, 0.5, 0.25};

image::Image picture_of(Map const& map) {
    image::Image picture = image::make_image(map.width, map.height, 3);
    for (int row = 0; row < map.height; ++row)
        for (int column = 0; column < map.width; ++column)
            for (int c = 0; c < 3; ++c)
                picture.at(column, row, c) = float(map.at(column, row) * kChannels[c]);
    return picture;
}

enum class Kind { float_exr, half_exr, hdr, tiles };
constexpr Kind kAllKinds[]{Kind::float_exr, Kind::half_exr, Kind::hdr, Kind::tiles};

/// Writes the map; returns its name in the folder.
std::string write_map(TemporaryFolder const& folder, Map const& map, Kind kind) {
    image::Image const picture = picture_of(map);
    if (kind == Kind::hdr) {
        image::write_image(folder / "map.hdr", picture);
        return "map.hdr";
    }
    bool const half = kind == Kind::half_exr;
    image::write_exr(folder / "map.exr", picture, {},
                     half ? image::Precision::half : image::Precision::float32);
    if (kind != Kind::tiles) return "map.exr";
    image::make_texture_file(folder / "map.exr", folder / "map.tx", {image::Transfer::linear});
    return "map.tx";
}

std::string const kCamera = R"(<camera type="perspective" width="1" height="1" fov="0.01">
    <transform><lookat origin="0,0,0" target="0,0,1" up="0,1,0"/></transform></camera>)";

std::string light(std::string const& name, std::string const& attributes = "",
                  std::string const& transform = "") {
    return "<light type=\"envmap\"><texture type=\"image\" filename=\"" + name + "\" " +
           attributes + "/><transform>" + transform + "</transform></light>";
}

/// What the program sees of a map.
class Seen {
  public:
    explicit Seen(TestScene scene) : scene_(std::move(scene)) {}
    Seen(TemporaryFolder const& folder, Map const& map, Kind kind = Kind::float_exr,
         std::string const& attributes = "", std::string const& transform = "")
        : scene_(make_scene(kCamera + light(write_map(folder, map, kind), attributes, transform),
                            "type=\"path\" strategy=\"nee\"", folder.path())) {}

    Color radiance(Vec3 const& d) const {
        Color sum;
        scene_.stage->lights().background(*scene_.world, {}, d,
                                          [&](int32_t, Color const& l, float) { sum += l; });
        return sum;
    }
    /// By light sampling, stratified.
    std::array<double, 3> irradiance(Vec3 const& n) const {
        std::array<double, 3> sum{};
        int const strata = 400;
        Rng rng(7);
        for (int y = 0; y < strata; ++y)
            for (int x = 0; x < strata; ++x) {
                Vec2 const jitter = rng.next2();
                Vec3 const u((float(x) + jitter.x) / strata, (float(y) + jitter.y) / strata, 0.5f);
                scene_.stage->lights().sample(
                    *scene_.world, {{0, 0, 0}, n}, u, [&](LightSample const& s) {
                        double const weight = double(std::max(dot(n, s.wi), 0.f) / s.pdf);
                        for (int c = 0; c < 3; ++c)
                            sum[size_t(c)] += double(s.radiance[c]) * weight / (strata * strata);
                    });
            }
        return sum;
    }
    /// Over the sphere, by points that lie alike in each quarter of a texel of a map of that size.
    double mean(int width, int height) const {
        double sum = 0;
        int const columns = 2 * width * 2, rows = 2 * height * 16;
        for (int y = 0; y < rows; ++y) {
            double const theta = kPi64 * (y + 0.5) / rows;
            double const weight =
                2 * kPi64 / columns * 2 * std::sin(theta) * std::sin(kPi64 / rows / 2);
            for (int x = 0; x < columns; ++x) {
                double const phi = 2 * kPi64 * (x + 0.5) / columns;
                Vec3d const d(std::sin(theta) * std::cos(phi), std::cos(theta),
                              std::sin(theta) * std::sin(phi));
                sum += weight * double(radiance(Vec3(d)).r);
            }
        }
        return sum / (4 * kPi64);
    }

  private:
    TestScene scene_;
};

void expect_irradiance(Seen const& seen, Vec3d const& n, double expected) {
    auto const e = seen.irradiance(Vec3(n));
    for (int c = 0; c < 3; ++c) {
        double const exact = expected * kChannels[c];
        EXPECT_NEAR(e[size_t(c)], exact, kTolerance * exact) << "channel " << c;
    }
}

struct Texel {
    char const* name;
    int column, row;
};
/// Of 16 x 8.
constexpr Texel kTexels[]{{"in the middle", 5, 3},
                          {"left of the seam", 15, 4},
                          {"right of the seam", 0, 2},
                          {"at -y", 7, 0},
                          {"at +y", 2, 7},
                          {"at +y and the seam", 0, 7}};

Vec3d centre_of(int width, int height, int column, int row) {
    double const phi = kPi64 - 2 * kPi64 * (column + 0.5) / width,
                 theta = kPi64 - kPi64 * (row + 0.5) / height;
    return {std::sin(theta) * std::cos(phi), std::cos(theta), std::sin(theta) * std::sin(phi)};
}

TEST(EnvironmentReading, one_bright_texel_lights_planes_as_its_closed_form_says) {
    TemporaryFolder const folder;
    for (Texel const& t : kTexels)
        for (Kind kind : kAllKinds) {
            SCOPED_TRACE(std::string(t.name) + ", file " + std::to_string(int(kind)));
            Map const map = one_texel(16, 8, t.column, t.row);
            Seen const seen(folder, map, kind);
            // Planes that see all of it: towards it, and tilted.
            Vec3d const to = centre_of(16, 8, t.column, t.row);
            for (Vec3d const& tilt : {Vec3d(0, 0, 0), Vec3d(0.3, -0.2, 0.4)}) {
                Vec3d const n = normalize(to + tilt);
                expect_irradiance(seen, n, map.irradiance(n));
            }
            EXPECT_NEAR(seen.mean(16, 8), map.mean(), kTolerance * map.mean());
        }
}

TEST(EnvironmentReading, large_maps_are_not_blurred) {
    TemporaryFolder const folder;
    for (Kind kind : {Kind::half_exr, Kind::tiles}) {
        SCOPED_TRACE(int(kind));
        Map const map = one_texel(2048, 1024, 700, 300, 4096);
        Seen const seen(folder, map, kind);
        Vec3d const n = centre_of(2048, 1024, 700, 300);
        expect_irradiance(seen, n, map.irradiance(n));
        EXPECT_NEAR(seen.radiance(Vec3(n)).r, 4096, 10); // floats place it to 1/1000 of a texel
    }
}

TEST(EnvironmentReading, stripes_light_planes_as_their_closed_form_says) {
    TemporaryFolder const folder;
    std::pair<char const*, Map> const all[]{
        {"rows", map_of(32, 16, [](int, int row) { return row % 2 ? 8 : 0.5; })},
        {"wide rows", map_of(6, 3, [](int, int row) { return row + 1; })},
        {"columns", map_of(32, 16, [](int column, int) { return column % 2 ? 8 : 0.5; })},
        {"few columns", map_of(3, 2, [](int column, int) { return 1 << column; })},
        {"fine rows", map_of(512, 256, [](int, int row) { return row % 4 < 2 ? 1 : 0; })},
        {"fine columns", map_of(512, 256, [](int column, int) { return column % 4 < 2 ? 1 : 0; })},
        {"both", map_of(16, 8, [](int column, int row) { return 1 + column % 3 + 2 * row; })},
        {"one texel", map_of(1, 1, [](int, int) { return 3; })},
    };
    for (auto const& [name, map] : all)
        for (Kind kind : {Kind::float_exr, Kind::hdr}) {
            SCOPED_TRACE(std::string(name) + ", file " + std::to_string(int(kind)));
            Seen const seen(folder, map, kind);
            expect_irradiance(seen, {0, 1, 0}, map.irradiance_from_above());
            expect_irradiance(seen, {1, 0, 0}, map.irradiance_from_x());
        }
}

TEST(EnvironmentReading, radiance_in_a_direction_is_interpolated_between_centres) {
    TemporaryFolder const folder;
    Map const map = map_of(16, 8, [](int column, int row) {
        return double((column * 7 + row * 5) % 11) + (row == 0 ? 20 : 0);
    });
    Rng rng(5);
    for (Kind kind : kAllKinds)
        for (char const* attributes : {"", "border=\"clamp\"", "filter=\"mipmap\""}) {
            SCOPED_TRACE(std::to_string(int(kind)) + attributes);
            Seen const seen(folder, map, kind, attributes);
            for (int i = 0; i < 1000; ++i) {
                // Every other one near a pole or the seam.
                double const y = i % 4 == 0 ? (i % 8 ? 1 : -1) * (1 - 0.04 * double(rng.next()))
                                            : 1 - 2 * double(rng.next());
                double const phi = i % 4 == 1 ? kPi64 + 0.3 * (double(rng.next()) - 0.5)
                                              : 2 * kPi64 * double(rng.next());
                double const r = std::sqrt(1 - y * y);
                Vec3d const d(r * std::cos(phi), y, r * std::sin(phi));
                double const exact = map.radiance(d);
                EXPECT_NEAR(double(seen.radiance(Vec3(d)).r), exact, kTolerance * 10)
                    << d.x << ' ' << d.y << ' ' << d.z;
            }
        }
}

// Not one digit of the other pole's light, from which wrapping rows would take a half at the pole.
TEST(EnvironmentReading, poles_do_not_see_each_other) {
    TemporaryFolder const folder;
    for (char const* filter : {"bilinear", "nearest", "mipmap"})
        for (int pole : {1, -1}) {
            SCOPED_TRACE(std::string(filter) + std::to_string(pole));
            int const row = pole > 0 ? 7 : 0; // the lower rows are at +y
            Seen const seen(folder, map_of(16, 8, [&](int, int r) { return r == row ? 1 : 0; }),
                            Kind::float_exr, "filter=\"" + std::string(filter) + "\"");
            for (float slope : {0.f, 1e-8f, 1e-4f, 0.01f, 0.1f, 0.19f})
                for (int i = 0; i < 32; ++i) {
                    float const phi = float(i) * 0.2f;
                    Vec3 const d =
                        normalize(Vec3(slope * std::cos(phi), float(pole), slope * std::sin(phi)));
                    EXPECT_FLOAT_EQ(seen.radiance(d).r, 1);
                    EXPECT_EQ(seen.radiance(-d).r, 0);
                }
        }
}

TEST(EnvironmentReading, rotated_maps_are_read_where_they_were_turned_to) {
    TemporaryFolder const folder;
    // Columns are the images of the axes.
    std::string const turn =
        R"(<matrix value="0.36,0.48,-0.8,0, -0.8,0.6,0,0, 0.48,0.64,0.6,0, 0,0,0,1"/>)";
    auto const to_map = [](Vec3d const& d) {
        return Vec3d(0.36 * d.x - 0.8 * d.y + 0.48 * d.z, 0.48 * d.x + 0.6 * d.y + 0.64 * d.z,
                     -0.8 * d.x + 0.6 * d.z);
    };
    for (Texel const& t : kTexels) {
        SCOPED_TRACE(t.name);
        Map const map = one_texel(16, 8, t.column, t.row);
        Seen const seen(folder, map, Kind::half_exr, "", turn);
        Vec3d const at = centre_of(16, 8, t.column, t.row);
        Vec3d const n(0.36 * at.x + 0.48 * at.y - 0.8 * at.z, -0.8 * at.x + 0.6 * at.y,
                      0.48 * at.x + 0.64 * at.y + 0.6 * at.z);
        EXPECT_NEAR(double(seen.radiance(Vec3(n)).r), 40, 40 * kTolerance);
        Vec3d const tilted = normalize(n + Vec3d(0.2, 0.3, -0.3));
        expect_irradiance(seen, tilted, map.irradiance(to_map(tilted)));
    }
}

TEST(EnvironmentReading, where_texels_lie_changes_no_bit) {
    TemporaryFolder const folder;
    Map const map = map_of(
        200, 100, [](int column, int row) { return double((column * 37 + row * 101) % 256); });
    std::string const name = write_map(folder, map, Kind::half_exr);
    auto const cached = [&](image::TextureCacheOptions const& options) {
        std::string const text =
            "<integrator type=\"path\"><sampler type=\"independent\"/><scene>" + kCamera +
            light(name) + "</scene></integrator>";
        TestScene made{io::parse_scene(text, "test", folder.path(), {},
                                       std::make_shared<image::TextureCache>(options))
                           .jobs.at(0),
                       nullptr, nullptr};
        made.commit();
        return Seen(std::move(made));
    };
    Seen const whole = cached({}), tiled = cached({.small_texels = 1, .folder = folder.path()});
    Rng rng(9);
    for (int i = 0; i < 2000; ++i) {
        double const y = 1 - 2 * double(rng.next()), phi = 2 * kPi64 * double(rng.next());
        double const r = std::sqrt(1 - y * y);
        Vec3 const d(Vec3d(r * std::cos(phi), y, r * std::sin(phi)));
        EXPECT_EQ(whole.radiance(d), tiled.radiance(d));
    }
}

/// Estimates the only pixel of a camera that looks from `from` along `d`. Sobol points leave less
/// noise than the variance says.
Estimate pixel(std::string const& contents, std::string const& integrator,
               TemporaryFolder const& folder, Vec3d const& from, Vec3d const& d, int samples) {
    auto const text = [](Vec3d const& v) {
        return std::to_string(v.x) + "," + std::to_string(v.y) + "," + std::to_string(v.z);
    };
    std::string const camera =
        "<camera type=\"perspective\" width=\"1\" height=\"1\" fov=\"0.01\"><transform><lookat "
        "origin=\"" +
        text(from) + "\" target=\"" + text(from + d * 10.) +
        "\" up=\"0.1,1,0.2\"/></transform></camera>";
    return block_estimates(
        make_scene(camera + contents, integrator, folder.path(), "type=\"sobol\""), samples, 1,
        3)[0];
}

TEST(EnvironmentReading, rays_that_leave_the_scene_see_the_map_as_it_is) {
    TemporaryFolder const folder;
    Map const map =
        map_of(64, 32, [](int column, int row) { return double((column * 7 + row * 5) % 11) + 1; });
    std::string const name = write_map(folder, map, Kind::half_exr);
    // Glass and mirrors widen what a ray stands for; a map is looked up at a point all the same.
    std::string const mirror =
        R"(<instance><shape type="rectangle"/><bsdf type="conductor" reflectance="1"/>
        <transform><scale value="50"/></transform></instance>)";
    Rng rng(11);
    for (char const* filter : {"bilinear", "mipmap"})
        for (int i = 0; i < 10; ++i) {
            double const z = 0.2 + 0.7 * double(rng.next()), phi = 2 * kPi64 * double(rng.next());
            double const r = std::sqrt(1 - z * z);
            Vec3d const d(r * std::cos(phi), r * std::sin(phi), z);
            std::string const sky = light(name, "filter=\"" + std::string(filter) + "\"");
            double const exact = map.radiance(d);
            // 1 / 300 of a texel is 0.01 degrees.
            EXPECT_NEAR(pixel(sky, "type=\"path\"", folder, {0, 0, 0}, d, 64).mean, exact, 0.02);
            EXPECT_NEAR(pixel(sky + mirror, "type=\"path\"", folder,
                              Vec3d(0.1, 0.2, 0) - Vec3d(d.x, d.y, -d.z), {d.x, d.y, -d.z}, 64)
                            .mean,
                        exact, 0.02);
        }
}

TEST(EnvironmentReading, every_strategy_renders_the_closed_form) {
    TemporaryFolder const folder;
    std::string const plane =
        R"(<instance><shape type="rectangle"/><bsdf type="diffuse" albedo="0.5"/>
        <transform><scale value="50"/></transform></instance>)";
    std::vector<std::pair<char const*, Map>> const all{
        {"a texel", one_texel(16, 8, 3, 3)},
        {"a pole", one_texel(16, 8, 4, 7)},
        {"a small sun", one_texel(512, 256, 100, 140, 4096)},
    };
    double const level = sidak(0.01, int(all.size()) * 3);
    for (auto const& [name, map] : all) {
        std::string const sky = light(write_map(folder, map, Kind::hdr), "filter=\"mipmap\"");
        // At the pole the plane would not see all of the texel: the map is turned so that +y is z.
        bool const pole = map.at(4, map.height - 1) != 0;
        std::string const turned =
            pole ? light("map.hdr", "", R"(<rotate axis="1,0,0" angle="90"/>)") : sky;
        double const exact = 0.5 / kPi64 * map.irradiance(pole ? Vec3d(0, 1, 0) : Vec3d(0, 0, 1));
        for (char const* strategy : {"bsdf", "nee", "mis"}) {
            SCOPED_TRACE(std::string(name) + ", " + strategy);
            bool const by_chance = std::string(strategy) == "bsdf";
            Estimate const e =
                pixel(turned + plane, "type=\"path\" strategy=\"" + std::string(strategy) + "\"",
                      folder, {0.3, 0.2, 2}, {0, 0, -1}, 1 << 18);
            EXPECT_GT(normal_tail((e.mean - exact) / std::sqrt(e.variance + 1e-14)), level)
                << e.mean << " for " << exact;
            if (!by_chance) {
                EXPECT_NEAR(e.mean, exact, kTolerance * exact);
            }
        }
    }
}

} // namespace
} // namespace weft::lights
