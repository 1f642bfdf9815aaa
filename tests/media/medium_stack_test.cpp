// Nested dielectrics, told as walks through glasses.
#include <gtest/gtest.h>

#include "media/medium_stack.h"

namespace weft::media {
namespace {

Interior interior(uint32_t object, int32_t rank, float ior = 1.5f) {
    return {object, rank, ior, int32_t(object)};
}

TEST(MediumStack, IsEmptySpaceAtFirst) {
    MediumStack const stack;
    EXPECT_EQ(stack.current().ior, 1);
    EXPECT_EQ(stack.current().medium, -1);
    EXPECT_TRUE(stack.is_visible(3, 0));
}

TEST(MediumStack, GivesBackWhatSurrounds) {
    Interior fog;
    fog.medium = 7;
    MediumStack stack(fog);
    stack.enter(interior(1, 0));
    EXPECT_EQ(stack.current().medium, 1);
    stack.leave(1);
    EXPECT_EQ(stack.current().medium, 7);
}

TEST(MediumStack, NestedObjectsAreSeenBothWays) {
    MediumStack stack;
    EXPECT_TRUE(stack.is_visible(1, 0));
    stack.enter(interior(1, 0, 1.5f));
    EXPECT_TRUE(stack.is_visible(2, 0)); // a diamond inside of the glass, of equal rank
    stack.enter(interior(2, 0, 2.4f));
    EXPECT_EQ(stack.current().object, 2u);
    EXPECT_TRUE(stack.is_visible(2, 0));
    stack.leave(2);
    EXPECT_EQ(stack.current().object, 1u);
    EXPECT_EQ(stack.current().ior, 1.5f);
    EXPECT_TRUE(stack.is_visible(1, 0));
}

TEST(MediumStack, LiquidThatReachesIntoTheGlass) {
    // air | glass [ liquid begins inside of the glass ] | liquid
    constexpr uint32_t glass = 1, liquid = 2;
    MediumStack stack;
    stack.enter(interior(glass, 10, 1.5f));
    EXPECT_FALSE(stack.is_visible(liquid, 0)); // glass goes on: nothing to see
    stack.enter(interior(liquid, 0, 1.33f));
    EXPECT_EQ(stack.current().object, glass);
    EXPECT_TRUE(stack.is_visible(glass, 10));
    stack.leave(glass);
    EXPECT_EQ(stack.current().object, liquid);
    EXPECT_EQ(stack.current().ior, 1.33f); // glass against liquid
    // And out on the other side.
    EXPECT_TRUE(stack.is_visible(glass, 10));
    stack.enter(interior(glass, 10, 1.5f));
    EXPECT_FALSE(stack.is_visible(liquid, 0));
    stack.leave(liquid);
    stack.leave(glass);
    EXPECT_EQ(stack.current().object, UINT32_MAX);
}

TEST(MediumStack, OfEqualRanksTheLastEnteredIsThere) {
    MediumStack stack;
    stack.enter(interior(1, 0));
    stack.enter(interior(2, 0));
    EXPECT_EQ(stack.current().object, 2u);
    // What is left now is not what is there, so its boundary does not show.
    EXPECT_FALSE(stack.is_visible(1, 0));
    stack.leave(1);
    EXPECT_EQ(stack.current().object, 2u);
    EXPECT_TRUE(stack.is_visible(2, 0));
}

TEST(MediumStack, OfDifferentRanksTheOrderOfEntryIsForgotten) {
    MediumStack ab, ba;
    for (uint32_t i : {1u, 2u}) ab.enter(interior(i, int32_t(i)));
    for (uint32_t i : {2u, 1u}) ba.enter(interior(i, int32_t(i)));
    EXPECT_EQ(ab.current().object, 2u);
    EXPECT_EQ(ba.current().object, 2u);
    for (MediumStack* s : {&ab, &ba}) s->leave(2);
    EXPECT_EQ(ab.current().object, ba.current().object);
}

TEST(MediumStack, SurvivesWhatIsNotClosed) {
    MediumStack stack;
    stack.leave(5); // never entered
    EXPECT_EQ(stack.current().object, UINT32_MAX);
    EXPECT_FALSE(stack.has_overflowed());
}

TEST(MediumStack, CountsHowOftenAnObjectWasEntered) {
    // Two parts of one object overlap: a ray is inside until it has left both.
    MediumStack stack;
    stack.enter(interior(1, 0));
    stack.enter(interior(1, 0));
    stack.leave(1);
    EXPECT_EQ(stack.current().object, 1u);
    stack.leave(1);
    EXPECT_FALSE(stack.contains(1));
    stack.enter(interior(1, 0), 3);
    EXPECT_EQ(stack.count(1), 3);
    stack.leave(1, 5); // oftener than entered
    EXPECT_EQ(stack.count(1), 0);
}

TEST(MediumStack, TellsOfWhatItForgets) {
    MediumStack stack;
    for (uint32_t i = 0; i < MediumStack::kMostObjects; ++i) stack.enter(interior(i, int32_t(i)));
    EXPECT_FALSE(stack.has_overflowed());
    EXPECT_EQ(stack.current().object, MediumStack::kMostObjects - 1);
    stack.enter(interior(99, 99));
    EXPECT_TRUE(stack.has_overflowed());
    EXPECT_EQ(stack.current().object, MediumStack::kMostObjects - 1);
    MediumStack const copy = stack;
    EXPECT_TRUE(copy.has_overflowed());
    EXPECT_TRUE(copy.contains(0));
    for (uint32_t i = 0; i < MediumStack::kMostObjects; ++i) stack.leave(i);
    EXPECT_EQ(stack.current().object, UINT32_MAX);
}

} // namespace
} // namespace weft::media
