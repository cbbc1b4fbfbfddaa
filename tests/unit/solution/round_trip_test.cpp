#include "random_solution.h"

#include "solution/vtk_bytes.h"

#include <transillum/base/error.h>
#include <transillum/base/sampling.h>
#include <transillum/base/srgb.h>
#include <transillum/scene/photometry.h>
#include <transillum/solution/load_solution.h>

#include <gmock/gmock.h>

#include <cmath>
#include <limits>

namespace transillum::test {

namespace {

class RoundTrip : public testing::TestWithParam<Shape> {};

void spoil_texture(Solution& solution, void (*spoil)(Texture&)) {
    Texture texture = *solution.surface.textures[1];
    spoil(texture);
    solution.surface.textures[1] = std::make_shared<const Texture>(texture);
}

std::map<std::string, std::string> without_record(std::map<std::string, std::string> files) {
    files.erase("room/run.json");
    return files;
}

}  // namespace

TEST_P(RoundTrip, KeepsEveryField) {
    for (unsigned seed = 0; seed < 8; ++seed) {
        const Solution solution = random_solution(GetParam(), seed);
        const auto path = fresh_folder() / "room.vtm";
        save_solution(solution, {}, path);
        expect_equal(solution, load_solution(path));
    }
}

TEST_P(RoundTrip, GivesTheSameBytesAgain) {
    const auto first = fresh_folder(), second = fresh_folder(), third = fresh_folder();
    const Solution solution = random_solution(GetParam(), 7);
    save_solution(solution, {"bake a", 1, {{"load", 1.5}}}, first / "room.vtm");
    save_solution(solution, {"bake b", 8, {}}, second / "room.vtm");
    save_solution(load_solution(first / "room.vtm"), {}, third / "room.vtm");
    const auto files = without_record(files_below(first));
    const bool has_image = GetParam().environment == Environment::Kind::image;
    EXPECT_EQ(files.size(),
              5u + (GetParam().light_samples > 0) + has_image + (GetParam().uvs ? 3u : 0u));
    EXPECT_EQ(files, without_record(files_below(second)));
    EXPECT_EQ(files, without_record(files_below(third)));
}

INSTANTIATE_TEST_SUITE_P(
    Shapes, RoundTrip,
    testing::Values(Shape{}, Shape{.levels = {3}, .light_samples = 1},
                    Shape{.light_samples = 0, .uvs = true}, Shape{.cameras = 0, .one_sided = true},
                    Shape{.levels = {4, 0, 0, 1, 5, 2}, .light_samples = 40, .uvs = true},
                    Shape{.light_samples = 5, .lights = 5, .environment = Environment::Kind::clear},
                    Shape{.lights = 2, .environment = Environment::Kind::image},
                    Shape{.light_samples = 5, .light_vectors = true, .lights = 3},
                    Shape{.lit = false}, Shape{.levels = {}, .light_samples = 0},
                    Shape{.splits = 3, .norms = true}, Shape{.splits = 4, .lit = false},
                    Shape{.levels = {0, 3, 0, 1, 5, 0}, .splits = 2, .light_samples = 1}));

TEST(Solution, SurvivesAnyFileName) {
    for (const std::string name :
         {"a b", "<&>\"'", "&amp;", "Größe 光", "a.b", "100%25", "room.vtm"}) {
        const Solution solution = random_solution({}, 3);
        const auto path = fresh_folder() / (name + ".vtm");
        save_solution(solution, {"x", 2, {}}, path);
        expect_equal(solution, load_solution(path));
        EXPECT_EQ(load_run_record(path).command_line, "x") << name;
    }
}

TEST(Solution, DarkSidesCostNothing) {
    const Shape lit{.levels = {6, 6, 6}, .light_samples = 0};
    Shape dark = lit;
    dark.lit = false;
    const auto folder = fresh_folder();
    save_solution(random_solution(lit, 1), {}, folder / "lit.vtm");
    save_solution(random_solution(dark, 1), {}, folder / "dark.vtm");
    const auto files = files_below(folder);
    // 4 of 6 sides at 4^6 leaves hold at least 9 random floats a leaf; none of that is left in the
    // dark.
    EXPECT_GT(files.at("lit/radiance.vtp").size(), std::size_t{4 * 4096 * 9 * 3});
    EXPECT_LT(files.at("dark/radiance.vtp").size(), std::size_t{16384});
}

TEST(Solution, CoverageOfDarkSidesLoadsAsZero) {
    Solution solution = random_solution({.lit = false}, 1);
    solution.coverage.assign(solution.coverage.size(), 1.0f);
    const auto path = fresh_folder() / "room.vtm";
    save_solution(solution, {}, path);
    EXPECT_THAT(load_solution(path).coverage, testing::Each(0.0f));
}

TEST(Solution, KeepsTheTexturesThatAreUsed) {
    Solution solution = random_solution({.uvs = true}, 1);
    solution.surface.materials[0].textures.specular = -1;
    const auto kept = solution.surface.textures[2];
    const auto path = fresh_folder() / "room.vtm";
    save_solution(solution, {}, path);
    const SurfaceMesh surface = load_solution(path).surface;
    ASSERT_EQ(surface.textures.size(), 2u);
    EXPECT_EQ(surface.materials[0].textures.diffuse, 1);
    EXPECT_EQ(surface.materials[1].textures.roughness, 0);
    EXPECT_EQ(surface.materials[1].textures.emission, 1);
    EXPECT_TRUE(surface.textures[1]->texels == kept->texels);
}

TEST(Solution, BytesOfAnImageAreStoredAsBytes) {
    Solution solution = random_solution({.uvs = true}, 1);
    const auto path = fresh_folder() / "room.vtm";
    for (const float below_white : {1.0f, std::nextafter(1.0f, 0.0f)}) {
        Texture image{.width = 256, .height = 256};
        for (std::uint64_t i = 0; i < 65536; ++i)
            image.texels.emplace_back(
                linear_from_srgb(static_cast<float>(hash_bits(i) % 256) / 255.0f));
        image.texels[7].y = below_white;
        image.build_levels();
        solution.surface.textures[0] = std::make_shared<const Texture>(image);
        save_solution(solution, {}, path);
        expect_equal(solution, load_solution(path));
        const std::string file = files_below(path.parent_path()).at("room/texture-0.vti");
        EXPECT_EQ(from_vti(file, "texture-0.vti")->GetScalarType(),
                  below_white == 1.0f ? VTK_UNSIGNED_CHAR : VTK_FLOAT);
    }
}

TEST(Solution, RunRecordSurvives) {
    const RunRecord run{"transillum bake \"a b\".obj", 8, {{"load", 0.25}, {"transport", 1e-3}}};
    const auto path = fresh_folder() / "room.vtm";
    save_solution(random_solution({}, 1), run, path);
    const RunRecord loaded = load_run_record(path);
    EXPECT_EQ(loaded.command_line, run.command_line);
    EXPECT_EQ(loaded.threads, run.threads);
    EXPECT_EQ(loaded.seconds, run.seconds);
}

TEST(Solution, RunRecordOfBytesThatAreNoTextIsStillWritten) {
    const auto path = fresh_folder() / "room.vtm";
    save_solution(random_solution({}, 1), {"bake \xff\xfe.obj", 1, {}}, path);
    EXPECT_EQ(load_run_record(path).threads, 1);
}

TEST(Solution, RunRecordIsEmptyWhereThereIsNone) {
    const auto path = fresh_folder() / "room.vtm";
    EXPECT_EQ(load_run_record(path).threads, 0);
    EXPECT_EQ(load_run_record(path).command_line, "");
}

TEST(Solution, ContradictoryTreesAreNotSaved) {
    const std::vector<std::pair<std::string, void (*)(PatchHierarchy&)>> defects{
        {"contradict", [](PatchHierarchy& p) { ++p.mixed_roots[0].cells[0]; }},
        {"contradict", [](PatchHierarchy& p) { p.mixed_roots[0].cells.pop_back(); }},
        {"contradict", [](PatchHierarchy& p) { p.mixed_roots.emplace_back(); }},
        {"contradict", [](PatchHierarchy& p) { ++p.mixed_roots[0].leaves[0].i; }},
        {"subdivision: root ", [](PatchHierarchy& p) { p.mixed_roots[0].leaves[0].level = 9; }},
        {"root 2 tree: index 7", [](PatchHierarchy& p) { p.roots[2].mixed = 7; }},
        {"root 2 level", [](PatchHierarchy& p) { p.roots[2].level = 12; }}};
    for (const auto& [message, spoil] : defects) {
        const auto path = fresh_folder() / "room.vtm";
        Solution solution = random_solution({.splits = 3}, 1);
        ASSERT_FALSE(solution.patches.mixed_roots.empty());
        spoil(solution.patches);
        try {
            save_solution(solution, {}, path);
            ADD_FAILURE() << message;
        } catch (const Error& error) {
            EXPECT_THAT(error.what(), testing::HasSubstr(message));
        }
    }
}

TEST(Solution, UnsoundLightVectorsAreNotSaved) {
    const std::vector<std::pair<std::string, void (*)(DirectLight&)>> defects{
        {"light vector 0 first sample", [](DirectLight& d) { d.first_samples[0] = 1; }},
        {"light vector 1 first sample: not after", [](DirectLight& d) { d.first_samples[1] = 0; }},
        {"light vector 1 first sample: index 3 of 3",
         [](DirectLight& d) { d.first_samples[1] = 3; }},
        {"light vectors: ", [](DirectLight& d) { d.vectors.pop_back(); }},
        {"light vectors, entry 2",
         [](DirectLight& d) { d.vectors[2].z = std::numeric_limits<float>::infinity(); }},
        {"visibility, entry", [](DirectLight& d) { d.visibility.push_back(0.5f); }}};
    for (const auto& [message, spoil] : defects) {
        Solution solution = random_solution({.light_vectors = true}, 1);
        spoil(solution.direct);
        try {
            save_solution(solution, {}, fresh_folder() / "room.vtm");
            ADD_FAILURE() << message;
        } catch (const Error& error) {
            EXPECT_THAT(error.what(), testing::HasSubstr(message));
        }
    }
}

TEST(Solution, UnsoundIsNotSaved) {
    const std::vector<std::pair<std::string, void (*)(Solution&)>> defects{
        {"direct irradiance of patch 0",
         [](Solution& s) { s.direct_irradiance[0].y = std::numeric_limits<float>::quiet_NaN(); }},
        {"indirect irradiance of patch 1", [](Solution& s) { s.indirect_irradiance[1].x = -1.0f; }},
        {"standard error of patch", [](Solution& s) { s.standard_error.pop_back(); }},
        {"visibility, entry 2", [](Solution& s) { s.direct.visibility[2] = 1.5f; }},
        {"root 1 vertex: index 99 of 5",
         [](Solution& s) { s.surface.triangles[1].vertices[2] = 99; }},
        {"root 0 material", [](Solution& s) { s.surface.materials.clear(); }},
        {"light sample 0 root", [](Solution& s) { s.direct.samples[0].root = 3; }},
        {"light sample 1 light: index 4 of 0",
         [](Solution& s) {
             s.direct.samples[1].kind = LightSample::Kind::point;
             s.direct.samples[1].light = 4;
         }},
        {"light 0 intensity",
         [](Solution& s) { s.lighting.lights.resize(1), s.lighting.lights[0].intensity.y = -1; }},
        {"light 0 photometry, candela: 0 entries, expected 1",
         [](Solution& s) {
             s.lighting.lights.resize(1);
             s.lighting.lights[0].photometry =
                 std::make_shared<const Photometry>(Photometry{"", {0.0}, {0.0}, {}});
         }},
        {"environment image: 0 entries, expected 1",
         [](Solution& s) { s.lighting.environment.kind = Environment::Kind::image; }},
        {"camera 1 field of view", [](Solution& s) { s.cameras[1].vertical_fov = 180.0; }},
        {"root 1 first leaf", [](Solution& s) { s.patches.roots[1].first_leaf = 2; }},
        {"relative error",
         [](Solution& s) { s.relative_error = std::numeric_limits<double>::infinity(); }},
        {"texture 1 texel",
         [](Solution& s) { spoil_texture(s, [](Texture& t) { t.texels[0].z = -1.0f; }); }},
        {"texture 1 texels",
         [](Solution& s) { spoil_texture(s, [](Texture& t) { t.texels.pop_back(); }); }},
        {"texture 1 height",
         [](Solution& s) { spoil_texture(s, [](Texture& t) { t.height = 0; }); }},
        {"texture 1 is not there", [](Solution& s) { s.surface.textures[1] = nullptr; }},
        {"material 0 texture: 3", [](Solution& s) { s.surface.materials[0].textures.diffuse = 3; }},
        {"material 2 texture: -2",
         [](Solution& s) { s.surface.materials[2].textures.emission = -2; }},
        {"UVs: none", [](Solution& s) { s.surface.uvs.clear(); }},
        {"zero byte", [](Solution& s) { s.surface.objects[0] = std::string("a\0b", 3); }}};
    for (const auto& [message, spoil] : defects) {
        const auto folder = fresh_folder();
        Solution solution = random_solution({.uvs = true}, 1);
        spoil(solution);
        try {
            save_solution(solution, {}, folder / "room.vtm");
            ADD_FAILURE() << message;
        } catch (const Error& error) {
            EXPECT_THAT(error.what(), testing::HasSubstr(message));
        }
        EXPECT_TRUE(files_below(folder).empty());
    }
}

}  // namespace transillum::test
