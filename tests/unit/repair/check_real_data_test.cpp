// Meshes as others left them, where they are at hand: what is known of them otherwise.
#include <transillum/repair/check_scene.h>
#include <transillum/scene/load_scene.h>

#include <gtest/gtest.h>

#include <filesystem>
#include <map>

namespace transillum {
namespace {

const std::filesystem::path meshes = std::filesystem::path(TRANSILLUM_TEST_DATA) / "meshes";

struct Known {
    const char* file;
    std::map<Defect, std::uint64_t> counts;
};

void PrintTo(const Known& known, std::ostream* out) {
    *out << known.file;
}

class RealDataCheck : public testing::TestWithParam<Known> {
protected:
    void SetUp() override {
        if (!std::filesystem::exists(meshes)) GTEST_SKIP() << "no meshes in " << meshes;
    }
};

TEST_P(RealDataCheck, FindsWhatIsKnown) {
    Monitor silent;
    CheckOptions options;
    options.tolerance = 1e-5;
    const CheckReport report =
        check_scene(load_scene(meshes / GetParam().file, {}, silent), options, Workers(), silent);
    for (const auto& [defect, count] : GetParam().counts)
        EXPECT_EQ(report.counts[static_cast<std::size_t>(defect)], count) << name_of(defect);
}

using enum Defect;

INSTANTIATE_TEST_SUITE_P(
    All, RealDataCheck,
    testing::Values(
        Known{"chair.off",
              {{zero_area, 226}, {nonmanifold_edge, 1029}, {duplicate_face, 1}, {border_edge, 1}}},
        Known{"table.off", {{flipped_edge, 2896}, {opposite_face, 16}, {nonmanifold_edge, 31}}},
        Known{"bathtub.obj", {{nonmanifold_edge, 261}, {border_edge, 136}, {repeated_index, 16}}},
        Known{"chair_model.obj", {{duplicate_face, 8}, {nonmanifold_edge, 9518}}},
        Known{"truck.obj",
              {{border_edge, 1388},
               {nonmanifold_edge, 54},
               {nonmanifold_vertex, 55},
               {flipped_edge, 64}}},
        Known{"two-boxes-bad-self-union.ply",
              {{border_edge, 80},
               {near_vertex, 26},
               {duplicate_vertex, 102},
               {nonmanifold_vertex, 4}}},
        Known{"conrod.stl", {{flipped_edge, 5149}, {nonmanifold_edge, 3}, {duplicate_face, 3}}},
        Known{"boeing.off", {{flipped_edge, 978}, {border_edge, 0}, {nonmanifold_edge, 0}}},
        Known{"pig.stl", {{border_edge, 1296}, {nonmanifold_vertex, 421}}},
        Known{"cube-shuffled.off", {{flipped_edge, 9}, {self_intersection, 0}}},
        Known{"blobby-shuffled.off", {{flipped_edge, 3069}, {border_edge, 0}}},
        Known{"40509.stl", {{border_edge, 16}, {flipped_edge, 9}}},
        Known{"degenerate_edge.obj", {{repeated_index, 1}}},
        Known{"zero_area_face.obj", {{zero_area, 1}}},
        Known{"double_sided.obj", {{opposite_face, 2}}},
        Known{"moebius.obj", {{flipped_edge, 4}, {border_edge, 112}, {non_orientable, 1}}},
        Known{"soup.stl", {{self_intersection, 1248}, {border_edge, 300}}}));

TEST(RealDataClean, HasNothingHarmful) {
    if (!std::filesystem::exists(meshes)) GTEST_SKIP() << "no meshes in " << meshes;
    for (const char* file : {"clean/65004.stl", "clean/72214.stl"}) {
        Monitor silent;
        const CheckReport report =
            check_scene(load_scene(meshes / file, {}, silent), {}, Workers(), silent);
        EXPECT_TRUE(report.is_sound()) << file;
        ASSERT_EQ(report.components.size(), 1u);
        EXPECT_TRUE(report.components[0].closed);
        EXPECT_GT(report.components[0].volume, 0.0);
    }
}

}  // namespace
}  // namespace transillum
