#include "transport/exchange.h"
#include "support/scene_builder.h"

#include <gtest/gtest.h>

namespace {

using namespace transillum;
using namespace transillum::testing_support;

/// A closed room, fronts inwards, subdivided, with some radiance on every front.
class Room : public testing::Test {
protected:
    Room() {
        SceneBuilder b;
        b.box({0, 0, 0}, {1, 1, 1}, Facing::inwards);
        mesh_ = b.surface();
        patches_ = subdivide_to_levels(std::vector<int>(mesh_.triangles.size(), 3));
        radiance_.resize(patches_.patch_count());
        for (std::uint32_t p = 0; p < patches_.leaf_count; ++p)
            radiance_[p] = Spectrum(1.0f + 0.01f * static_cast<float>(p), 0.5f, 0.0f);
    }

    std::vector<Received> received_after(int directions, int threads) {
        const Workers workers(threads);
        TransilluminationBuffer buffer(mesh_, patches_, 0.005);
        Exchange exchange(patches_.leaf_count, {}, workers);
        exchange.set_radiance(radiance_, 2.0f + 0.01f * static_cast<float>(patches_.leaf_count),
                              1e9);
        for (int i = 0; i < directions; ++i)
            exchange.transfer(buffer, sample_bundle(static_cast<std::uint32_t>(i), 7));
        std::vector<Received> all(patches_.patch_count() + 1);
        for (std::uint32_t p = 0; p < all.size(); ++p) all[p] = exchange.take(p);
        return all;
    }

    SurfaceMesh mesh_;
    PatchHierarchy patches_;
    std::vector<Spectrum> radiance_;
};

TEST_F(Room, ReceivesExactlyWhatIsSent) {
    // Every fragment sends its radiance once: what arrives in all is what was sent in all.
    const auto received = received_after(16, 2);
    SpectrumSum sent(0.0), arrived(0.0);
    double fragments = 0.0;
    for (std::uint32_t p = 0; p < patches_.leaf_count; ++p) {
        sent += received[p].coverage * SpectrumSum(radiance_[p]);
        arrived += received[p].radiance;
        fragments += received[p].coverage;
    }
    ASSERT_GT(fragments, 1e5);
    EXPECT_NEAR(arrived.x / sent.x, 1.0, 1e-9);
    EXPECT_NEAR(arrived.y / fragments, 0.5, 1e-9);
    EXPECT_EQ(arrived.z, 0.0);
}

TEST_F(Room, KeepsItsOutsideDarkAndItsInsideClosed) {
    const auto received = received_after(64, 2);
    for (std::uint32_t p = patches_.leaf_count; p < patches_.patch_count(); ++p)
        EXPECT_EQ(received[p].radiance, SpectrumSum(0.0));
    EXPECT_EQ(received.back().radiance, SpectrumSum(0.0)) << "light left a closed room";
}

TEST_F(Room, GivesTheSameBitsForAnyThreads) {
    const auto one = received_after(5, 1);
    for (const int threads : {2, 8}) {
        const auto many = received_after(5, threads);
        for (std::size_t p = 0; p < one.size(); ++p) {
            EXPECT_EQ(one[p].radiance, many[p].radiance);
            EXPECT_EQ(one[p].coverage, many[p].coverage);
        }
    }
}

}  // namespace
