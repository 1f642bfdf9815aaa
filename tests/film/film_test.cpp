#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <numeric>

#include "base/error.h"
#include "base/hash.h"
#include "film/contribution.h"
#include "film/film.h"

namespace weft::film {
namespace {

TEST(Film, GivesTheMeanOfEachPixel) {
    Film film({{3, 5}, {6, 7}});
    film.add(3, 5, 0, {1, 2, 3}, nullptr);
    film.add(3, 5, 1, {3, 2, 1}, nullptr);
    film.add(5, 6, 0, {0.5f, 0, 8}, nullptr);
    image::Image const mean = film.mean();
    ASSERT_EQ(mean.width, 3);
    ASSERT_EQ(mean.height, 2);
    ASSERT_EQ(mean.channels, 3);
    EXPECT_EQ(mean.at(0, 0, 0), 2);
    EXPECT_EQ(mean.at(0, 0, 2), 2);
    EXPECT_EQ(mean.at(2, 1, 0), 0.5f);
    EXPECT_EQ(mean.at(2, 1, 2), 8);
    EXPECT_EQ(mean.at(1, 1, 1), 0) << "no sample yet";
    EXPECT_EQ(film.mean(5, 6), Color(0.5f, 0, 8));
    EXPECT_EQ(film.least_samples(), 0u);
}

TEST(Film, SumsKeepSmallSamplesAmongMany) {
    // A float sum would stop growing at 2^24.
    Film film({{0, 0}, {1, 1}});
    for (uint32_t i = 0; i < 3; ++i) film.add(0, 0, i, Color(1e8f), nullptr);
    for (uint32_t i = 0; i < 1021; ++i) film.add(0, 0, 3 + i, Color(1), nullptr);
    EXPECT_EQ(film.mean(0, 0).r, float((3e8 + 1021) / 1024));
    EXPECT_EQ(film.counts(0, 0).all, 1024u);
}

TEST(Film, OfBeautyAloneTakesNoMoreThanItsSums) {
    EXPECT_EQ(Film::bytes_per_pixel(Layout()), 3 * sizeof(double) + 2 * sizeof(uint32_t));
}

TEST(Film, HalvesAndSquaresGiveErrors) {
    LayoutOptions options;
    options.half_sums = options.squares = true;
    Film film({{0, 0}, {1, 1}}, Layout({}, options));
    std::vector<double> values{1, 2, 4, 1, 3, 7, 2};
    double sum = 0, squares = 0, even = 0, odd = 0;
    for (uint32_t i = 0; i < values.size(); ++i) {
        film.add(0, 0, i, Color(float(values[i])), nullptr);
        sum += values[i];
        squares += values[i] * values[i];
        (i % 2 == 0 ? even : odd) += values[i];
    }
    EXPECT_EQ(film.counts(0, 0), (Film::Counts{7, 4}));
    EXPECT_FLOAT_EQ(film.mean(0, 0).g, float(sum / 7));
    EXPECT_FLOAT_EQ(film.even_mean(0, 0).g, float(even / 4));
    EXPECT_FLOAT_EQ(film.odd_mean(0, 0).g, float(odd / 3));
    EXPECT_FLOAT_EQ(film.variance(0, 0).b, float((squares / 7 - sum * sum / 49) / 6));
    EXPECT_FLOAT_EQ(film.error(0, 0),
                    float(3 * std::abs(sum / 7 - even / 4) / std::sqrt(3 * sum / 7)));
}

TEST(Film, VarianceIsThatOfTheMean) {
    // Of n samples, uniform in [0, 1): 1 / (12 n).
    LayoutOptions options;
    options.squares = true;
    Film film({{0, 0}, {1, 1}}, Layout({}, options));
    Rng rng(5);
    constexpr uint32_t n = 20000;
    for (uint32_t i = 0; i < n; ++i) film.add(0, 0, i, Color(rng.next()), nullptr);
    // The sample variance of a uniform distribution has a relative deviation of sqrt(0.8 / n).
    EXPECT_NEAR(double(film.variance(0, 0).r) * 12 * n, 1, 4 * std::sqrt(0.8 / n));
}

TEST(Layout, NamesEveryChannelOnce) {
    std::vector<Aov> all;
    for (size_t i = 0; i < kAovCount; ++i) all.push_back(Aov(i));
    LayoutOptions options;
    options.light_groups = {"default", "key"};
    Layout const layout(all, options);
    std::vector<std::string> names = layout.channel_names();
    Film const film({{0, 0}, {2, 2}}, layout);
    EXPECT_EQ(film.image().channels, int(names.size()));
    std::sort(names.begin(), names.end());
    EXPECT_EQ(std::adjacent_find(names.begin(), names.end()), names.end());
    for (char const* name :
         {"R", "A", "Z", "P.X", "N.Z", "Ng.Y", "UV.U", "albedo.R", "light_default.R", "light_key.B",
          "CryptoObject00.R", "CryptoObject02.A", "sample_count", "variance.G", "removed.R"})
        EXPECT_TRUE(std::binary_search(names.begin(), names.end(), name)) << name;
    EXPECT_EQ(layout.aovs(), all);
}

TEST(Layout, OfBeautyAloneNeedsNoRecord) {
    EXPECT_FALSE(Layout().needs_record());
    EXPECT_EQ(Layout().channel_names(), (std::vector<std::string>{"R", "G", "B"}));
    EXPECT_FALSE(Layout(std::vector{Aov::sample_count, Aov::variance}, {}).needs_record());
    EXPECT_TRUE(Layout(std::vector{Aov::uv}, {}).needs_record());
}

SceneTags test_tags() {
    SceneTags tags;
    tags.layers = {"default", "paint"};
    tags.light_groups = {"default", "key"};
    tags.group_of_light = {0, 1, 1};
    tags.group_of_object = {0, 1, 0};
    for (size_t k = 0; k < kCryptomattes; ++k)
        for (uint32_t i = 0; i < 3; ++i)
            tags.cryptomattes[k].id_of_object.push_back(0x3f000000u + 16 * uint32_t(k) + i);
    return tags;
}

/// A film of everything, with samples [from, to) of a made-up scene.
Film made_up_film(Region const& region, Region const& part, uint32_t from, uint32_t to) {
    std::vector<Aov> all;
    for (size_t i = 0; i < kAovCount; ++i) all.push_back(Aov(i));
    SceneTags const tags = test_tags();
    LayoutOptions options;
    options.light_groups = tags.light_groups;
    options.layers = tags.layers;
    options.half_sums = true;
    Film film(region, Layout(all, options));
    SampleRecord record(film.layout(), tags);
    for (int y = part.from.y; y < part.to.y; ++y)
        for (int x = part.from.x; x < part.to.x; ++x)
            for (uint32_t s = from; s < to; ++s) {
                Rng rng(hash64(uint64_t(x) << 40 ^ uint64_t(y) << 20 ^ s));
                record.clear();
                SampleSink sink(&record);
                PathSignature path;
                // Dyadic numbers, whose sums have no rounding.
                auto const number = [&] { return float(rng.next_uint() % 1024) / 64; };
                sink.add({Color(number()), int32_t(rng.next_uint() % 3), path});
                path.append({ScatteringKind::Diffuse});
                record.add_share(RayKind::diffuse, 0, Color(0.5f));
                record.add_share(RayKind::glossy, 1, Color(0.25f));
                record.add_share(RayKind::transmission, 0, Color(0.25f));
                sink.add({Color(number()), -1, path, int32_t(rng.next_uint() % 3)});
                if (rng.next() < 0.7f) {
                    record.meet_surface(rng.next_uint() % 3);
                    record.set(Aov::depth, number());
                    record.set(Aov::position, Vec3(number()));
                    record.set(Aov::uv, Vec2(number(), 1));
                    record.set(Aov::albedo, Color(0.5f));
                }
                record.finish();
                film.add(x, y, s, sink.beauty(), &record);
            }
    return film;
}

TEST(FilmState, RoundTripsToTheBit) {
    Region const region{{2, 1}, {9, 6}};
    Film const film = made_up_film(region, region, 0, 5);
    std::string const state = film.write_state();
    Film const back = Film::read_state(state);
    EXPECT_TRUE(back == film);
    EXPECT_EQ(back.write_state(), state);
    EXPECT_EQ(Film::read_state(Film().write_state()).region().width(), 0);
}

TEST(FilmState, OtherBytesAreAnError) {
    Region const region{{0, 0}, {3, 2}};
    std::string const state = made_up_film(region, region, 0, 3).write_state();
    for (size_t size = 0; size < state.size(); size += 7)
        EXPECT_THROW(Film::read_state(std::string_view(state).substr(0, size)), InputError);
    EXPECT_THROW(Film::read_state(state + "x"), InputError);
    // Any byte may be wrong: an error or another film, but nothing worse.
    for (size_t i = 0; i < std::min(state.size(), size_t(3000)); ++i) {
        std::string bad = state;
        bad[i] = char(bad[i] ^ 0x55);
        try {
            Film::read_state(bad);
        } catch (InputError const&) {
        }
    }
}

TEST(FilmMerge, OfTilesAndOfSamplesIsTheWhole) {
    Region const region{{2, 1}, {9, 6}};
    Film const whole = made_up_film(region, region, 0, 8);
    Film tiles(region, whole.layout());
    for (Region const& tile :
         {Region{{2, 1}, {5, 6}}, Region{{5, 1}, {9, 4}}, Region{{5, 4}, {9, 6}}})
        tiles.merge(made_up_film(tile, tile, 0, 8));
    EXPECT_TRUE(tiles == whole);
    Film samples = made_up_film(region, region, 5, 8);
    samples.merge(made_up_film(region, region, 0, 5));
    EXPECT_TRUE(samples == whole);
}

TEST(FilmMerge, OfOtherFilmsIsAnError) {
    Film film({{0, 0}, {4, 4}});
    EXPECT_THROW(film.merge(Film({{0, 0}, {5, 4}})), InputError);
    EXPECT_THROW(film.merge(Film({{0, 0}, {4, 4}}, Layout(std::vector{Aov::albedo}, {}))),
                 InputError);
}

TEST(Film, KeepsWhatIsNearestAndRanksIds) {
    SceneTags const tags = test_tags();
    Film film({{0, 0}, {1, 1}},
              Layout(std::vector{Aov::depth, Aov::position, Aov::crypto_object}, {}));
    SampleRecord record(film.layout(), tags);
    uint32_t index = 0;
    for (uint32_t object : {1u, 2u, 2u, 0u, 2u, 1u, 9u}) {
        record.clear();
        if (object < 9) {
            record.meet_surface(object);
            record.set(Aov::depth, 5.f - float(object));
            record.set(Aov::position, Vec3(float(object)));
            record.set(Aov::albedo, Color(1)); // nobody has asked for it
        }
        ASSERT_TRUE(record.finish());
        film.add(0, 0, index++, Color(1), &record);
    }
    image::Image const image = film.image();
    auto const value = [&](std::string const& name) {
        auto const at = std::find(image.names.begin(), image.names.end(), name);
        return image.pixels[size_t(at - image.names.begin())];
    };
    EXPECT_EQ(value("Z"), 3);
    EXPECT_EQ(value("P.Y"), 2);
    EXPECT_EQ(std::bit_cast<uint32_t>(value("CryptoObject00.R")), 0x3f000002u);
    EXPECT_EQ(value("CryptoObject00.G"), float(3 / 7.0));
    EXPECT_EQ(std::bit_cast<uint32_t>(value("CryptoObject00.B")), 0x3f000001u);
    EXPECT_EQ(value("CryptoObject01.G"), float(1 / 7.0));
    EXPECT_EQ(value("CryptoObject01.A"), 0);
    EXPECT_EQ(value("CryptoObject02.R"), 0);
}

TEST(Film, WithoutSurfacesHasTheEmptyDepth) {
    Film const film({{0, 0}, {1, 1}}, Layout(std::vector{Aov::depth}, {}));
    EXPECT_EQ(film.image().pixels[3], kNoDepth);
}

TEST(PathSignature, TellsTheFirstSixteenBounces) {
    PathSignature path;
    EXPECT_EQ(path.length(), 0u);
    EXPECT_FALSE(path[0]);
    auto const scattering = [](uint32_t i) {
        return Scattering{ScatteringKind(i % 6), i % 4 == 1};
    };
    for (uint32_t i = 0; i < 20; ++i) path.append(scattering(i));
    EXPECT_EQ(path.length(), 20u);
    for (uint32_t i = 0; i < 16; ++i) EXPECT_EQ(path[i], scattering(i));
    for (uint32_t i : {16u, 19u, 64u, 1u << 30}) EXPECT_FALSE(path[i]);
}

TEST(SampleSink, AddsUp) {
    SampleSink sink;
    PathSignature path;
    sink.add({Color(1, 2, 3), 0, path});
    path.append({ScatteringKind::Diffuse});
    sink.add({Color(0.5f), -1, path});
    EXPECT_EQ(sink.beauty(), Color(1.5f, 2.5f, 3.5f));
}

/// The value of an AOV's first number in a record.
float first_value(SampleRecord const& record, Aov aov) {
    return record.values()[size_t(record.layout().offset(aov) - record.layout().first_recorded())];
}

TEST(SampleRecord, TellsLightApart) {
    std::vector<Aov> all;
    for (size_t i = 0; i < kAovCount; ++i) all.push_back(Aov(i));
    SceneTags const tags = test_tags();
    LayoutOptions options;
    options.light_groups = tags.light_groups;
    options.layers = tags.layers;
    Layout const layout(all, options);
    SampleRecord record(layout, tags);
    SampleSink sink(&record);
    PathSignature path;
    sink.add({Color(1), -1, path, 1});                      // an emissive object
    sink.add({Color(2), 0, path, -1, Found::InBackground}); // the background
    record.add_share(RayKind::diffuse, 0, Color(0.25f));
    record.add_share(RayKind::glossy, 1, Color(0.75f));
    sink.add({Color(4), 1, path, -1, Found::BySampling}); // a light sampled at the first surface
    path.append({ScatteringKind::Glossy});
    sink.add({Color(8), 2, path, 2});
    sink.add({Color(16), 2, path, -1, Found::BySampling});
    record.set(Aov::removed, Color(32));
    ASSERT_TRUE(record.finish());
    EXPECT_EQ(first_value(record, Aov::emission), 1);
    EXPECT_EQ(first_value(record, Aov::background), 2);
    EXPECT_EQ(first_value(record, Aov::direct_diffuse), 3);
    EXPECT_EQ(first_value(record, Aov::direct_specular), 9);
    EXPECT_EQ(first_value(record, Aov::indirect_diffuse), 4);
    EXPECT_EQ(first_value(record, Aov::indirect_specular), 12);
    EXPECT_EQ(first_value(record, Aov::light_groups), 2);
    EXPECT_EQ(
        record.values()[size_t(layout.offset(Aov::light_groups) - layout.first_recorded() + 3)],
        1 + 4 + 8 + 16);
    EXPECT_EQ(first_value(record, Aov::layers), 1 + 2 + 0.25f * (4 + 8 + 16));
    EXPECT_EQ(record.values()[size_t(layout.offset(Aov::layers) - layout.first_recorded() + 3)],
              0.75f * (4 + 8 + 16));
    EXPECT_EQ(first_value(record, Aov::removed), 32);
    EXPECT_EQ(sink.beauty(), Color(31));
    auto const sum = [&] {
        return std::accumulate(record.values().begin(), record.values().end(), 0.f);
    };
    record.clear();
    EXPECT_EQ(sum(), 1);
    EXPECT_EQ(first_value(record, Aov::alpha), 1) << "until the path sees the background";
    record.set_guides(Color(NAN), Vec3(0));
    EXPECT_FALSE(record.finish());
    EXPECT_EQ(sum(), 0);
}

TEST(SampleRecord, TakesASurfaceBack) {
    Layout const layout(
        std::vector{Aov::normal, Aov::albedo, Aov::denoise_albedo, Aov::depth, Aov::crypto_object},
        {});
    SceneTags const tags = test_tags();
    SampleRecord record(layout, tags);
    record.meet_surface(2);
    record.set(Aov::normal, Vec3(1));
    record.set(Aov::albedo, Color(2));
    record.set(Aov::depth, 3.f);
    record.set_guides(Color(4), Vec3(5));
    record.set_guides(Color(6), Vec3(7));
    ASSERT_TRUE(record.nearest());
    EXPECT_EQ(record.nearest()->front(), 3);
    EXPECT_EQ(record.cryptomatte_id(0), 0x3f000002u);
    EXPECT_EQ(first_value(record, Aov::normal), 1);
    EXPECT_EQ(first_value(record, Aov::albedo), 2);
    record.forget_surface();
    EXPECT_FALSE(record.nearest());
    EXPECT_EQ(record.cryptomatte_id(0), 0u);
    EXPECT_EQ(first_value(record, Aov::normal), 0);
    EXPECT_EQ(first_value(record, Aov::albedo), 0);
    EXPECT_EQ(first_value(record, Aov::denoise_albedo), 4) << "of another surface, perhaps";
}

} // namespace
} // namespace weft::film
