// Adaptive sampling: what it decides, that nothing but the samples has a say in it, and that its
// pictures have the same mean as those of fixed sampling.
#include <gtest/gtest.h>

#include "session/adaptive.h"
#include "session/render.h"
#include "tests/support/scenes.h"

namespace weft::session {
namespace {

using namespace weft::testing;

film::Film film_with_halves(film::Region const& region) {
    film::LayoutOptions options;
    options.half_sums = true;
    return film::Film(region, film::Layout({}, options));
}

/// Root of the mean square of the errors of blocks.
double root_mean_square(std::vector<float> const& errors) {
    double sum = 0;
    for (float e : errors) sum += double(e) * double(e);
    return std::sqrt(sum / double(errors.size()));
}

TEST(Blocks, ErrorIsThatOfTheMeanAsSeen) {
    // Of n samples, uniform in [0, 2b): the mean b is off by b / sqrt(3 n). That is relative to b
    // where it is at least the typical brightness t, to sqrt(b t) where it is less.
    constexpr uint32_t n = 1024;
    for (double const b : {16.0, 1.0, 0.09, 0.0001}) {
        // Three quarters of the picture are 1, the last has b.
        film::Film film = film_with_halves({{0, 0}, {32, 128}});
        Rng rng(3);
        for (int y = 0; y < 128; ++y)
            for (int x = 0; x < 32; ++x)
                for (uint32_t s = 0; s < n; ++s)
                    film.add(x, y, s, Color(y < 96 ? 1 : 2 * rng.next() * float(b)), nullptr);
        auto const all = block_errors(film);
        std::vector<float> const last(all.end() - 16, all.end());
        double const t = std::pow(0.75 + 0.25 * std::sqrt(b), 2), least = std::max(b, 0.01 * t),
                     unit = std::max(least, std::sqrt(least * t));
        // The square of a normal variable has a variance of twice its own squared. The darker half
        // is darker by what the half of their difference is on the average, once more.
        EXPECT_NEAR(root_mean_square(last) * std::sqrt(3 * n) * unit / b, 1,
                    4 * std::sqrt(0.5 / (32 * 32)) + 1.5 / std::sqrt(3 * n))
            << b;
    }
}

TEST(Blocks, LoneSamplesDoNotHideThemselves) {
    // One sample of 64 brings 640 times the light of all others: the pixel is off by ten times its
    // brightness, which its own mean would make 0.9.
    film::Film film = film_with_halves({{0, 0}, {8, 8}});
    for (int y = 0; y < 8; ++y)
        for (int x = 0; x < 8; ++x)
            for (uint32_t s = 0; s < 64; ++s)
                film.add(x, y, s, Color(x + y + int(s) == 0 ? 641.f : 1.f), nullptr);
    double const typical = std::pow((63 + std::sqrt(11.0)) / 64, 2);
    EXPECT_NEAR(block_errors(film)[0], 10 / std::sqrt(typical) / 8, 1e-3);
}

TEST(Blocks, SeldomLightInTheDarkIsNoWorseThanElsewhere) {
    // Light that one of 1 / p samples finds is off by sqrt(p / n), and sqrt(b t) is sqrt(p): all
    // pixels need as many samples, down to those that are black to the eye.
    constexpr uint32_t n = 2048;
    film::Film film = film_with_halves({{0, 0}, {64, 32}});
    Rng rng(11);
    for (int y = 0; y < 32; ++y)
        for (int x = 0; x < 64; ++x)
            for (uint32_t s = 0; s < n; ++s)
                film.add(x, y, s, Color(x < 56 || rng.next() < 0.002f ? 1.f : 0.f), nullptr);
    for (float e : block_errors(film)) EXPECT_LT(e, 1 / std::sqrt(double(n)));
}

/// Samples of a picture of 48 x 48 pixels whose left half is dark. `rare` is how many of them bring
/// 200 times the light of the others.
class FireflyRender {
  public:
    FireflyRender(double rare, uint64_t seed) : rare_(rare), rng_(seed) {}

    double mean(int x) const { return light(x) * (1 + 199 * rare_); }
    double sample(int x) {
        bool const found = double(rng_.next()) < rare_;
        return light(x) * (found ? 200 : 2 * double(rng_.next()));
    }
    /// Renders until the error is estimated to be `noise` everywhere.
    film::Film run(double noise) {
        film::Film film = film_with_halves({{0, 0}, {48, 48}});
        BlockGrid const grid(film.region());
        std::vector<uint8_t> active(grid.size(), 1);
        for (uint32_t from = 0; std::count(active.begin(), active.end(), 1) > 0;) {
            uint32_t const to = adaptive_pass_end(from, 1 << 16);
            for (int y = 0; y < 48; ++y)
                for (int x = 0; x < 48; ++x)
                    for (uint32_t s = film.counts(x, y).all; active[grid.index(x, y)] && s < to;
                         ++s)
                        film.add(x, y, s, Color(float(sample(x))), nullptr);
            from = to;
            if (from >= kLeastSamples)
                active = active_blocks(film, block_errors(film), noise, 1 << 16);
        }
        return film;
    }

  private:
    double light(int x) const { return x < 24 ? 0.02 : 1; }

    double rare_;
    Rng rng_;
};

/// The worst block's error, of a film whose pixels' means are known.
double worst_error(film::Film const& film, FireflyRender const& truth) {
    BlockGrid const grid(film.region());
    double typical = 0, worst = 0;
    for (int x = 0; x < 48; ++x) typical += std::sqrt(truth.mean(x)) / 48;
    typical *= typical;
    for (size_t i = 0; i < grid.size(); ++i) {
        film::Region const block = grid.block(i);
        double sum = 0;
        for (int y = block.from.y; y < block.to.y; ++y)
            for (int x = block.from.x; x < block.to.x; ++x) {
                double const b = std::max(truth.mean(x), 0.01 * typical),
                             off = double(film.mean(x, y).r) - truth.mean(x),
                             unit = std::max(b, std::sqrt(b * typical));
                sum += off * off / (unit * unit) / 64;
            }
        worst = std::max(worst, std::sqrt(sum));
    }
    return worst;
}

TEST(Blocks, TheWorstIsWithinTwiceWhatIsReported) {
    // Were one of ten renders beyond it, all 42 would be within it with a chance of 1.2%.
    int renders = 0;
    for (double const rare : {0.0, 1e-4, 1e-3})
        for (uint64_t seed = 1; seed <= 14; ++seed, ++renders) {
            FireflyRender truth(rare, seed);
            film::Film const film = truth.run(0.1);
            auto const errors = block_errors(film);
            double const reported = double(*std::max_element(errors.begin(), errors.end()));
            EXPECT_LE(reported, 0.1);
            EXPECT_LT(worst_error(film, truth), 2 * reported) << rare << ", seed " << seed;
        }
    EXPECT_EQ(renders, 42);
}

TEST(Blocks, NoiseWakesTheNeighbours) {
    // Of a kind that says nothing of other blocks: all pixels of one are as noisy.
    film::Film film = film_with_halves({{5, 3}, {5 + 40, 3 + 30}});
    BlockGrid const grid(film.region());
    ASSERT_EQ(grid.columns, 5);
    ASSERT_EQ(grid.rows, 4);
    for (int y = 3; y < 33; ++y)
        for (int x = 5; x < 45; ++x)
            for (uint32_t s = 0; s < 4; ++s)
                film.add(x, y, s,
                         Color(grid.index(x, y) == grid.index(30, 30) && s == 0 ? 2.f : 1.f),
                         nullptr);
    auto const errors = block_errors(film);
    for (size_t i = 0; i < errors.size(); ++i)
        EXPECT_EQ(errors[i] > 0.05f, i == grid.index(30, 30)) << i;
    std::vector<uint8_t> expected(20);
    for (int r : {2, 3})
        for (int c : {2, 3, 4}) expected[size_t(5 * r + c)] = 1;
    EXPECT_EQ(active_blocks(film, errors, 0.05, 100), expected);
    EXPECT_EQ(active_blocks(film, errors, 0.05, 4), std::vector<uint8_t>(20)) << "the limit";
    EXPECT_EQ(grid.block(19).to, Vec2i(45, 33));
}

TEST(Blocks, RarePathsCountForTheBlocksAround) {
    // One of 8000 samples brings 400 times as much as all others, anywhere. Of blocks with 64
    // pixels of 32 samples, three of four have found none.
    constexpr int size = 128, n = 32;
    constexpr double rate = 1 / 8000.0, rare = 400;
    film::Film film = film_with_halves({{0, 0}, {size, size}});
    Rng rng(7);
    for (int y = 0; y < size; ++y)
        for (int x = 0; x < size; ++x)
            for (uint32_t s = 0; s < n; ++s) {
                float const common = 1 + 0.01f * (rng.next() - 0.5f);
                bool const found = double(rng.next()) < rate;
                film.add(x, y, s, Color(found ? float(rare) : common), nullptr);
            }
    // A pixel that has found one is off by half the difference of its halves, of which the other
    // one is 1, as is the picture.
    double const expected = std::sqrt(rate * n) * (rare - 1) / n;
    auto const errors = block_errors(film);
    for (size_t i = 0; i < errors.size(); ++i) {
        EXPECT_GT(errors[i], expected / 3) << i;
        EXPECT_LT(errors[i], expected * 3) << i;
    }
}

TEST(Blocks, CommonNoiseStaysWhereItIs) {
    // Uniform noise left of a wall that has none.
    film::Film film = film_with_halves({{0, 0}, {160, 80}});
    Rng rng(7);
    for (int y = 0; y < 80; ++y)
        for (int x = 0; x < 160; ++x)
            for (uint32_t s = 0; s < 32; ++s)
                film.add(x, y, s, Color(x < 80 ? 2 * rng.next() : 1.f), nullptr);
    BlockGrid const grid(film.region());
    auto const errors = block_errors(film);
    for (size_t i = 0; i < errors.size(); ++i) {
        int const x = grid.block(i).from.x;
        if (x < 80)
            EXPECT_NEAR(errors[i], 1 / std::sqrt(3.0 * 32), 0.05);
        else
            EXPECT_EQ(errors[i], 0);
    }
}

TEST(Blocks, BlackIsWithoutNoise) {
    film::Film film = film_with_halves({{0, 0}, {8, 8}});
    EXPECT_EQ(block_errors(film)[0], 0);
    for (uint32_t s = 0; s < 4; ++s) film.add(0, 0, s, Color(0), nullptr);
    EXPECT_EQ(block_errors(film)[0], 0);
}

TEST(Passes, GrowToTheLimit) {
    uint32_t n = 0, passes = 0;
    for (; n < 10000; n = adaptive_pass_end(n, 10000), ++passes) {
        EXPECT_TRUE(n < 2 || n % 2 == 0) << "both halves have as many samples";
        ASSERT_LT(passes, 30u);
    }
    EXPECT_EQ(n, 10000u);
}

struct NamedScene {
    std::string name, contents;
};

std::string camera() {
    return R"(<camera type="perspective" width="32" height="24" fov="45"><transform><lookat origin="0,1.2,-4" target="0,0.3,0" up="0,1,0"/></transform></camera>
    <instance><shape type="rectangle"/><bsdf type="diffuse" albedo="0.6"/><transform><scale value="5"/><rotate axis="1,0,0" angle="-90"/><translate y="-0.7"/></transform></instance>)";
}
std::string lamp(std::string const& size, std::string const& emission) {
    return "<light type=\"area\"><instance><shape type=\"rectangle\"/><emission "
           "type=\"lambertian\" "
           "emission=\"" +
           emission + "\"/><transform><scale value=\"" + size +
           "\"/><rotate axis=\"1,0,0\" angle=\"90\"/><translate "
           "y=\"3\"/></transform></instance></light>";
}
std::string ball(std::string const& bsdf, std::string const& at = "0") {
    return "<instance><shape type=\"sphere\"/>" + bsdf +
           "<transform><scale value=\"0.7\"/><translate x=\"" + at + "\"/></transform></instance>";
}

/// Eight scenes, among them what stopping rules get wrong: dark parts, rare light, thin features.
std::vector<NamedScene> scenes() {
    std::string const
        diffuse = "<bsdf type=\"diffuse\" albedo=\"0.5\"/>",
        glass = "<bsdf type=\"dielectric\"/>",
        gloss = "<bsdf type=\"principled\" roughness=\"0.2\" metallic=\"1\"/>",
        sky = "<light type=\"envmap\"><texture type=\"constant\" value=\"0.4\"/></light>";
    return {
        {"soft shadow", camera() + lamp("1", "8") + ball(diffuse)},
        {"small lamp", camera() + lamp("0.1", "600") + ball(diffuse)},
        {"caustic", camera() + lamp("0.4", "40") + ball(glass)},
        {"gloss", camera() + lamp("0.5", "20") + sky + ball(gloss)},
        {"dark and bright", camera() + lamp("1", "8") + ball(diffuse, "-1") +
                                ball("<bsdf type=\"diffuse\" albedo=\"0.005\"/>", "1")},
        {"sky", camera() + sky + ball(diffuse) + ball(glass, "1.5")},
        {"fog", camera() + lamp("0.7", "20") +
                    "<instance><shape type=\"sphere\"/><medium type=\"homogeneous\" "
                    "absorption=\"0.2\" scatter=\"1.5\"/></instance>"},
        {"checker through alpha",
         camera() + sky + lamp("0.5", "20") +
             "<instance alpha=\"0.3\"><shape type=\"sphere\"/><bsdf type=\"diffuse\"><texture "
             "name=\"albedo\" type=\"checkerboard\" scale=\"8,8\" color0=\"0.02\" "
             "color1=\"0.9\"/></bsdf></instance>"},
    };
}

/// Mean brightness of square blocks of a picture.
std::vector<double> block_means(image::Image const& image, int block) {
    std::vector<double> means;
    for (int by = 0; by + block <= image.height; by += block)
        for (int bx = 0; bx + block <= image.width; bx += block) {
            double sum = 0;
            for (int y = by; y < by + block; ++y)
                for (int x = bx; x < bx + block; ++x)
                    for (int c = 0; c < 3; ++c) sum += double(image.at(x, y, c));
            means.push_back(sum / (3.0 * block * block));
        }
    return means;
}

/// Estimates of the means of blocks, and last of the whole picture, from `renders` seeds: their
/// spread gives the variance without any assumption on the samples.
std::vector<Estimate> over_seeds(TestScene const& scene, RenderOptions options, int renders) {
    std::vector<std::vector<double>> all;
    for (int i = 0; i < renders; ++i) {
        ++options.picture.seed;
        all.push_back(block_means(render(*scene.stage, scene.job, options).image, 8));
        double sum = 0;
        for (double m : all.back()) sum += m;
        all.back().push_back(sum / double(all.back().size()));
    }
    std::vector<Estimate> estimates(all[0].size());
    for (size_t b = 0; b < estimates.size(); ++b) {
        Estimate& e = estimates[b];
        for (auto const& one : all) e.mean += one[b] / renders;
        for (auto const& one : all) e.variance += (one[b] - e.mean) * (one[b] - e.mean);
        e.variance /= double(renders) * (renders - 1);
    }
    return estimates;
}

RenderOptions with(int spp, double noise, uint32_t seed) {
    RenderOptions o;
    o.limits.spp = spp;
    o.limits.noise = noise;
    o.picture.seed = seed;
    return o;
}

/// The normal variable that is as unlikely as `t` of Student's distribution (Wallace 1959, "Bounds
/// on normal approximations to Student's and the chi-square distributions").
double as_normal(double t, double freedom) {
    return (8 * freedom + 1) / (8 * freedom + 3) * std::sqrt(freedom * std::log1p(t * t / freedom));
}

TEST(Adaptive, HasTheMeansOfFixedSampling) {
    constexpr int renders = 10;
    std::vector<NamedScene> const all = scenes();
    size_t tests = 0;
    double least = 1;
    std::string where;
    for (NamedScene const& s : all) {
        TestScene const scene =
            make_scene(s.contents, "type=\"path\" depth=\"6\"", "", "type=\"sobol\" count=\"64\"");
        auto const adaptive = over_seeds(scene, with(128, 0.35, 100), renders),
                   fixed = over_seeds(scene, with(48, 0, 900), renders);
        for (size_t b = 0; b < fixed.size(); ++b, ++tests) {
            Estimate const &x = adaptive[b], &y = fixed[b];
            // Where there is no noise, sums of different numbers of floats differ in rounding.
            double const beyond = std::abs(x.mean - y.mean) - 4e-6 * (x.mean + y.mean);
            if (beyond <= 0) continue;
            double const t = beyond / std::sqrt(x.variance + y.variance),
                         p = normal_tail(as_normal(t, renders - 1));
            if (p < least) {
                least = p;
                where = s.name + ", block " + std::to_string(b);
            }
        }
    }
    EXPECT_GT(least, 1 - std::pow(1 - 1e-3, 1.0 / double(tests))) << where << " of " << tests;
}

} // namespace
} // namespace weft::session
