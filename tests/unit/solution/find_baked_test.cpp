// A finished solution of the same input is found again, and no other.
#include "support/scene_builder.h"

#include <transillum/solution/bake.h>
#include <transillum/solution/load_solution.h>

#include <gtest/gtest.h>

#include <unistd.h>

#include <filesystem>
#include <fstream>

namespace transillum {
namespace {

using namespace testing_support;
namespace fs = std::filesystem;

Scene room(float emission = 1.0f) {
    SceneBuilder b;
    b.box({0, 0, 0}, {1, 1, 1}, Facing::inwards, b.material(Spectrum(0.5f), Spectrum(emission)));
    return b.scene;
}

BakeOptions quick() {
    BakeOptions options;
    options.subdivision.leaf_target = 50;
    options.iteration.iterations = 8;
    options.resolution = 32;
    return options;
}

class FindBaked : public testing::Test {
protected:
    FindBaked() {
        fs::remove_all(folder_);
        fs::create_directories(folder_);
    }
    ~FindBaked() override { fs::remove_all(folder_); }

    Solution save(const Scene& scene, const BakeOptions& options) const {
        Monitor silent;
        RunRecord run;
        const Solution s = bake(scene, options, Workers(1), silent, &run);
        save_solution(s, run, path_);
        return s;
    }

    fs::path folder_ = fs::temp_directory_path() / ("find_baked_" + std::to_string(getpid()));
    fs::path path_ = folder_ / "room.vtm";
};

TEST_F(FindBaked, FindsWhatWasBakedFromTheSameInput) {
    EXPECT_FALSE(find_baked(path_, hash_input(room(), quick())));
    const Solution s = save(room(), quick());
    const auto found = find_baked(path_, hash_input(room(), quick()));
    ASSERT_TRUE(found);
    EXPECT_EQ(found->indirect_irradiance, s.indirect_irradiance);
}

TEST_F(FindBaked, FindsNothingOfAnotherInput) {
    save(room(), quick());
    EXPECT_FALSE(find_baked(path_, hash_input(room(2.0f), quick())));
    Scene seen = room();
    seen.cameras.emplace_back();
    EXPECT_FALSE(find_baked(path_, hash_input(seen, quick())));
    Scene moved = room();
    moved.positions[3].x += 1e-15;
    EXPECT_FALSE(find_baked(path_, hash_input(moved, quick())));
    BakeOptions seeded = quick(), longer = quick();
    seeded.seed = 2;
    longer.iteration.iterations = 16;
    EXPECT_FALSE(find_baked(path_, hash_input(room(), seeded)));
    EXPECT_FALSE(find_baked(path_, hash_input(room(), longer)));
}

TEST_F(FindBaked, FindsNothingUnfinishedOrDamaged) {
    Solution s = save(room(), quick());
    const RunRecord run = load_run_record(path_);
    s.interrupted = true;
    save_solution(s, run, path_);
    EXPECT_FALSE(find_baked(path_, run.input_hash));
    s.interrupted = false;
    save_solution(s, run, path_);
    EXPECT_TRUE(find_baked(path_, run.input_hash));
    std::ofstream(folder_ / "room" / "radiance.vtp", std::ios::app) << ' ';
    EXPECT_FALSE(find_baked(path_, run.input_hash));
    save_solution(s, run, path_);
    std::ofstream(folder_ / "room" / "run.json") << "{";
    EXPECT_FALSE(find_baked(path_, run.input_hash));
}

}  // namespace
}  // namespace transillum
