#include <transillum/transport/choose_bins.h>

#include "support/scene_builder.h"

#include <gtest/gtest.h>

namespace {

using namespace transillum;
using namespace transillum::testing_support;

/// A glossy square of two roots, with bins one level deeper than those in question.
class GlossySquare : public testing::Test {
protected:
    void make(float shininess, int level) {
        SceneBuilder b;
        Material& m = b.scene.materials[0];
        m.diffuse = Spectrum(0.0f);
        m.specular = Spectrum(0.5f);
        m.lobe = Lobe::max_phong;
        m.shininess = shininess;
        m.back_reflects = false;
        b.polygon({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}});
        mesh_ = b.surface();
        patches_ = subdivide_to_levels({1, 1});
        levels_ = choose_bin_levels(mesh_, {level});
        glossy_ = lay_out_glossy_sides(mesh_, patches_, deeper_bins(levels_, 1 << 20));
        elements_.assign(glossy_.element_count, Spectrum(1.0f));
    }
    /// Sides that are divided at a tolerance.
    [[nodiscard]] std::uint32_t divided(double tolerance) const {
        return choose_bins(levels_, mesh_, patches_, glossy_, elements_, tolerance).divided;
    }

    SurfaceMesh mesh_;
    PatchHierarchy patches_;
    std::vector<std::int8_t> levels_;
    GlossySides glossy_;
    std::vector<Spectrum> elements_;
};

TEST_F(GlossySquare, LeavesUniformLightWhole) {
    for (const int level : {0, 1, 2}) {
        make(10.0f, level);
        EXPECT_EQ(divided(1e-3), 0u);
    }
}

TEST_F(GlossySquare, DividesWhereQuartersDiffer) {
    for (const int level : {0, 1, 2}) {
        make(10.0f, level);
        // Light from one bin: the first of its four.
        for (const GlossySide& s : glossy_.sides)
            for (int k = 0; k < s.bins(); ++k)
                for (std::uint32_t p = s.first_patch; p < s.first_patch + s.leaf_count; ++p)
                    elements_[s.element(k, p)] = Spectrum(k == 0 ? 1.0f : 0.0f);
        EXPECT_EQ(divided(1e-3), 2u) << level;
        const BinChoice choice = choose_bins(levels_, mesh_, patches_, glossy_, elements_, 1e-3);
        EXPECT_EQ(choice.levels, deeper_bins(levels_, 1 << 20));
        // No more than all that is reflected can differ.
        EXPECT_EQ(divided(0.5), 0u);
    }
}

// The same light, but the lobe is too wide to tell where in the bin it comes from.
TEST_F(GlossySquare, DividesForSharpLobesFirst) {
    const auto largest_tolerance = [&](float shininess) {
        make(shininess, 1);
        for (const GlossySide& s : glossy_.sides)
            for (int k = 0; k < s.bins(); ++k)
                for (std::uint32_t p = s.first_patch; p < s.first_patch + s.leaf_count; ++p)
                    elements_[s.element(k, p)] = Spectrum(k % 2 == 0 ? 1.0f : 0.0f);
        double tolerance = 1.0;
        while (divided(tolerance) == 0) tolerance *= 0.9;
        return tolerance;
    };
    const double wide = largest_tolerance(1.0f), narrow = largest_tolerance(30.0f);
    EXPECT_GT(narrow, 2.0 * wide);
}

TEST_F(GlossySquare, OneSideAlone) {
    make(10.0f, 1);
    const GlossySide& s = glossy_.sides[1];
    for (std::uint32_t p = s.first_patch; p < s.first_patch + s.leaf_count; ++p)
        elements_[s.element(5, p)] = Spectrum(10.0f);
    const BinChoice choice = choose_bins(levels_, mesh_, patches_, glossy_, elements_, 0.01);
    EXPECT_EQ(choice.divided, 1u);
    EXPECT_EQ(choice.levels[2 * s.root], 2);
    EXPECT_EQ(choice.levels[2 * glossy_.sides[0].root], 1);
}

TEST(DeeperBins, NeedEnoughDirectionsAndALevelBelow) {
    const std::vector<std::int8_t> levels{-1, 0, 1, 2, max_bin_level};
    EXPECT_EQ(deeper_bins(levels, 31), levels);
    EXPECT_EQ(deeper_bins(levels, 32), (std::vector<std::int8_t>{-1, 1, 1, 2, max_bin_level}));
    EXPECT_EQ(deeper_bins(levels, 128), (std::vector<std::int8_t>{-1, 1, 2, 2, max_bin_level}));
    EXPECT_EQ(deeper_bins(levels, 512), (std::vector<std::int8_t>{-1, 1, 2, 3, max_bin_level}));
}

}  // namespace
