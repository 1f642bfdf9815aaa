#include <gtest/gtest.h>

#include "film/contribution.h"
#include "film/film.h"

namespace weft::film {
namespace {

TEST(Film, GivesTheMeanOfEachPixel) {
    Film film({{3, 5}, {6, 7}});
    film.pixel(3, 5).add({1, 2, 3});
    film.pixel(3, 5).add({3, 2, 1});
    film.pixel(5, 6).add({0.5f, 0, 8});
    image::Image const mean = film.mean();
    ASSERT_EQ(mean.width, 3);
    ASSERT_EQ(mean.height, 2);
    ASSERT_EQ(mean.channels, 3);
    EXPECT_EQ(mean.at(0, 0, 0), 2);
    EXPECT_EQ(mean.at(0, 0, 2), 2);
    EXPECT_EQ(mean.at(2, 1, 0), 0.5f);
    EXPECT_EQ(mean.at(2, 1, 2), 8);
    EXPECT_EQ(mean.at(1, 1, 1), 0) << "no sample yet";
}

TEST(Film, SumsKeepSmallSamplesAmongMany) {
    // A float sum would stop growing at 2^24.
    Film film({{0, 0}, {1, 1}});
    film.pixel(0, 0).add(Color(3e8f));
    for (int i = 0; i < 1000; ++i) film.pixel(0, 0).add(Color(1));
    EXPECT_EQ(film.pixel(0, 0).r, 3e8 + 1000);
    EXPECT_EQ(film.pixel(0, 0).samples, 1001u);
}

TEST(PathSignature, TellsTheFirstSixteenBounces) {
    PathSignature path;
    EXPECT_EQ(path.length(), 0u);
    EXPECT_EQ(path[0], Bounce::None);
    for (uint32_t i = 0; i < 20; ++i) path.append(Bounce(1 + i % 7));
    EXPECT_EQ(path.length(), 20u);
    for (uint32_t i = 0; i < 16; ++i) EXPECT_EQ(path[i], Bounce(1 + i % 7));
    for (uint32_t i : {16u, 19u, 64u, 1u << 30}) EXPECT_EQ(path[i], Bounce::None);
}

TEST(SampleSink, AddsUp) {
    SampleSink sink;
    PathSignature path;
    sink.add({Color(1, 2, 3), 0, path});
    path.append(Bounce::Diffuse);
    sink.add({Color(0.5f), -1, path});
    EXPECT_EQ(sink.beauty(), Color(1.5f, 2.5f, 3.5f));
}

} // namespace
} // namespace weft::film
