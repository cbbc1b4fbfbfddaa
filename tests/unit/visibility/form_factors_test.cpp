/// F_ij = (2 dP / A_i) <N_ij>: N_ij counts neighbours in the lists of which one is of i and one of
/// j, facing each other; dP is a pixel's area, and the mean is over uniform directions.
#include "support/closed_forms.h"
#include "support/scene_builder.h"
#include "unit/visibility/pixel_lists.h"

#include <gtest/gtest.h>

namespace transillum {
namespace {

using namespace testing_support;

/// Of polygon 0 to polygon 1; the error from independent scramblings.
Estimate form_factor(const SceneBuilder& builder, double area) {
    const SurfaceMesh mesh = builder.surface();
    const PatchHierarchy patches = subdivide_to_levels(std::vector<int>(mesh.triangles.size(), 1));
    const auto face = [&](Fragment f) {
        return mesh.triangles[patches.root_of_leaf[leaf_of(f)]].source_face;
    };
    TransilluminationBuffer buffer(mesh, patches, 1.0 / 60.0);
    const Workers workers(2);
    std::vector<double> values;
    constexpr int directions = 512, replicates = 16;
    for (std::uint64_t seed = 0; seed < replicates; ++seed) {
        std::uint64_t pairs = 0;
        for (std::uint32_t i = 0; i < directions; ++i)
            for_lists(buffer, sample_bundle(i, 100 + seed), workers, [&](PixelList list) {
                for (std::size_t k = 0; k + 1 < list.size(); ++k)
                    pairs += front_faces_forwards(list[k]) && !front_faces_forwards(list[k + 1]) &&
                             face(list[k]) + face(list[k + 1]) == 1;
            });
        values.push_back(2.0 * buffer.pixel_size() * buffer.pixel_size() / area *
                         static_cast<double>(pairs) / directions);
    }
    return estimate(values);
}

void expect_form_factor(const SceneBuilder& builder, double area, double expected) {
    const Estimate f = form_factor(builder, area);
    EXPECT_NEAR(f.mean, expected, 3.0 * f.error);
    EXPECT_LT(f.error, 0.01 * expected);
}

SceneBuilder parallel_rectangles(double a, double b, double distance) {
    SceneBuilder builder;
    builder.polygon({{0, 0, 0}, {a, 0, 0}, {a, b, 0}, {0, b, 0}});
    builder.polygon({{0, 0, distance}, {0, b, distance}, {a, b, distance}, {a, 0, distance}});
    return builder;
}

TEST(FormFactors, OfParallelUnitSquares) {
    expect_form_factor(parallel_rectangles(1, 1, 0.5), 1, 0.4152533);
    expect_form_factor(parallel_rectangles(1, 1, 1), 1, 0.1998249);
    expect_form_factor(parallel_rectangles(1, 1, 2), 1, 0.0685896);
}

TEST(FormFactors, OfParallelRectangles) {
    expect_form_factor(parallel_rectangles(1, 2, 0.5), 2, 0.5089887);
}

TEST(FormFactors, OfPerpendicularUnitSquares) {
    SceneBuilder builder;
    builder.polygon({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}});
    builder.polygon({{0, 0, 0}, {0, 0, 1}, {1, 0, 1}, {1, 0, 0}});
    expect_form_factor(builder, 1, 0.2000438);
}

TEST(FormFactors, NothingIsExchangedThroughAScreenOrWithBacks) {
    SceneBuilder screened = parallel_rectangles(1, 1, 1);
    screened.polygon({{-1, -1, 0.5}, {2, -1, 0.5}, {2, 2, 0.5}, {-1, 2, 0.5}});
    EXPECT_EQ(form_factor(screened, 1).mean, 0.0);
    SceneBuilder away;
    away.polygon({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}});
    away.polygon({{0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}});
    EXPECT_EQ(form_factor(away, 1).mean, 0.0);
}

}  // namespace
}  // namespace transillum
