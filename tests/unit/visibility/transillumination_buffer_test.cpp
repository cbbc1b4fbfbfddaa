#include "support/closed_forms.h"
#include "support/random_hierarchy.h"
#include "support/scene_builder.h"
#include "unit/visibility/pixel_lists.h"

#include <transillum/base/sampling.h>

#include <gtest/gtest.h>
#include <glm/geometric.hpp>

#include <algorithm>
#include <map>
#include <mutex>

namespace transillum {
namespace {

using namespace testing_support;

PatchHierarchy uniform_levels(const SurfaceMesh& mesh, int level) {
    return subdivide_to_levels(std::vector<int>(mesh.triangles.size(), level));
}

struct Counts {
    std::uint64_t forwards = 0, backwards = 0, pixels = 0;
};
Counts count(TransilluminationBuffer& buffer, const Bundle& bundle, const Workers& workers) {
    Counts c;
    for_lists(buffer, bundle, workers, [&](PixelList list) {
        ++c.pixels;
        for (const Fragment f : list) ++(front_faces_forwards(f) ? c.forwards : c.backwards);
    });
    return c;
}

/// The projection of a unit cube along d has the area |dx| + |dy| + |dz|, 1.5 in the mean.
TEST(TransilluminationBuffer, CubeHasItsProjectedArea) {
    SceneBuilder builder;
    builder.box({0, 0, 0}, {1, 1, 1}, Facing::outwards);
    const SurfaceMesh mesh = builder.surface();
    const PatchHierarchy patches = uniform_levels(mesh, 2);
    TransilluminationBuffer buffer(mesh, patches, 1.0 / 80.0);
    const Workers workers(2);
    const double pixel_area = buffer.pixel_size() * buffer.pixel_size();
    std::vector<double> areas, errors;
    for (std::uint32_t i = 0; i < 1024; ++i) {
        const Bundle bundle = sample_bundle(i, 5);
        const Counts c = count(buffer, bundle, workers);
        EXPECT_EQ(c.forwards, c.pixels);
        EXPECT_EQ(c.backwards, c.pixels);
        const glm::dvec3 d = glm::abs(bundle.frame[2]);
        areas.push_back(static_cast<double>(c.pixels) * pixel_area);
        errors.push_back(areas.back() - (d.x + d.y + d.z));
    }
    EXPECT_NEAR(estimate(areas).mean, 1.5, 3.0 * estimate(areas).error);
    // Outline pixels fall on either side alike: the rasterization itself has no bias.
    EXPECT_NEAR(estimate(errors).mean, 0.0, 3.0 * estimate(errors).error);
    EXPECT_LT(estimate(errors).error, 1e-4);
}

struct Closed {
    const char* name;
    Facing facing;
    SurfaceMesh mesh;
};

std::vector<Closed> closed_surfaces() {
    std::vector<Closed> all;
    for (const Facing facing : {Facing::outwards, Facing::inwards}) {
        const Facing other = facing == Facing::outwards ? Facing::inwards : Facing::outwards;
        SceneBuilder cube, sphere, shell, flat, foil;
        cube.box({0, 0, 0}, {1, 1, 1}, facing);
        sphere.sphere({0, 0, 0}, 0.6, 40, facing);
        shell.box({0, 0, 0}, {1, 1, 1}, facing);
        shell.box({0.3, 0.2, 0.4}, {0.7, 0.6, 0.9}, other);
        flat.box({0, 0, 0}, {1, 1, 0.02}, facing);
        foil.sphere({0, 0, 0}, 0.6, 40, facing);
        foil.sphere({0, 0, 0}, 0.6 * (1.0 - 1e-5), 40, other);
        all.push_back({"foil", facing, foil.surface()});
        all.push_back({"cube", facing, cube.surface()});
        all.push_back({"sphere", facing, sphere.surface()});
        all.push_back({"shell", facing, shell.surface()});
        all.push_back({"plate", facing, flat.surface()});
    }
    return all;
}

/// Sampled ones, and some whose outlines run through the centres of pixels, where both sides lie in
/// one point: there the lowest vertices are, and what is parallel to the y axis stays upright.
std::vector<Bundle> bundles_on_outlines() {
    std::vector<Bundle> all;
    for (std::uint32_t i = 0; i < 256; ++i) all.push_back(sample_bundle(i, 1));
    for (std::uint32_t i = 0; i < 64; ++i) {
        const double c = std::cos(0.1 * (i + 0.5)), s = std::sin(0.1 * (i + 0.5));
        all.push_back({{{c, 0, -s}, {0, 1, 0}, {s, 0, c}}});
        all.push_back({{{0, 1, 0}, {-c, 0, s}, {s, 0, c}}});
    }
    return all;
}

TEST(TransilluminationBuffer, ListsOfClosedSurfacesAlternate) {
    const Workers workers(2);
    for (const Closed& closed : closed_surfaces()) {
        const PatchHierarchy patches = uniform_levels(closed.mesh, 1);
        TransilluminationBuffer buffer(closed.mesh, patches, 1.0 / 100.0);
        std::uint64_t wrong = 0, lists = 0;
        for (const Bundle& bundle : bundles_on_outlines())
            for_lists(buffer, bundle, workers, [&](PixelList list) {
                ++lists;
                // What is met first shows its outer side, against the direction.
                bool forwards = closed.facing == Facing::inwards;
                bool right = list.size() % 2 == 0;
                for (const Fragment f : list) {
                    right = right && front_faces_forwards(f) == forwards;
                    forwards = !forwards;
                }
                wrong += !right;
            });
        EXPECT_GT(lists, 100000u) << closed.name;
        EXPECT_EQ(wrong, 0u) << closed.name << " of " << lists;
    }
}

/// Bodies within bodies: no alternation, but every ray leaves what it enters.
TEST(TransilluminationBuffer, CountsOfNestedBodiesAgreeInEveryList) {
    SceneBuilder builder;
    builder.box({0, 0, 0}, {1, 1, 1}, Facing::outwards);
    builder.sphere({0.5, 0.5, 0.5}, 0.3, 24, Facing::outwards);
    builder.box({0.9, 0.9, 0.9}, {1.4, 1.2, 1.1}, Facing::outwards);
    const SurfaceMesh mesh = builder.surface();
    const PatchHierarchy patches = uniform_levels(mesh, 0);
    TransilluminationBuffer buffer(mesh, patches, 1.0 / 100.0);
    const Workers workers(2);
    std::uint64_t wrong = 0;
    for (std::uint32_t i = 0; i < 256; ++i)
        for_lists(buffer, sample_bundle(i, 2), workers, [&](PixelList list) {
            wrong += 2 * std::ranges::count_if(list, front_faces_forwards) != std::ssize(list);
            wrong += !std::ranges::is_sorted(list, {}, [](Fragment f) { return f >> 32; });
        });
    EXPECT_EQ(wrong, 0u);
}

/// Vertices within the square leave its outline alone: the same pixels, once each.
TEST(TransilluminationBuffer, ATessellatedSquareIsCoveredOnce) {
    const std::array<glm::dvec3, 4> corner{{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}};
    SceneBuilder plain, tessellated;
    plain.polygon({corner[0], corner[1], corner[2], corner[3]});
    std::vector<std::array<glm::dvec3, 3>> triangles{{corner[0], corner[1], corner[2]},
                                                     {corner[0], corner[2], corner[3]}};
    Random random(1, 1);
    for (int i = 0; i < 40; ++i) {
        // Splits the largest at a point well within.
        const auto at = std::ranges::max_element(triangles, {}, [](const auto& t) {
            return glm::length(glm::cross(t[1] - t[0], t[2] - t[0]));
        });
        const auto t = *at;
        const double u = 0.2 + 0.2 * random.next(), v = 0.2 + 0.2 * random.next();
        const glm::dvec3 p = t[0] + u * (t[1] - t[0]) + v * (t[2] - t[0]);
        *at = {t[0], t[1], p};
        triangles.push_back({t[1], t[2], p});
        triangles.push_back({t[2], t[0], p});
    }
    for (const auto& t : triangles) tessellated.polygon({t[0], t[1], t[2]});
    const SurfaceMesh a = plain.surface(), b = tessellated.surface();
    const PatchHierarchy pa = uniform_levels(a, 3), pb = uniform_levels(b, 0);
    TransilluminationBuffer coarse(a, pa, 1.0 / 700.0), fine(b, pb, 1.0 / 700.0);
    const Workers workers(2);
    for (std::uint32_t i = 0; i < 64; ++i) {
        const Bundle bundle = sample_bundle(i, 3);
        // Edge-on, snapping may turn a triangle over.
        if (std::abs(bundle.frame[2].z) < 0.1) continue;
        const Counts ca = count(coarse, bundle, workers), cb = count(fine, bundle, workers);
        EXPECT_EQ(ca.forwards + ca.backwards, ca.pixels);
        EXPECT_EQ(cb.forwards + cb.backwards, cb.pixels);
        EXPECT_EQ(ca.pixels, cb.pixels);
        EXPECT_TRUE(cb.forwards == 0 || cb.backwards == 0);
    }
}

/// Vertices on the outline are snapped by up to 1/512 pixel along each axis: the pixels in that
/// strip may change, about perimeter / 512 of them.
TEST(TransilluminationBuffer, ASubdividedCubeCoversWhatThePlainOneDoes) {
    SceneBuilder plain, divided;
    plain.box({0, 0, 0}, {1, 1, 1}, Facing::outwards);
    const SurfaceMesh a = plain.surface();
    const PatchHierarchy pa = uniform_levels(a, 3);
    for (std::uint32_t leaf = 0; leaf < pa.leaf_count; ++leaf) {
        Outline triangle;
        for (const glm::dvec3& p : points_of_leaf(a, pa, leaf)) triangle.push_back(p);
        divided.polygon(triangle);
    }
    const SurfaceMesh b = divided.surface();
    const PatchHierarchy pb = uniform_levels(b, 0);
    constexpr double pixels_an_edge = 400.0;
    TransilluminationBuffer coarse(a, pa, 1.0 / pixels_an_edge), fine(b, pb, 1.0 / pixels_an_edge);
    const Workers workers(2);
    double difference = 0.0, changed = 0.0;
    constexpr int n = 64;
    for (std::uint32_t i = 0; i < n; ++i) {
        const Bundle bundle = sample_bundle(i, 4);
        const Counts ca = count(coarse, bundle, workers), cb = count(fine, bundle, workers);
        EXPECT_EQ(cb.forwards, cb.backwards);
        const double d = static_cast<double>(cb.pixels) - static_cast<double>(ca.pixels);
        difference += d;
        changed += std::abs(d);
    }
    // An outline has at most six edges.
    constexpr double strip = 6.0 * pixels_an_edge / 512.0 * 1.5;
    EXPECT_LT(changed / n, strip);
    EXPECT_LT(std::abs(difference), 5.0 * std::sqrt(strip * n));
}

/// Every root as fine throughout as its smallest leaf.
PatchHierarchy finest_of(const PatchHierarchy& patches) {
    std::vector<int> levels;
    for (const RootPatches& r : patches.roots) levels.push_back(r.level);
    return subdivide_to_levels(levels);
}

/// The list of every pixel, one after the other.
std::vector<Fragment> all_fragments(TransilluminationBuffer& buffer, const Bundle& bundle) {
    std::vector<Fragment> all;
    for_lists(buffer, bundle, Workers(1),
              [&](PixelList list) { all.insert(all.end(), list.begin(), list.end()); });
    return all;
}

TEST(TransilluminationBuffer, LeavesOfSeveralLevelsGetWhatTheSmallestOfTheirRootDo) {
    SceneBuilder builder;
    builder.box({0, 0, 0}, {1, 1, 1}, Facing::inwards);
    builder.sphere({0.5, 0.5, 0.5}, 0.3, 12, Facing::outwards);
    const SurfaceMesh mesh = builder.surface();
    for (const std::uint64_t seed : {1, 2, 3}) {
        const PatchHierarchy mixed =
            random_hierarchy(std::vector<int>(mesh.triangles.size(), seed % 2), 3, seed);
        ASSERT_GT(mixed.mixed_roots.size(), mesh.triangles.size() / 2);
        const PatchHierarchy fine = finest_of(mixed);
        std::vector<std::uint32_t> leaf_of_fine;
        for (std::uint32_t leaf = 0; leaf < fine.leaf_count; ++leaf) {
            const auto [corners, level] = leaf_corners(fine, leaf);
            const glm::vec2 centre = glm::vec2(corners[0] + corners[1] + corners[2]) /
                                     (3.0f * static_cast<float>(1 << level));
            leaf_of_fine.push_back(mixed.leaf_at(fine.root_of_leaf[leaf], centre.x, centre.y));
        }
        TransilluminationBuffer a(mesh, mixed, 1.0 / 150.0), b(mesh, fine, 1.0 / 150.0);
        for (std::uint32_t i = 0; i < 32; ++i) {
            const Bundle bundle = sample_bundle(i, seed);
            const auto of_mixed = all_fragments(a, bundle);
            auto expected = all_fragments(b, bundle);
            ASSERT_GT(expected.size(), 10000u);
            for (Fragment& f : expected) f += leaf_of_fine[leaf_of(f)] - std::uint64_t{leaf_of(f)};
            ASSERT_TRUE(of_mixed == expected);
        }
    }
}

/// Leaves share the fragments of their root by area.
TEST(TransilluminationBuffer, FragmentsFallOnLeavesByTheirArea) {
    SceneBuilder builder;
    builder.polygon({{0, 0, 0}, {1, 0, 0.2}, {0.1, 1, 0}});
    const SurfaceMesh mesh = builder.surface();
    const PatchHierarchy patches = uniform_levels(mesh, 2);
    TransilluminationBuffer buffer(mesh, patches, 1.0 / 200.0);
    const Workers workers(2);
    std::vector<double> share(patches.leaf_count);
    double total = 0.0;
    for (std::uint32_t i = 0; i < 256; ++i)
        for_lists(buffer, sample_bundle(i, 6), workers, [&](PixelList list) {
            for (const Fragment f : list) ++share[leaf_of(f)], ++total;
        });
    for (double& s : share) s *= static_cast<double>(patches.leaf_count) / total;
    for (const double s : share) EXPECT_NEAR(s, 1.0, 1e-3);
}

TEST(TransilluminationBuffer, ListsDoNotDependOnTheNumberOfWorkers) {
    SceneBuilder builder;
    builder.box({0, 0, 0}, {1, 1, 1}, Facing::inwards);
    builder.sphere({0.5, 0.5, 0.5}, 0.3, 160, Facing::outwards);  // more than one set of bins
    const SurfaceMesh mesh = builder.surface();
    ASSERT_GT(mesh.triangles.size(), 1u << 14);
    const PatchHierarchy patches = uniform_levels(mesh, 1);
    std::vector<std::multimap<int, std::vector<Fragment>>> results;
    for (const int threads : {1, 2, 8}) {
        const Workers workers(threads);
        TransilluminationBuffer buffer(mesh, patches, 1.0 / 150.0);
        auto& tiles = results.emplace_back();
        for (std::uint32_t i = 0; i < 4; ++i) {
            std::mutex one_at_a_time;
            buffer.trace(sample_bundle(i, 7), workers, [&](const TileLists& tile, int) {
                std::vector<Fragment> all(tile.fragments.begin(), tile.fragments.end());
                all.insert(all.end(), tile.first.begin(),
                           tile.first.begin() + tile.width * tile.height + 1);
                const std::lock_guard lock(one_at_a_time);
                tiles.emplace(tile.row0, std::move(all));
            });
        }
    }
    const auto sorted = [](const auto& tiles) {
        std::vector<std::pair<int, std::vector<Fragment>>> all(tiles.begin(), tiles.end());
        std::ranges::sort(all);
        return all;
    };
    EXPECT_EQ(sorted(results[0]), sorted(results[1]));
    EXPECT_EQ(sorted(results[0]), sorted(results[2]));
}

/// Two faces on the same corners, back to back: light from either side must meet a front.
TEST(TransilluminationBuffer, CoincidentFacesComeWithTheOneThatFacesBackwardsFirst) {
    SceneBuilder builder;
    const Outline p{{0, 0, 0}, {1, 0.1, 0}, {0.3, 1, 0.4}};
    builder.polygon({p[0], p[1], p[2]});
    builder.polygon({p[1], p[0], p[2]});
    const SurfaceMesh mesh = builder.surface();
    ASSERT_EQ(mesh.triangles.size(), 2u);
    const PatchHierarchy patches = uniform_levels(mesh, 3);
    TransilluminationBuffer buffer(mesh, patches, 1.0 / 300.0);
    const Workers workers(2);
    for (std::uint32_t i = 0; i < 256; ++i)
        for_lists(buffer, sample_bundle(i, 8), workers, [&](PixelList list) {
            ASSERT_EQ(list.size(), 2u);
            ASSERT_FALSE(front_faces_forwards(list[0]));
            ASSERT_TRUE(front_faces_forwards(list[1]));
        });
}

TEST(Fragments, NameThePatchesLightMeets) {
    const Fragment forwards = 0x80000005u, backwards = 0x00000005u;
    EXPECT_EQ(leaf_of(forwards), 5u);
    EXPECT_EQ(leaf_of(backwards), 5u);
    // Light along the direction meets the back of a front that faces forwards.
    EXPECT_EQ(lower_patch(forwards, 100), 105u);
    EXPECT_EQ(upper_patch(forwards, 100), 5u);
    EXPECT_EQ(lower_patch(backwards, 100), 5u);
    EXPECT_EQ(upper_patch(backwards, 100), 105u);
}

}  // namespace
}  // namespace transillum
