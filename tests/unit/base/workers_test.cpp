#include <transillum/base/error.h>
#include <transillum/base/parallel.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

namespace transillum {
namespace {

class WorkersOf : public testing::TestWithParam<int> {};

TEST_P(WorkersOf, MeetEveryIndexOnce) {
    const Workers workers(GetParam());
    EXPECT_EQ(workers.count(), GetParam());
    for (const std::size_t n : {0u, 1u, 7u, 1000u, 100003u})
        for (const std::size_t grain : {0u, 1u, 64u, 1000000u}) {
            if (n > 1000 && grain < 2) continue;
            std::vector<std::atomic<int>> met(n);
            workers.for_ranges(n, grain, [&](std::size_t begin, std::size_t end, int) {
                for (std::size_t i = begin; i < end; ++i) ++met[i];
            });
            for (std::size_t i = 0; i < n; ++i) ASSERT_EQ(met[i], 1) << i << " of " << n;
        }
}

TEST_P(WorkersOf, NeverShareANumber) {
    const Workers workers(GetParam());
    std::vector<std::atomic<int>> inside(GetParam());
    std::atomic<int> shared = 0, outside = 0;
    workers.for_ranges(2000, 1, [&](std::size_t, std::size_t, int worker) {
        if (worker < 0 || worker >= GetParam()) {
            ++outside;
            return;
        }
        if (++inside[worker] != 1) ++shared;
        std::this_thread::yield();
        --inside[worker];
    });
    EXPECT_EQ(outside, 0);
    EXPECT_EQ(shared, 0);
}

TEST_P(WorkersOf, PassExceptionsAndGoOn) {
    const Workers workers(GetParam());
    const auto fail_at = [&](std::size_t bad) {
        workers.for_ranges(100, 1, [&](std::size_t begin, std::size_t, int) {
            if (begin == bad) throw std::runtime_error("item " + std::to_string(bad));
        });
    };
    for (const std::size_t bad : {0u, 42u, 99u}) {
        try {
            fail_at(bad);
            FAIL() << "the exception was lost";
        } catch (const std::runtime_error& e) {
            EXPECT_EQ(std::string(e.what()), "item " + std::to_string(bad));
        }
    }
    EXPECT_NO_THROW(fail_at(100));
}

INSTANTIATE_TEST_SUITE_P(Threads, WorkersOf, testing::Values(1, 2, 8));

TEST(Workers, ZeroTakesWhatTheMachineHas) {
    EXPECT_EQ(Workers(0).count(),
              std::max(1, static_cast<int>(std::thread::hardware_concurrency())));
}

TEST(Workers, RefuseCountsOutsideTheirRange) {
    EXPECT_THROW(Workers(-1), UsageError);
    EXPECT_THROW(Workers(1025), UsageError);
    try {
        Workers w(-3);
        FAIL();
    } catch (const UsageError& e) {
        EXPECT_NE(std::string(e.what()).find("-3"), std::string::npos);
        EXPECT_NE(std::string(e.what()).find("1024"), std::string::npos);
    }
}

TEST(Workers, CanBeMovedAndCalledByOthers) {
    Workers first(2);
    const Workers second = std::move(first);
    std::atomic<int> sum = 0;
    second.for_ranges(10, 1, [&](std::size_t begin, std::size_t end, int) {
        // A visitor may itself have work for another set.
        Workers(1).for_ranges(end - begin, 1, [&](std::size_t b, std::size_t e, int worker) {
            EXPECT_EQ(worker, 0);
            sum += static_cast<int>(e - b);
        });
    });
    EXPECT_EQ(sum, 10);
}

}  // namespace
}  // namespace transillum
