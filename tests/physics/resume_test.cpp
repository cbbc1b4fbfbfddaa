// Validation H: so many directions, and then more, are as all of them at once, to the last bit.
#include "physics/transport_runs.h"

#include <transillum/transport/plain_sums.h>
#include <transillum/visibility/transillumination_buffer.h>

#include <gtest/gtest.h>

#include <cmath>

namespace {

using namespace transillum;
using namespace transillum::testing_support;

Scene glossy_cube() {
    Scene scene = cube_scene(0.3f, 1.0f, 0.0f);
    for (Material& m : scene.materials) {
        m.specular = Spectrum(0.4f);
        m.lobe = Lobe::max_phong;
        m.shininess = 10.0f;
    }
    return scene;
}

Scene open_box() {
    SceneBuilder b;
    b.box({0, 0, 0}, {1, 1, 1}, Facing::inwards, b.material({0.7f, 0.5f, 0.2f}), 1);
    b.scene.lighting.environment.kind = Environment::Kind::uniform;
    b.scene.lighting.environment.radiance_scale = {0.5f, 1.0f, 2.0f};
    return b.scene;
}

struct Case {
    const char* name;
    Scene (*scene)();
    Averaging averaging = Averaging::balanced;
};

class Resumed : public testing::TestWithParam<Case> {
protected:
    Resumed() : run_(prepare_transport(GetParam().scene(), {.leaves = 120})) {
        run_.sources.environment = GetParam().scene().lighting.environment;
    }

    /// \param start after a way through plain numbers
    [[nodiscard]] TransportResult iterate_to(std::uint64_t directions,
                                             std::shared_ptr<const IterationSums> start = {},
                                             int threads = 2) const {
        Monitor silent;
        IterationOptions options;
        options.pixel_size = pixel_size_for(run_.surface, 80);
        options.averaging = GetParam().averaging;
        if (start)
            options =
                options_to_go_on(sums_of(plain_sums(*start), run_.patches, run_.sources.glossy));
        options.iterations = directions;
        options.keep_sums = true;
        return iterate(run_.surface, run_.patches, run_.sources, options, Workers(threads), silent);
    }

    static void expect_same(const TransportResult& a, const TransportResult& b) {
        EXPECT_EQ(a.iterations, b.iterations);
        EXPECT_EQ(a.irradiance, b.irradiance);
        EXPECT_EQ(a.glossy_elements, b.glossy_elements);
        EXPECT_EQ(a.coverage, b.coverage);
        EXPECT_EQ(a.standard_error, b.standard_error);
        EXPECT_EQ(a.escaped, b.escaped);
        EXPECT_EQ(a.entered, b.entered);
        EXPECT_EQ(a.relative_error, b.relative_error);
        const PlainSums of_a = plain_sums(*a.sums), of_b = plain_sums(*b.sums);
        EXPECT_EQ(of_a.doubles.size(), of_b.doubles.size());
        for (std::size_t i = 0; i < of_a.doubles.size(); ++i) {
            const std::vector<double>&x = of_a.doubles[i].values, &y = of_b.doubles[i].values;
            // Not known yet.
            if (x.size() == 1 && y.size() == 1 && std::isnan(x[0]) && std::isnan(y[0])) continue;
            EXPECT_EQ(of_a.doubles[i], of_b.doubles[i]) << of_a.doubles[i].name;
        }
        EXPECT_EQ(of_a.floats, of_b.floats);
        EXPECT_EQ(of_a.counts, of_b.counts);
    }

    TransportRun run_;
};

INSTANTIATE_TEST_SUITE_P(
    Scenes, Resumed,
    testing::Values(Case{"Diffuse", [] { return cube_scene(0.7f, 1.0f, 0.0f); }},
                    Case{"Paper", [] { return cube_scene(0.7f, 1.0f, 0.0f); }, Averaging::paper},
                    Case{"Glossy", glossy_cube}, Case{"Environment", open_box},
                    Case{"TwoRooms", [] { return two_rooms_scene(0.8f); }}),
    [](const auto& i) { return i.param.name; });

// Powers of two, where phases end and averages are begun anew; ends of other blocks (10, 24, 160);
// and numbers that cut a block short (9, 13, 17, 63, 100, 129).
TEST_P(Resumed, AsIfNeverStopped) {
    for (const std::uint64_t whole : {20, 64, 200}) {
        const TransportResult at_once = iterate_to(whole);
        for (const std::uint64_t first :
             {1, 5, 8, 9, 10, 13, 16, 17, 24, 63, 64, 100, 128, 129, 160})
            if (first < whole) {
                SCOPED_TRACE(testing::Message() << first << " of " << whole);
                expect_same(iterate_to(whole, iterate_to(first).sums), at_once);
            }
    }
}

TEST_P(Resumed, AgainAndAgain) {
    TransportResult result = iterate_to(1);
    for (const std::uint64_t more : {3, 9, 11, 31, 33, 70, 140})
        result = iterate_to(more, result.sums, 1);
    expect_same(result, iterate_to(140));
}

TEST_P(Resumed, WithoutAnotherDirectionIsTheSame) {
    for (const std::uint64_t directions : {7, 9, 64, 65, 150}) {
        const TransportResult once = iterate_to(directions);
        expect_same(iterate_to(directions, once.sums), once);
    }
}

}  // namespace
