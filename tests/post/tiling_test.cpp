#include <gtest/gtest.h>

#include "post/tiling.h"

namespace weft::post {
namespace {

void check(AxisTiling const& axis, int length, TilingRules const& rules) {
    ASSERT_FALSE(axis.windows.empty());
    EXPECT_EQ(axis.size % rules.alignment, 0);
    EXPECT_EQ(axis.windows.front().begin, 0);
    EXPECT_EQ(axis.windows.front().from, 0);
    EXPECT_EQ(axis.windows.back().to, length);
    int const whole = (length + rules.alignment - 1) / rules.alignment * rules.alignment;
    EXPECT_EQ(axis.windows.back().begin + axis.size, whole) << "the last one ends with the picture";
    for (size_t i = 0; i < axis.windows.size(); ++i) {
        Window const& w = axis.windows[i];
        EXPECT_EQ(w.begin % rules.alignment, 0);
        EXPECT_LT(w.from, w.to);
        if (i > 0) {
            EXPECT_EQ(w.from, axis.windows[i - 1].to);
            EXPECT_GE(w.from - w.begin, rules.reach);
            EXPECT_GE(axis.windows[i - 1].begin + axis.size - w.from, rules.reach);
        }
    }
}

TEST(Tiling, CoversEveryPixelOnceAndKeepsItsDistance) {
    TilingRules const rules;
    for (int length : {1, 15, 16, 17, 200, 431, 1000, 1920, 2224, 3840, 3904, 20000})
        for (int count : {1, 2, 3, 5, 8, 21}) {
            SCOPED_TRACE(std::to_string(length) + " in " + std::to_string(count));
            check(tile_axis(length, count, rules), length, rules);
        }
}

TEST(Tiling, KeepsBelowTheLimitWithFewPixels) {
    TilingRules const rules;
    auto memory = [](int width, int height) { return size_t(width) * size_t(height) * 400; };
    auto tiling = [&](size_t limit) { return tile_picture(3840, 2160, rules, limit, memory); };
    Tiling const whole = tiling(size_t(8) << 30);
    EXPECT_EQ(whole.x.windows.size() * whole.y.windows.size(), 1u);
    double last = 1;
    for (size_t megabytes : {2048, 1024, 512, 256, 128}) {
        Tiling const t = tiling(megabytes << 20);
        SCOPED_TRACE(megabytes);
        check(t.x, 3840, rules);
        check(t.y, 2160, rules);
        EXPECT_LE(memory(t.x.size, t.y.size), megabytes << 20);
        double const work = double(t.x.size) * double(t.x.windows.size()) * double(t.y.size) *
                            double(t.y.windows.size()) / (3840.0 * 2160);
        EXPECT_GE(work, last);
        EXPECT_LT(work, 4);
        last = work;
    }
    EXPECT_TRUE(tiling(1 << 20).x.windows.empty()) << "no window is that small";
}

} // namespace
} // namespace weft::post
