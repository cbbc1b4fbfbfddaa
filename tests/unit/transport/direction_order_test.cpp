#include "transport/direction_order.h"

#include <gtest/gtest.h>

#include <set>

namespace {

using namespace transillum;

TEST(DirectionOrder, IsTheSequencesOwnUntilShuffled) {
    DirectionOrder order(1);
    for (std::uint64_t i = 0; i < 3000; ++i) EXPECT_EQ(order.at(i), i);
    order.shuffle();
    order.unshuffle();
    for (std::uint64_t i = 0; i < 3000; ++i) EXPECT_EQ(order.at(i), i);
}

TEST(DirectionOrder, TakesEveryDirectionOfABlockOnce) {
    DirectionOrder order(3);
    order.shuffle();
    std::set<std::uint64_t> taken;
    for (std::uint64_t i = 0; i < 4096; ++i) {
        taken.insert(order.at(i));
        // At the ends of power-of-two blocks, the sequence has been taken up to there.
        const bool is_end = i + 1 == 128 || i + 1 == 256 || i + 1 == 512 || (i + 1) % 1024 == 0;
        if (is_end) {
            EXPECT_EQ(*taken.rbegin(), i) << "of " << taken.size();
        }
    }
    EXPECT_EQ(taken.size(), 4096u);
}

TEST(DirectionOrder, LeavesFewDirectionsWhereTheyWere) {
    DirectionOrder order(3), other(4);
    order.shuffle();
    other.shuffle();
    int in_place = 0, followers = 0, alike = 0;
    for (std::uint64_t i = 1; i < 1024; ++i) {
        in_place += order.at(i) == i;
        followers += order.at(i) == order.at(i - 1) + 1;
        alike += order.at(i) == other.at(i);
    }
    // One each a block is to be expected.
    EXPECT_LT(in_place, 16);
    EXPECT_LT(followers, 16);
    EXPECT_LT(alike, 16);
}

}  // namespace
