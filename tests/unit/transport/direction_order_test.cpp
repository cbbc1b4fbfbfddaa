#include "transport/direction_order.h"

#include <gtest/gtest.h>

#include <set>

namespace {

using namespace transillum;

TEST(DirectionOrder, IsTheSequencesOwnUntilShuffled) {
    DirectionOrder order(1);
    for (std::uint64_t i = 0; i < 3000; ++i) EXPECT_EQ(order.at(i), i);
    order.shuffle(0);
    order.unshuffle(0);
    for (std::uint64_t i = 0; i < 3000; ++i) EXPECT_EQ(order.at(i), i);
}

TEST(DirectionOrder, TakesEveryDirectionOfABlockOnce) {
    DirectionOrder order(3);
    order.shuffle(0);
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

// A run that begins or ends to be shuffled amid a block takes every direction once all the same.
TEST(DirectionOrder, LosesNoneWhereItChanges) {
    for (const std::uint64_t from : {0, 128, 192, 384, 600}) {
        DirectionOrder order(5);
        std::set<std::uint64_t> taken;
        for (std::uint64_t i = 0; i < 2048; ++i) {
            if (i == from) order.shuffle(i);
            if (i == from + 128) order.unshuffle(i);
            taken.insert(order.at(i));
        }
        EXPECT_EQ(taken.size(), 2048u) << from;
        EXPECT_EQ(*taken.rbegin(), 2047u) << from;
        EXPECT_EQ(order.at(1500), 1500u) << from;
    }
}

TEST(DirectionOrder, IsEvenAtTheEndsOfBlocks) {
    DirectionOrder order(1);
    EXPECT_TRUE(order.is_even(300));
    order.shuffle(256);
    EXPECT_TRUE(order.is_even(200));
    EXPECT_TRUE(order.is_even(512));
    EXPECT_FALSE(order.is_even(300));
    EXPECT_TRUE(order.is_even(3072));
    EXPECT_FALSE(order.is_even(2560));
}

TEST(DirectionOrder, LeavesFewDirectionsWhereTheyWere) {
    DirectionOrder order(3), other(4);
    order.shuffle(0);
    other.shuffle(0);
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
