// Camera rays against the pictures that they should make.
#include <gtest/gtest.h>

#include "base/hash.h"
#include "base/warp.h"
#include "tests/support/scenes.h"

namespace weft::world {
namespace {

using namespace weft::testing;

/// Where the ray crosses the plane z = `z`, in the camera's space.
Vec2 at_plane(Ray const& ray, float z) {
    Vec3 const p = ray.origin + ray.direction * ((z - ray.origin.z) / ray.direction.z);
    return {p.x, p.y};
}

CameraRays camera(std::string const& attributes, std::string const& folder = "") {
    return make_scene("<camera " + attributes + "/>", "type=\"path\"", folder).world->camera();
}

TEST(Perspective, OpensOverItsAxis) {
    float const tangent = std::tan(radians(50.f) / 2);
    CameraRays const x =
        camera("type=\"perspective\" width=\"200\" height=\"100\" fov=\"50\" fovAxis=\"x\"");
    CameraRays const y =
        camera("type=\"perspective\" width=\"200\" height=\"100\" fov=\"50\" fovAxis=\"y\"");
    EXPECT_NEAR(at_plane(x.ray({0, 50}, {}, 0), 1).x, -tangent, 1e-6);
    EXPECT_NEAR(at_plane(x.ray({200, 50}, {}, 0), 1).x, tangent, 1e-6);
    EXPECT_NEAR(at_plane(x.ray({100, 100}, {}, 0), 1).y, tangent / 2, 1e-6);
    EXPECT_NEAR(at_plane(y.ray({100, 0}, {}, 0), 1).y, -tangent,
                1e-6); // the top row looks along -y
    EXPECT_NEAR(at_plane(y.ray({200, 50}, {}, 0), 1).x, 2 * tangent, 1e-6);
    Ray const centre = x.ray({100, 50}, {}, 0.25f);
    EXPECT_EQ(centre.direction, Vec3(0, 0, 1));
    EXPECT_EQ(centre.time, 0.25f);
    EXPECT_EQ(centre.t_max, kInfinity);
    EXPECT_FALSE(x.has_lens());
}

TEST(Perspective, KeepsItsViewWhenResized) {
    CameraRays c = camera("type=\"perspective\" width=\"200\" height=\"100\" fov=\"50\"");
    Vec3 const before = c.ray({150, 75}, {}, 0).direction;
    c.resize({400, 200});
    EXPECT_LT(length(c.ray({300, 150}, {}, 0).direction - before), 1e-6f);
}

TEST(Orthographic, SendsParallelRays) {
    CameraRays const c = camera("type=\"orthographic\" width=\"100\" height=\"50\" scale=\"3\"");
    for (Vec2 const& raster : {Vec2(0, 0), Vec2(100, 50), Vec2(20, 30)}) {
        Ray const ray = c.ray(raster, {}, 0);
        EXPECT_EQ(ray.direction, Vec3(0, 0, 1));
        EXPECT_NEAR(ray.origin.x, 3 * (raster.x / 50 - 1), 1e-5);
        EXPECT_NEAR(ray.origin.y, 3 * (raster.y - 25) / 50, 1e-5);
    }
}

TEST(ThinLens, FocusesWhereItSays) {
    CameraRays const lens = camera("type=\"thinlens\" width=\"64\" height=\"64\" fov=\"40\" "
                                   "lensRadius=\"0.3\" focalDistance=\"5\"");
    CameraRays const pinhole = camera("type=\"perspective\" width=\"64\" height=\"64\" fov=\"40\"");
    ASSERT_TRUE(lens.has_lens());
    Rng rng(1);
    for (int i = 0; i < 1000; ++i) {
        Vec2 const raster = rng.next2() * 64.f;
        Ray const ray = lens.ray(raster, rng.next2(), 0);
        Vec2 const a = at_plane(ray, 5), b = at_plane(pinhole.ray(raster, {}, 0), 5);
        EXPECT_LT(std::hypot(a.x - b.x, a.y - b.y), 1e-5f);
        EXPECT_LE(std::hypot(ray.origin.x, ray.origin.y), 0.3f * (1 + 1e-6f));
        EXPECT_EQ(ray.origin.z, 0);
    }
}

/// Chi-square of lens points against `density` over the square around the lens; `density` is on
/// any scale and integrated by `fine` x `fine` points per cell.
double lens_p_value(CameraRays const& c, float radius, auto&& density) {
    constexpr int cells = 12, fine = 80, samples = 400000;
    std::vector<double> observed(cells * cells), expected(cells * cells);
    Rng rng(2);
    for (int i = 0; i < samples; ++i) {
        Vec3 const p = c.ray({8, 8}, rng.next2(), 0).origin;
        auto cell = [&](float x) {
            return std::clamp(int((x / radius + 1) / 2 * cells), 0, cells - 1);
        };
        ++observed[size_t(cell(p.y) * cells + cell(p.x))];
    }
    double total = 0;
    for (int y = 0; y < cells * fine; ++y)
        for (int x = 0; x < cells * fine; ++x) {
            auto place = [&](int i) { return 2 * (i + 0.5) / (cells * fine) - 1; };
            double const d = density(place(x), place(y));
            expected[size_t(y / fine * cells + x / fine)] += d;
            total += d;
        }
    for (double& e : expected) e *= samples / total;
    // Cells that the shape only touches are integrated badly: pool what expects next to nothing.
    auto const test = chi_square(observed, expected);
    return test.problem.empty() ? test.p_value : 0;
}

TEST(ThinLens, ApertureHasItsShape) {
    TemporaryFolder const folder;
    image::Image bokeh = image::make_image(4, 4, 3);
    for (int i = 0; i < 16; ++i)
        for (int k = 0; k < 3; ++k) bokeh.at(i % 4, i / 4, k) = i % 5 == 0 ? 0.f : 0.1f * float(i);
    image::write_exr(folder / "bokeh.exr", bokeh);
    std::string const base = "type=\"thinlens\" width=\"16\" height=\"16\" lensRadius=\"0.5\" ";
    double const level = sidak(0.01, 4);
    EXPECT_GT(lens_p_value(camera(base), 0.5f,
                           [](double x, double y) { return x * x + y * y < 1 ? 1 : 0; }),
              level);
    for (int blades : {5, 6}) {
        // Inside of the polygon with a corner at 20 degrees.
        auto const polygon = [&](double x, double y) {
            double const step = 2 * M_PI / blades, from = 20 * M_PI / 180,
                         phi = std::atan2(y, x) - from;
            double const within = phi - step * (std::floor(phi / step) + 0.5);
            return std::hypot(x, y) * std::cos(within) < std::cos(step / 2) ? 1 : 0;
        };
        EXPECT_GT(lens_p_value(camera(base + "bladeRotation=\"20\" blades=\"" +
                                      std::to_string(blades) + "\""),
                               0.5f, polygon),
                  level)
            << blades;
    }
    auto const image = [&](double x, double y) {
        return double(bokeh.at(int((x + 1) * 2), int((y + 1) * 2), 0));
    };
    EXPECT_GT(lens_p_value(camera(base + "bokeh=\"bokeh.exr\"", folder.path()), 0.5f, image),
              level);
}

TEST(Environment, CameraShowsTheMapAgain) {
    // Each pixel of the picture is the pixel of the map, whatever rotation both share.
    TemporaryFolder const folder;
    image::Image map = image::make_image(16, 8, 3);
    Rng rng(3);
    for (float& v : map.pixels) v = rng.next();
    image::write_exr(folder / "map.exr", map);
    std::string const transform = "<transform><rotate axis=\"1,2,3\" angle=\"77\"/></transform>";
    auto const scene =
        make_scene("<camera type=\"environment\" width=\"16\" height=\"8\">" + transform +
                       "</camera><light type=\"envmap\">"
                       "<texture type=\"image\" filename=\"map.exr\" filter=\"nearest\"/>" +
                       transform + "</light>",
                   "type=\"path\"", folder.path());
    integrator::PixelRenderer const renderer(*scene.stage, scene.job.integrator, scene.job.sampler,
                                             1);
    for (int y = 0; y < 8; ++y)
        for (int x = 0; x < 16; ++x)
            for (uint32_t s = 0; s < 4; ++s) {
                Color const c = renderer.sample({x, y}, s);
                for (int k = 0; k < 3; ++k) EXPECT_EQ(c[k], map.at(x, y, k)) << x << ", " << y;
            }
}

TEST(Cameras, FollowTheirTransform) {
    auto const scene = make_scene(
        R"(<camera type="perspective" width="2" height="2"><transform><lookat origin="1,2,3" target="1,2,8" up="0,1,0"/></transform></camera>)");
    EXPECT_EQ(scene.world->camera().position(), Vec3(1, 2, 3));
    Ray const ray = scene.world->camera().ray({1, 1}, {}, 0);
    EXPECT_LT(length(ray.direction - Vec3(0, 0, 1)), 1e-6f);
    EXPECT_NEAR(length(scene.world->camera().ray({0.3f, 1.9f}, {}, 0).direction), 1, 1e-6);
}

} // namespace
} // namespace weft::world
