// Form factors through the whole transport: between black surfaces, what arrives is the factor.
#include "physics/transport_runs.h"

#include <gtest/gtest.h>

namespace {

using namespace transillum;
using namespace transillum::testing_support;

struct Case {
    const char* name;
    Outline receiver, emitter;
    double factor;
};

void PrintTo(const Case& c, std::ostream* out) {
    *out << c.name;
}

/// A square or rectangle facing up at z = 0, and one facing down above it.
Outline below(double a, double b) {
    return {{0, 0, 0}, {a, 0, 0}, {a, b, 0}, {0, b, 0}};
}
Outline above(double a, double b, double z) {
    return {{0, 0, z}, {0, b, z}, {a, b, z}, {a, 0, z}};
}

class FormFactor : public testing::TestWithParam<Case> {};

TEST_P(FormFactor, AgreesWithTheClosedForm) {
    const Case& c = GetParam();
    SceneBuilder b;
    b.polygon(c.receiver, b.material(Spectrum(0.0f)));
    b.polygon(c.emitter, b.material(Spectrum(0.0f), Spectrum(1.0f)));
    const TransportRun run = run_transport(b.scene, {.directions = 4096, .leaves = 200});
    const double received =
        run.mean_incoming([](std::uint32_t root, bool back) { return root < 2 && !back; });
    EXPECT_NEAR(received / c.factor, 1.0, 0.01);
}

INSTANTIATE_TEST_SUITE_P(
    Rectangles, FormFactor,
    testing::Values(
        Case{"parallel at 1", below(1, 1), above(1, 1, 1), 0.1998249},
        Case{"parallel at 0.5", below(1, 1), above(1, 1, 0.5), 0.4152533},
        Case{"parallel at 2", below(1, 1), above(1, 1, 2), 0.0685896},
        Case{"perpendicular", below(1, 1), {{0, 0, 0}, {0, 1, 0}, {0, 1, 1}, {0, 0, 1}}, 0.2000438},
        Case{"1 x 2 at 0.5", below(1, 2), above(1, 2, 0.5), 0.5089887}));

}  // namespace
