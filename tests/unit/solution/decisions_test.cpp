// What a scene doesn't need is left out, and said, and the answer is that of a bake that is forced
// to do it all the same.
#include "support/decision_cases.h"
#include "support/scene_builder.h"

#include <transillum/solution/bake.h>
#include <transillum/transport/iterate_without.h>
#include <transillum/visibility/transillumination_buffer.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <ostream>

namespace transillum::testing_support {

void PrintTo(const DecisionCase& c, std::ostream* out) {
    *out << c.name;
}

}  // namespace transillum::testing_support

namespace transillum::test {

namespace {

using namespace testing_support;

Solution bake_quietly(const Scene& scene, const BakeOptions& options) {
    Monitor silent;
    return bake(scene, options, Workers(2), silent);
}

std::string all_of(const Solution& s) {
    std::string text;
    for (const Decision& d : s.decisions) text += d.what + ": " + d.why + "\n";
    return text;
}

class Decisions : public testing::TestWithParam<DecisionCase> {};

INSTANTIATE_TEST_SUITE_P(Cases, Decisions, testing::ValuesIn(decision_cases({})),
                         [](const auto& i) {
                             std::string name = i.param.name;
                             std::erase_if(name, [](char c) { return c == ' '; });
                             return name;
                         });

TEST_P(Decisions, AreToldAndChangeNothing) {
    const DecisionCase& c = GetParam();
    const Solution decided = bake_quietly(c.scene, c.options);
    const Solution forced = bake_quietly(c.forced_scene, c.forced_options);
    EXPECT_TRUE(tells(decided, c.told)) << all_of(decided);
    EXPECT_FALSE(tells(forced, c.told)) << all_of(forced);
    const FrontField a = fronts_of(decided), b = fronts_of(forced);
    // Errors of independent runs add up in squares; these are estimates within a factor of 1.5.
    const double errors = 1.5 * std::hypot(a.relative_error, b.relative_error);
    EXPECT_NEAR(a.mean() / b.mean(), 1.0, errors + c.tolerance);
    if (!c.means_alone) {
        EXPECT_LE(relative_rms(a, b), errors + c.tolerance);
    }
}

Scene two_rooms(int polygon_that_shines) {
    SceneBuilder b;
    const std::uint32_t grey = b.material(Spectrum(0.5f));
    b.box({0, 0, 0}, {1, 1, 1}, Facing::inwards, grey);
    b.box({1.25, 0, 0}, {3.25, 1, 1}, Facing::inwards, grey);
    b.scene.polygons[polygon_that_shines].material =
        b.material(Spectrum(0.5f), Spectrum(1.0f, 2.0f, 3.0f));
    return b.scene;
}

BakeOptions quick() {
    BakeOptions options;
    options.subdivision.leaf_target = 300;
    options.light.first_shot = FirstShot::off;
    options.resolution = 100;
    options.iteration.iterations = 64;
    return options;
}

// Light that no mirror image of the room tells from its own: whichever room shines.
TEST(DarkRooms, AreThoseThatNoLightReaches) {
    for (const int shines : {0, 6}) {
        const Solution s = bake_quietly(two_rooms(shines), quick());
        EXPECT_TRUE(tells(s, "left out of the transport")) << all_of(s);
        for (std::uint32_t p = 0; p < s.patches.leaf_count; ++p) {
            const std::uint32_t root = s.patches.root_of_leaf[p];
            const bool first = s.surface.positions[s.surface.triangles[root].vertices[0]].x < 1.1;
            const bool is_lit = first == (shines == 0);
            EXPECT_EQ(s.coverage[p] > 0.0f, is_lit);
            EXPECT_EQ(max_channel(s.indirect_irradiance[p]) > 0.0f, is_lit);
        }
        // All that is emitted is absorbed by the room it shines in.
        EXPECT_NEAR(s.balance.absorbed.x / s.balance.emitted.x, 1.0, 0.02);
    }
}

TEST(DarkRooms, AreNoneWhereADoorIsOpenOrTheSkyShines) {
    Scene open = two_rooms(0);
    // The walls between the rooms: the first's high x, the second's low x.
    std::erase_if(open.polygons,
                  [](const Polygon& p) { return p.source_face == 5 || p.source_face == 10; });
    EXPECT_FALSE(tells(bake_quietly(open, quick()), "left out of the transport"));
    Scene outside = two_rooms(0);
    outside.lighting.environment.kind = Environment::Kind::uniform;
    EXPECT_FALSE(tells(bake_quietly(outside, quick()), "left out of the transport"));
    BakeOptions kept = quick();
    kept.dark_rooms = DarkRooms::keep;
    EXPECT_FALSE(tells(bake_quietly(two_rooms(0), kept), "left out of the transport"));
}

// A lamp that no pixel of the search meets: its room must not be taken for dark.
TEST(DarkRooms, AreNotSoughtWhereALampIsNotMet) {
    Scene scene = two_rooms(0);
    SceneBuilder b;
    b.scene = scene;
    const double tiny = 1e-5;
    b.polygon({{2, 0.5, 0.5}, {2 + tiny, 0.5, 0.5}, {2 + tiny, 0.5 + tiny, 0.5}},
              b.material(Spectrum(0.5f), Spectrum(1.0f)));
    EXPECT_FALSE(tells(bake_quietly(b.scene, quick()), "left out of the transport"));
}

// To the bit: the same pixels of the same scene.
TEST(IterateWithout, IsAsIfTheRootsWereNotThere) {
    Monitor silent;
    const auto lay_out = [&](const Scene& scene) {
        Solution s;
        s.surface = build_surface(scene, {}, silent);
        s.patches = subdivide_uniformly(s.surface, {.patch_size = 0.2});
        return s;
    };
    const auto sources_of = [](const Solution& s) {
        PatchSources sources;
        for (std::uint32_t p = 0; p < s.patches.patch_count(); ++p) {
            sources.emission.push_back(s.emission(p));
            sources.direct.emplace_back(0.0f);
            sources.albedo.push_back(s.diffuse(p));
        }
        return sources;
    };
    const Solution both = lay_out(two_rooms(0));
    Scene first = two_rooms(0);
    first.polygons.resize(6);
    const Solution alone = lay_out(first);
    std::vector<std::uint8_t> left_out(both.surface.triangles.size());
    const std::size_t kept = alone.surface.triangles.size();
    std::fill(left_out.begin() + static_cast<std::ptrdiff_t>(kept), left_out.end(), 1);

    IterationOptions options;
    options.pixel_size = 0.01;
    options.keep_sums = true;
    const Workers workers(2);
    std::shared_ptr<const IterationSums> sums_of_both, sums_alone;
    for (const std::uint64_t directions : {40, 100}) {  // the second goes on from the first
        options.iterations = directions;
        options.start = sums_of_both;
        const TransportResult part = iterate_without(left_out, both.surface, both.patches,
                                                     sources_of(both), options, workers, silent);
        options.start = sums_alone;
        const TransportResult whole =
            iterate(alone.surface, alone.patches, sources_of(alone), options, workers, silent);
        EXPECT_EQ(part.relative_error, whole.relative_error);
        EXPECT_EQ(part.escaped, whole.escaped);
        for (std::uint32_t p = 0; p < both.patches.patch_count(); ++p) {
            const std::uint32_t leaf = both.patches.leaf_of_patch(p);
            const bool is_part = leaf < alone.patches.leaf_count;
            const std::uint32_t q =
                both.patches.is_back(p) ? leaf + alone.patches.leaf_count : leaf;
            EXPECT_EQ(part.irradiance[p], is_part ? whole.irradiance[q] : Spectrum(0.0f));
            EXPECT_EQ(part.coverage[p], is_part ? whole.coverage[q] : 0.0f);
        }
        sums_of_both = part.sums;
        sums_alone = whole.sums;
    }
}

}  // namespace

}  // namespace transillum::test
