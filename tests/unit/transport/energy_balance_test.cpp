// Infinite parallel plates: two patches that see nothing but each other. B1 = M / (1 - rho1 rho2),
// B2 = rho2 B1.
#include "transport/energy_balance.h"

#include <transillum/base/error.h>

#include <gtest/gtest.h>

namespace {

using namespace transillum;

/// Two triangles that face each other, their fronts in a cluster each, their backs in a third that
/// nothing reaches.
class Plates : public testing::Test {
protected:
    Plates() {
        mesh_.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {0, 1, 1}};
        mesh_.triangles.resize(2);
        mesh_.triangles[0].vertices = {0, 1, 2};  // faces up
        mesh_.triangles[1].vertices = {3, 5, 4};  // faces down
        patches_ = subdivide_to_levels({0, 0});
        clusters_ = {3, {0, 1, 2, 2, 3}};
        sources_.emission = {Spectrum(1.0f), Spectrum(0.0f), Spectrum(0.0f), Spectrum(0.0f)};
        sources_.direct.assign(4, Spectrum(0.0f));
    }

    /// Mean radiance arriving at the second plate after one transfer straight up and the balance.
    double arriving_at_second(float albedo_1, float albedo_2, BalanceShape shape,
                              double escaping = 0.0) {
        sources_.albedo = {Spectrum(albedo_1), Spectrum(albedo_2), Spectrum(0.0f), Spectrum(0.0f)};
        FiniteElementComponent component(mesh_, patches_, sources_, workers_);
        TransilluminationBuffer buffer(mesh_, patches_, 0.01);
        Exchange exchange(patches_.leaf_count, clusters_, workers_);
        component.send(exchange, 0.0f, 1e6);
        exchange.transfer(buffer, Bundle{});
        component.average_in(exchange, 1, 1.0);
        ClusterTransfer transfer(clusters_.count);
        const double across = 100.0 * (1.0 - escaping);
        transfer.at(1, 0) = {SpectrumSum(across), across};
        transfer.at(0, 1) = {SpectrumSum(0.5 * across), across};
        transfer.at(3, 0) = {SpectrumSum(100.0 * escaping), 100.0 * escaping};
        transfer.at(3, 1) = {SpectrumSum(50.0 * escaping), 100.0 * escaping};
        balance_energy(component, clusters_, transfer, shape, 0.0f, workers_);
        return component.incoming(1).x;
    }

    SurfaceMesh mesh_;
    PatchHierarchy patches_;
    Clusters clusters_;
    PatchSources sources_;
    Workers workers_{1};
};

TEST_F(Plates, AreBalancedByOneSolve) {
    for (const BalanceShape shape : {BalanceShape::flat, BalanceShape::kept}) {
        EXPECT_NEAR(arriving_at_second(0.5f, 0.8f, shape), 1.0 / (1.0 - 0.4), 1e-6);
        EXPECT_NEAR(arriving_at_second(0.95f, 0.95f, shape), 1.0 / (1.0 - 0.9025), 1e-5);
        EXPECT_NEAR(arriving_at_second(0.0f, 0.5f, shape), 1.0, 1e-6);
    }
}

TEST_F(Plates, LoseWhatLeavesTheScene) {
    // Half of everything escapes: arriving = 1/2 (1 + 1/2 rho1 rho2 ...) = 0.5 / (1 - 0.25 rho1
    // rho2).
    EXPECT_NEAR(arriving_at_second(0.5f, 0.8f, BalanceShape::kept, 0.5), 0.5 / (1.0 - 0.25 * 0.4),
                1e-6);
}

TEST_F(Plates, ThatAbsorbNothingAreRefusedUnlessLightEscapes) {
    EXPECT_THROW((void)arriving_at_second(1.0f, 1.0f, BalanceShape::kept), UsageError);
    EXPECT_NEAR(arriving_at_second(1.0f, 1.0f, BalanceShape::kept, 0.5), 0.5 / 0.75, 1e-6);
}

}  // namespace
