// Light adds up: emitters baked alone, dimmed and tinted.
#include "random_solution.h"

#include "solution/index_file.h"
#include "solution/vtk_bytes.h"
#include "support/scene_builder.h"

#include <transillum/base/error.h>
#include <transillum/solution/bake_emitters.h>
#include <transillum/solution/load_solution.h>

#include <gmock/gmock.h>
#include <vtkDataArray.h>
#include <vtkFieldData.h>

#include <fstream>
#include <functional>

namespace transillum::test {

namespace fs = std::filesystem;
using namespace testing_support;

namespace {

/// An open box under a sky, with a small lamp, a glowing wall of another colour, a spot, and a
/// glossy floor.
Scene lit_box() {
    SceneBuilder b;
    const auto lamp = b.material(Spectrum(0.1f), Spectrum(9.0f, 6.0f, 3.0f));
    const auto glow = b.material(Spectrum(0.5f), Spectrum(0.1f, 0.2f, 0.4f));
    const auto floor = b.material({0.3f, 0.2f, 0.2f});
    b.scene.materials[0].diffuse = {0.7f, 0.5f, 0.3f};
    b.scene.materials[lamp].name = "lamp";
    b.scene.materials[glow].name = "glow";
    b.scene.materials[floor].specular = Spectrum(0.4f);
    b.scene.materials[floor].lobe = Lobe::max_phong;
    b.scene.materials[floor].shininess = 8.0f;
    b.box({0, 0, 0}, {1, 1, 1}, Facing::inwards, 0, 1);
    b.scene.polygons[0].material = floor;
    b.scene.polygons[1].material = glow;
    b.polygon({{0.4, 0.4, 0.9}, {0.4, 0.5, 0.9}, {0.5, 0.5, 0.9}, {0.5, 0.4, 0.9}}, lamp);
    PunctualLight spot;
    spot.name = "spot";
    spot.position = {0.2, 0.2, 0.8};
    spot.intensity = {0.1f, 0.2f, 0.1f};
    b.scene.lighting.lights.push_back(spot);
    b.scene.lighting.environment.kind = Environment::Kind::uniform;
    b.scene.lighting.environment.radiance_scale = {0.1f, 0.2f, 0.3f};
    return b.scene;
}

BakeOptions small_bake(Averaging averaging) {
    BakeOptions options;
    options.subdivision.leaf_target = 150;
    options.light.samples = 4;
    options.hemicube_resolution = 32;
    options.resolution = 64;
    options.iteration.iterations = 256;
    options.iteration.averaging = averaging;
    return options;
}

EmitterSolution bake_apart(const Scene& scene, Averaging averaging) {
    Monitor silent;
    return bake_emitters(scene, small_bake(averaging), Workers(2), silent);
}

Solution bake_together(const Scene& scene, Averaging averaging) {
    Monitor silent;
    return bake(scene, small_bake(averaging), Workers(2), silent);
}

double mean(const Solution& s, const std::vector<Spectrum>& irradiance) {
    double sum = 0.0;
    for (std::uint32_t p = 0; p < s.patches.leaf_count; ++p) sum += luminance(irradiance[p]);
    return sum / s.patches.leaf_count;
}

/// Largest and root mean square deviation over the mean.
std::pair<double, double> deviation(const Solution& a, const Solution& b) {
    double largest = 0.0, squares = 0.0;
    for (std::uint32_t p = 0; p < a.patches.patch_count(); ++p) {
        const SpectrumSum d(a.indirect_irradiance[p] - b.indirect_irradiance[p]);
        for (int c = 0; c < channel_count; ++c) largest = std::max(largest, std::abs(d[c]));
        squares += glm::dot(d, d) / (channel_count * a.patches.patch_count());
    }
    const double scale = mean(b, b.indirect_irradiance);
    return {largest / scale, std::sqrt(squares) / scale};
}

TEST(Emitters, AreMaterialsLightsAndEnvironment) {
    const EmitterSolution s = bake_apart(lit_box(), Averaging::paper);
    std::vector<std::string> names;
    for (const EmitterPart& part : s.parts) names.push_back(part.emitter.name);
    EXPECT_THAT(names, testing::UnorderedElementsAre("lamp", "glow", "spot", "environment"));
}

// 1/m averages are linear. Every direction rounds what is sent to floats, 2^-24 of it, some of them
// more or less at random; the albedo of at most 0.7 makes that 1 / 0.3 of it, of four emitters.
TEST(Emitters, AddUpToTheCommonBake) {
    const EmitterSolution apart = bake_apart(lit_box(), Averaging::paper);
    const Solution together = bake_together(lit_box(), Averaging::paper);
    const double rounding = 4 * 0x1p-24 / 0.3;
    EXPECT_LT(deviation(apart.all, together).first, 4 * rounding);
    EXPECT_EQ(apart.all.direct_irradiance, together.direct_irradiance);
    EXPECT_EQ(apart.all.coverage, together.coverage);
    EXPECT_EQ(apart.all.scene_hash, together.scene_hash);
    const auto near = [](const SpectrumSum& a, const SpectrumSum& b) {
        for (int c = 0; c < channel_count; ++c) EXPECT_NEAR(a[c], b[c], 1e-5 * b[c]);
    };
    near(apart.all.balance.emitted, together.balance.emitted);
    near(apart.all.balance.entered, together.balance.entered);
    near(apart.all.balance.absorbed, together.balance.absorbed);
    near(apart.all.balance.escaped, together.balance.escaped);
}

// The energy balance is not linear before it has converged.
TEST(Emitters, AddUpWithinTheErrorWhereEnergyIsBalanced) {
    const EmitterSolution apart = bake_apart(lit_box(), Averaging::balanced);
    const Solution together = bake_together(lit_box(), Averaging::balanced);
    EXPECT_LT(deviation(apart.all, together).second, together.relative_error);
    EXPECT_GE(apart.all.relative_error, 0.0);
}

// Dimming and tinting is what a bake of the changed scene gives.
TEST(Emitters, AreScaledWithoutABake) {
    EmitterSolution s = bake_apart(lit_box(), Averaging::paper);
    Scene changed = lit_box();
    const Spectrum tint(0.5f, 1.0f, 3.0f), dim(0.25f), off(0.0f), blue(1.0f, 1.5f, 2.0f);
    changed.materials[1].emission *= dim;
    changed.materials[2].emission *= tint;
    changed.lighting.lights[0].intensity *= off;
    changed.lighting.environment.radiance_scale *= blue;
    scale_emitter(s, "lamp", dim);
    scale_emitter(s, "glow", tint);
    scale_emitter(s, "spot", off);
    scale_emitter(s, "environment", blue);
    const Solution baked = bake_together(changed, Averaging::paper);
    EXPECT_LT(deviation(s.all, baked).first, 16 * 4 * 0x1p-24 / 0.3);
    EXPECT_EQ(s.all.direct_irradiance, baked.direct_irradiance);
    EXPECT_EQ(s.all.scene_hash, baked.scene_hash);
    for (std::uint32_t p = 0; p < baked.patches.patch_count(); ++p)
        EXPECT_EQ(s.all.emission(p), baked.emission(p));
}

TEST(Emitters, AreNamedWhereOneIsUnknown) {
    EmitterSolution s = bake_apart(lit_box(), Averaging::paper);
    try {
        scale_emitter(s, "lump", Spectrum(1.0f));
        ADD_FAILURE();
    } catch (const UsageError& error) {
        EXPECT_THAT(error.what(), testing::HasSubstr("lamp"));
    }
    EXPECT_THROW(scale_emitter(s, "lamp", Spectrum(-1.0f)), UsageError);
}

class EmitterFiles : public testing::Test {
protected:
    EmitterFiles() : folder_(fresh_folder()), path_(folder_ / "box.vtm") {
        save_emitter_solution(solution_, {}, path_);
    }
    ~EmitterFiles() override { fs::remove_all(folder_); }

    void expect_refused(const std::function<void(vtkFieldData&)>& change,
                        const std::string& message) const {
        const auto data = from_vtp(bytes_, "emitter-02");
        change(*data->GetFieldData());
        const std::string forged = to_vtp(*data, "emitter-02");
        IndexFile index = parse_index(files_below(folder_).at("box.vtm"), path_);
        for (IndexedPiece& each : index.pieces)
            if (each.name == "emitter-02")
                each = index_of("box", {{"emitter-02", forged}}).pieces[0];
        std::ofstream(folder_ / "box/emitter-02.vtp", std::ios::binary) << forged;
        std::ofstream(path_, std::ios::binary) << format_index(index);
        try {
            static_cast<void>(load_emitter_solution(path_));
            ADD_FAILURE() << "loaded: " << message;
        } catch (const InputError& error) {
            EXPECT_THAT(error.what(), testing::HasSubstr("emitter-02.vtp"));
            EXPECT_THAT(error.what(), testing::HasSubstr(message));
        }
    }

    const EmitterSolution solution_ = bake_apart(lit_box(), Averaging::balanced);
    fs::path folder_, path_;
    const std::string bytes_ = [this] {
        save_emitter_solution(solution_, {}, path_);
        return files_below(folder_).at("box/emitter-02.vtp");
    }();
};

TEST_F(EmitterFiles, HoldEveryPart) {
    const EmitterSolution loaded = load_emitter_solution(path_);
    expect_equal(loaded.all, load_solution(path_));
    ASSERT_EQ(loaded.parts.size(), solution_.parts.size());
    for (std::size_t i = 0; i < loaded.parts.size(); ++i) {
        const EmitterPart &a = solution_.parts[i], &b = loaded.parts[i];
        EXPECT_EQ(a.emitter.name, b.emitter.name);
        EXPECT_EQ(a.emitter.kind, b.emitter.kind);
        EXPECT_EQ(a.emitter.index, b.emitter.index);
        EXPECT_EQ(a.indirect_irradiance, b.indirect_irradiance);
        EXPECT_EQ(a.standard_error, b.standard_error);
        EXPECT_EQ(a.glossy_elements, b.glossy_elements);
        EXPECT_EQ(a.balance.absorbed, b.balance.absorbed);
    }
}

// Scaled by one, what was loaded is what was saved.
TEST_F(EmitterFiles, StayTheSameByAFactorOfOne) {
    const auto before = files_below(folder_);
    EmitterSolution loaded = load_emitter_solution(path_);
    scale_emitter(loaded, "lamp", Spectrum(1.0f));
    save_emitter_solution(loaded, {}, path_);
    for (const auto& [name, bytes] : files_below(folder_))
        EXPECT_TRUE(before.at(name) == bytes) << name;
}

TEST_F(EmitterFiles, DamageIsNamed) {
    for (const char* name : {"Name", "Kind", "Index", "IndirectIrradiance", "EnergyEscaped"})
        expect_refused([&](vtkFieldData& f) { f.RemoveArray(name); }, name);
    const auto set = [&](const char* name, double value) {
        expect_refused([&](vtkFieldData& f) { f.GetArray(name)->SetComponent(0, 0, value); }, name);
    };
    set("Kind", 3);
    set("Index", 4);
    set("StandardError", -1.0);
    set("RelativeError", -1.0);
}

TEST_F(EmitterFiles, AreNotThereUnlessKept) {
    Solution plain = solution_.all;
    save_solution(plain, {}, path_);
    EXPECT_THROW(static_cast<void>(load_emitter_solution(path_)), InputError);
}

}  // namespace

}  // namespace transillum::test
