// Going on with a bake, by way of files: what was baked in parts is as what was baked at once.
#include "random_solution.h"

#include "solution/index_file.h"
#include "solution/vtk_bytes.h"
#include "support/scene_builder.h"

#include <transillum/base/error.h>
#include <transillum/solution/bake.h>
#include <transillum/solution/load_solution.h>
#include <transillum/solution/resume.h>

#include <gmock/gmock.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>

#include <fstream>
#include <functional>

namespace transillum::test {

namespace fs = std::filesystem;
using namespace testing_support;

namespace {

/// Glossy walls, a wall across that leaves a gap, and a lamp that is shot first. Lamp and walls
/// have black backs.
Scene divided_room() {
    SceneBuilder b;
    Material& m = b.scene.materials[0];
    m.diffuse = {0.5f, 0.4f, 0.1f};
    m.specular = Spectrum(0.3f);
    m.lobe = Lobe::max_phong;
    m.shininess = 10.0f;
    m.back_reflects = false;
    b.box({-1, -1, 0}, {1, 1, 1.5}, Facing::inwards);
    b.polygon({{0.3, -1, 0}, {0.3, 0.5, 0}, {0.3, 0.5, 1.5}, {0.3, -1, 1.5}});
    b.polygon({{-0.6, -0.2, 1.4}, {-0.6, 0.2, 1.4}, {-0.2, 0.2, 1.4}, {-0.2, -0.2, 1.4}},
              b.material(Spectrum(0.2f), Spectrum(10.0f, 5.0f, 1.0f)));
    return b.scene;
}

Scene under_a_sky() {
    SceneBuilder b;
    b.box({0, 0, 0}, {1, 1, 1}, Facing::inwards, b.material({0.7f, 0.5f, 0.2f}), 1);
    b.scene.lighting.environment.kind = Environment::Kind::uniform;
    b.scene.lighting.environment.radiance_scale = {0.5f, 1.0f, 2.0f};
    return b.scene;
}

/// Glossy rooms, one of them dark.
Scene beside_a_dark_room() {
    SceneBuilder b;
    Material& m = b.scene.materials[0];
    m.specular = Spectrum(0.3f);
    m.lobe = Lobe::max_phong;
    m.shininess = 10.0f;
    b.box({0, 0, 0}, {1, 1, 1}, Facing::inwards);
    b.box({1.5, 0, 0}, {3, 1, 1}, Facing::inwards);
    b.scene.polygons[0].material = b.material(Spectrum(0.5f), Spectrum(1.0f));
    return b.scene;
}

BakeOptions small_bake(std::uint64_t directions) {
    BakeOptions options;
    options.subdivision.leaf_target = 150;
    options.light.samples = 4;
    options.hemicube_resolution = 32;
    options.resolution = 64;
    options.iteration.iterations = directions;
    options.iteration.keep_sums = true;
    return options;
}

Solution bake_to(const Scene& scene, const BakeOptions& options) {
    Monitor silent;
    return bake(scene, options, Workers(2), silent);
}

class Resume : public testing::Test {
protected:
    Resume() : folder_(fresh_folder()), path_(folder_ / "room.vtm") {}
    ~Resume() override { fs::remove_all(folder_); }

    [[nodiscard]] Solution through_files(const Solution& solution) const {
        save_solution(solution, {}, path_);
        return load_solution_to_go_on(path_);
    }

    [[nodiscard]] std::map<std::string, std::string> files_of(const Solution& solution) const {
        save_solution(solution, {}, path_);
        return files_below(folder_);
    }

    [[nodiscard]] Solution gone_on(const Solution& solution, const ResumeOptions& options) const {
        Solution result = through_files(solution);
        Monitor silent;
        resume(result, options, Workers(1), silent);
        return result;
    }

    void expect_same_bytes(const Solution& parts, const Solution& whole) const {
        const auto expected = files_of(whole);
        const auto found = files_of(parts);
        ASSERT_EQ(found.size(), expected.size());
        for (const auto& [name, bytes] : expected)
            EXPECT_TRUE(found.at(name) == bytes) << name << " differs";
        expect_equal(load_solution(path_), through_files(whole));
    }

    fs::path folder_, path_;
};

TEST_F(Resume, TwoPartsAreAWhole) {
    for (Scene (*const scene)() : {divided_room, under_a_sky, beside_a_dark_room}) {
        const Solution whole = bake_to(scene(), small_bake(70));
        for (const std::uint64_t first : {16, 20, 33, 64}) {
            SCOPED_TRACE(first);
            const Solution part = bake_to(scene(), small_bake(first));
            expect_same_bytes(gone_on(part, {.iterations = 70 - first}), whole);
        }
    }
}

TEST_F(Resume, TwoPartsOfARefinedBakeAreAWhole) {
    BakeOptions options = small_bake(600);
    options.refinement.phases = 1;
    const Solution whole = bake_to(divided_room(), options);
    options.iteration.iterations = 300;
    expect_same_bytes(gone_on(bake_to(divided_room(), options), {.iterations = 300}), whole);
}

TEST_F(Resume, AsManyAgainUnlessOneSays) {
    const Solution part = bake_to(under_a_sky(), small_bake(32));
    EXPECT_EQ(gone_on(part, {}).iterations, 64u);
    EXPECT_EQ(gone_on(part, {.iterations = 3}).iterations, 35u);
}

TEST_F(Resume, UntilTheErrorIsMet) {
    BakeOptions options = small_bake(4096);
    options.iteration.target_error = 0.02;
    const Solution whole = bake_to(divided_room(), options);
    ASSERT_LT(whole.iterations, 4096u);
    const Solution part = bake_to(divided_room(), small_bake(80));
    const Solution result = gone_on(part, {.target_error = 0.02});
    EXPECT_EQ(result.iterations, whole.iterations);
    EXPECT_EQ(through_files(result).indirect_irradiance, through_files(whole).indirect_irradiance);
    // Nothing is left to do.
    EXPECT_EQ(gone_on(result, {.target_error = 0.02}).iterations, whole.iterations);
}

/// Wants to stop after so many directions.
class Impatient : public Monitor {
public:
    explicit Impatient(std::uint64_t directions) : left_(directions) {}
    void progress(const Progress& p) override {
        stops_ = p.phase == "transport" && p.done >= left_;
    }
    [[nodiscard]] bool stop_requested() const override { return stops_; }

private:
    std::uint64_t left_;
    bool stops_ = false;
};

TEST_F(Resume, GoesOnAfterAnInterruption) {
    const Solution whole = bake_to(divided_room(), small_bake(64));
    Impatient impatient(29);
    const Solution part = bake(divided_room(), small_bake(64), Workers(2), impatient);
    ASSERT_TRUE(part.interrupted);
    ASSERT_EQ(part.iterations, 29u);
    Solution further = through_files(part);
    Impatient again(41);
    resume(further, {.iterations = 35}, Workers(2), again);
    ASSERT_TRUE(further.interrupted);
    ASSERT_EQ(further.iterations, 41u);
    expect_same_bytes(gone_on(further, {.iterations = 23}), whole);
}

// A first shot that is not whole is nothing to go on from.
TEST_F(Resume, NeedsAWholeFirstShot) {
    class AtOnce : public Monitor {
        [[nodiscard]] bool stop_requested() const override { return true; }
    } at_once;
    const Solution part = bake(divided_room(), small_bake(64), Workers(2), at_once);
    EXPECT_EQ(part.continuation, nullptr);
}

// What is carried is not stored; all else, and the order of directions, goes on.
TEST_F(Resume, BeginsTheMonteCarloComponentAnew) {
    BakeOptions options = small_bake(512);
    options.iteration.monte_carlo = MonteCarlo::subpatch;
    const Solution whole = bake_to(divided_room(), options);
    options.iteration.iterations = 200;
    const Solution parts = gone_on(bake_to(divided_room(), options), {.iterations = 312});
    const auto told = [](const Solution& s) {
        for (const Decision& d : s.decisions)
            if (d.what.find("Monte-Carlo component carried") == 0) return d.what + ": " + d.why;
        return std::string();
    };
    EXPECT_THAT(told(parts), testing::HasSubstr("begun anew at 192 directions"));
    EXPECT_THAT(told(whole), testing::Not(testing::HasSubstr("anew")));
    double difference = 0.0, sum = 0.0;
    for (std::uint32_t p = 0; p < whole.patches.leaf_count; ++p) {
        difference += std::abs(parts.indirect_irradiance[p].x - whole.indirect_irradiance[p].x);
        sum += whole.indirect_irradiance[p].x;
    }
    // The first of 320 directions brought no residual: less than a hundredth of one part in 320.
    EXPECT_LT(difference / sum, 3e-3);
}

// Once it is found not to be worth it, nothing more is carried.
TEST_F(Resume, KeepsToGivingUpTheMonteCarloComponent) {
    SceneBuilder b;
    b.box({0, 0, 0}, {1, 1, 1}, Facing::inwards, b.material(Spectrum(0.6f), Spectrum(0.4f)));
    BakeOptions options = small_bake(400);
    options.iteration.monte_carlo = MonteCarlo::automatic;
    const Solution whole = bake_to(b.scene, options);
    ASSERT_THAT(whole.decisions.back().what, testing::HasSubstr("carried"));
    ASSERT_FALSE(whole.spatial_error.empty());
    options.iteration.iterations = 300;
    expect_same_bytes(gone_on(bake_to(b.scene, options), {.iterations = 100}), whole);
}

TEST_F(Resume, IsRefusedWhereTablesWouldTakeTooMuchMemory) {
    Solution part = bake_to(under_a_sky(), small_bake(8));
    Monitor silent;
    EXPECT_THROW(resume(part, {.memory = 1000}, Workers(1), silent), UsageError);
}

TEST_F(Resume, OfASolutionThatHasNone) {
    BakeOptions options = small_bake(8);
    options.iteration.keep_sums = false;
    Solution part = bake_to(under_a_sky(), options);
    EXPECT_EQ(part.continuation, nullptr);
    Monitor silent;
    EXPECT_THROW(resume(part, {}, Workers(1), silent), UsageError);
    EXPECT_THROW(static_cast<void>(through_files(part)), InputError);
}

class SumsFile : public Resume {
protected:
    SumsFile() { save_solution(solution_, {}, path_); }

    void expect_refused(const std::string& message) const {
        try {
            static_cast<void>(load_solution_to_go_on(path_));
            ADD_FAILURE() << "loaded: " << message;
        } catch (const InputError& error) {
            EXPECT_THAT(error.what(), testing::HasSubstr("sums.vtp"));
            EXPECT_THAT(error.what(), testing::HasSubstr(message));
        }
    }
    void forge(const std::function<void(vtkFieldData&)>& change) const {
        const auto data = from_vtp(bytes_, "sums");
        change(*data->GetFieldData());
        const std::string forged = to_vtp(*data, "sums");
        IndexFile index = parse_index(files_below(folder_).at("room.vtm"), path_);
        for (IndexedPiece& each : index.pieces)
            if (each.name == "sums") each = index_of("room", {{"sums", forged}}).pieces[0];
        std::ofstream(folder_ / "room/sums.vtp", std::ios::binary) << forged;
        std::ofstream(path_, std::ios::binary) << format_index(index);
    }

    const Solution solution_ = bake_to(divided_room(), small_bake(20));
    const std::string bytes_ = [this] {
        save_solution(solution_, {}, path_);
        return files_below(folder_).at("room/sums.vtp");
    }();
};

TEST_F(SumsFile, IsReadByNobodyElse) {
    const Solution loaded = load_solution(path_);
    EXPECT_EQ(loaded.continuation, nullptr);
    fs::remove(folder_ / "room/sums.vtp");
    expect_equal(load_solution(path_), loaded);
}

TEST_F(SumsFile, Truncated) {
    for (std::size_t size = 0; size < bytes_.size(); size += bytes_.size() / 20 + 1) {
        std::ofstream(folder_ / "room/sums.vtp", std::ios::binary) << bytes_.substr(0, size);
        expect_refused("damaged");
    }
}

TEST_F(SumsFile, WithoutAnArrayOrOfAnotherSize) {
    for (const char* name :
         {"SceneHash", "Iterations", "FirstShotBlackBacks", "PixelSize", "Directions", "Received",
          "EarlierCoverage", "Glossy", "ClustersRadiance", "ShuffledUntil", "ClusterCount"}) {
        forge([&](vtkFieldData& fields) { fields.RemoveArray(name); });
        expect_refused(name);
    }
    for (const char* name : {"Received", "EarlierCoverage", "Glossy", "ClustersRadiance"}) {
        forge([&](vtkFieldData& fields) { fields.GetArray(name)->SetNumberOfTuples(3); });
        expect_refused(name);
    }
}

TEST_F(SumsFile, WithValuesThatCannotBe) {
    const auto set = [&](const char* name, double value) {
        forge([&](vtkFieldData& fields) { fields.GetArray(name)->SetComponent(0, 0, value); });
        expect_refused(name);
    };
    set("Coverage", -1.0);
    set("Received", std::numeric_limits<double>::quiet_NaN());
    set("ReceivedSquared", -1e-30);
    set("PixelSize", 0.0);
    set("Averaging", 3.0);
    set("Directions", 5e9);
    set("ClusterCount", 49.0);
    set("Iterations", 21.0);
}

TEST_F(SumsFile, OfAnotherScene) {
    const Solution other = bake_to(under_a_sky(), small_bake(20));
    save_solution(other, {}, folder_ / "other.vtm");
    forge([&](vtkFieldData& fields) {
        fields.DeepCopy(
            from_vtp(files_below(folder_).at("other/sums.vtp"), "sums")->GetFieldData());
    });
    expect_refused("of another solution");
}

}  // namespace

}  // namespace transillum::test
