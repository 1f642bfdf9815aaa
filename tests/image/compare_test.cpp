#include "image/compare.h"

#include <gtest/gtest.h>

#include <limits>

using namespace weft;
using namespace weft::image;

namespace {

Image make(int width, int channels, std::vector<float> pixels) {
    Image image = make_image(width, 1, channels);
    image.pixels = std::move(pixels);
    return image;
}

TEST(Compare, MatchesSumsByHand) {
    Image const a = make(2, 1, {1, 4}), b = make(2, 1, {2, 1});
    Difference const d = compare(a, b);
    EXPECT_DOUBLE_EQ(d.mse, (1 + 9) / 2.0);
    EXPECT_DOUBLE_EQ(d.rel_mse, (1 / 4.01 + 9 / 1.01) / 2);
    EXPECT_DOUBLE_EQ(d.mae, 2);
    EXPECT_DOUBLE_EQ(d.me, 1);
    EXPECT_DOUBLE_EQ(d.max, 3);
    EXPECT_EQ(d.non_finite, 0u);
}

TEST(Compare, SignedErrorCancelsWhereAbsoluteErrorDoesNot) {
    Image const a = make(1, 3, {1, 0, 0.5f}), b = make(1, 3, {0, 1, 0.5f});
    Difference const d = compare(a, b);
    EXPECT_DOUBLE_EQ(d.me, 0);
    EXPECT_DOUBLE_EQ(d.mae, 2 / 3.0);
}

TEST(Compare, AlphaIsLeftOut) {
    Image const a = make(1, 4, {1, 2, 3, 0}), b = make(1, 4, {1, 2, 3, 1}),
                c = make(1, 3, {1, 2, 3});
    EXPECT_EQ(compare(a, b).max, 0);
    EXPECT_EQ(compare(a, c).max, 0);
    EXPECT_EQ(compare(make(1, 2, {1, 0}), make(1, 1, {1})).max, 0);
}

TEST(Compare, NonFiniteValuesAreCountedAndLeftOut) {
    float const nan = std::numeric_limits<float>::quiet_NaN();
    float const inf = std::numeric_limits<float>::infinity();
    Difference const d = compare(make(1, 3, {nan, 2, 0}), make(1, 3, {1, 1, inf}));
    EXPECT_EQ(d.non_finite, 2u);
    EXPECT_DOUBLE_EQ(d.mse, 1);
    EXPECT_EQ(compare(make(1, 1, {nan}), make(1, 1, {1})).non_finite, 1u);
}

TEST(Compare, AnImageOfEqualPixelsInBothHasNoError) {
    Image const a = make(2, 3, {0, 1, 2, 3, 4, 5});
    Difference const d = compare(a, a);
    EXPECT_EQ(d.mse, 0);
    EXPECT_EQ(d.rel_mse, 0);
    EXPECT_EQ(d.mae, 0);
}

TEST(Compare, DifferentShapesAreRefused) {
    EXPECT_THROW(compare(make_image(2, 1, 3), make_image(1, 2, 3)), InputError);
    EXPECT_THROW(compare(make_image(2, 2, 3), make_image(2, 2, 1)), InputError);
    EXPECT_THROW(difference_image(make_image(2, 2, 3), make_image(2, 3, 3)), InputError);
    try {
        compare(make_image(2, 1, 3), make_image(4, 1, 4));
        FAIL();
    } catch (InputError const& e) {
        EXPECT_STREQ(e.what(),
                     "images differ in shape: expected 4 x 1 pixels of 3 colour channels, "
                     "found 2 x 1 pixels of 3 colour channels");
    }
}

TEST(Compare, DifferenceImageIsSigned) {
    Image const d = difference_image(make(1, 4, {1, 2, 3, 9}), make(1, 3, {2, 2, 1}));
    EXPECT_EQ(d.channels, 3);
    EXPECT_EQ(d.pixels, (std::vector<float>{-1, 0, 2}));
}

TEST(Compare, AllOtherChannelsAreComparedByName) {
    float const inf = std::numeric_limits<float>::infinity();
    Image a = make(2, 6, {1, 2, 3, 1, 3, 0.5f, 1, 2, 3, 1, inf, 0.5f}),
          b = make(2, 6, {7, 1, 2, 3, 0, 5, 7, 1, 2, 3, 0, inf});
    a.names = {"R", "G", "B", "A", "Z", "noise"};
    b.names = {"id", "R", "G", "B", "A", "Z"}; // colours need not come first
    EXPECT_EQ(compare(a, b).max, 0);
    auto const others = compare_channels(a, b);
    ASSERT_EQ(others.size(), 4u);
    EXPECT_EQ(others[0].name, "id");
    EXPECT_FALSE(others[0].in_image);
    EXPECT_EQ(others[1].name, "A");
    EXPECT_EQ(others[1].difference.max, 1);
    EXPECT_EQ(others[2].name, "Z");
    EXPECT_EQ(others[2].difference.me, -2);
    EXPECT_EQ(others[2].difference.non_finite, 0u); // both are infinitely far
    EXPECT_EQ(others[3].name, "noise");
    EXPECT_FALSE(others[3].in_reference);
    EXPECT_EQ(compare_channels(a, b, true).size(), 7u);
    EXPECT_THROW(compare_channels(a, make_image(3, 1, 4)), InputError);
}

} // namespace
