// Groups of bands beside a solution: what goes in comes out, and damage is named.
#include "random_solution.h"

#include "solution/index_file.h"
#include "solution/vtk_bytes.h"

#include <transillum/base/error.h>
#include <transillum/solution/load_solution.h>

#include <gmock/gmock.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkFieldData.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>
#include <vtkXMLMultiBlockDataReader.h>

#include <fstream>
#include <functional>
#include <random>

namespace transillum::test {

namespace fs = std::filesystem;

namespace {

std::vector<Spectrum> random_spectra(std::size_t count, std::mt19937& bits) {
    std::uniform_real_distribution<float> number;
    std::vector<Spectrum> result(count);
    for (Spectrum& s : result)
        for (int c = 0; c < 3; ++c) s[c] = number(bits);
    return result;
}

/// A multiple of three and one more: the last group is not full.
SpectralSolution random_spectral(unsigned seed, int bands = 10) {
    const Shape shape{.uvs = true, .lights = 1, .environment = Environment::Kind::image};
    SpectralSolution result{random_solution(shape, seed), bands, {}};
    std::mt19937 bits(seed);
    for (int g = 0; g < Bands(bands).groups(); ++g) {
        BandGroup group;
        for (const Material& m : result.rgb.surface.materials) {
            const auto colours = random_spectra(3, bits);
            group.materials.push_back({colours[0], colours[1] + Spectrum(0.1f), colours[2]});
            (void)m;
        }
        const std::size_t patches = result.rgb.patches.patch_count();
        group.direct_irradiance = random_spectra(patches, bits);
        group.indirect_irradiance = random_spectra(patches, bits);
        group.standard_error = random_spectra(patches, bits);
        group.glossy_elements = random_spectra(result.rgb.glossy.element_count, bits);
        result.groups.push_back(std::move(group));
    }
    return result;
}

void write(const fs::path& file, const std::string& bytes) {
    std::ofstream(file, std::ios::binary) << bytes;
}

class SpectralFiles : public testing::Test {
protected:
    SpectralFiles() : folder_(fresh_folder()), path_(folder_ / "room.vtm") {
        save_spectral_solution(spectral_, {"bake", 1, {}}, path_);
    }

    template <class E = InputError>
    void expect_refused(const std::string& file, const std::string& message) const {
        try {
            static_cast<void>(load_spectral_solution(path_));
            ADD_FAILURE() << "loaded: " << file << ' ' << message;
        } catch (const E& error) {
            EXPECT_THAT(error.what(), testing::HasSubstr(file));
            EXPECT_THAT(error.what(), testing::HasSubstr(message));
        }
    }

    [[nodiscard]] std::string read(const std::string& name) const {
        return files_below(folder_).at(name);
    }

    /// Puts bytes in the place of a piece, the index with them.
    void replace(const std::string& piece, const std::string& bytes) const {
        IndexFile index = parse_index(read("room.vtm"), path_);
        for (IndexedPiece& each : index.pieces)
            if (each.name == piece) each = index_of("room", {{piece, bytes}}).pieces[0];
        write(folder_ / "room" / file_of_piece(piece), bytes);
        write(path_, format_index(index));
    }

    void forge(const std::string& piece, const std::function<void(vtkFieldData&)>& change) const {
        const auto data = from_vtp(read("room/" + file_of_piece(piece)), piece);
        change(*data->GetFieldData());
        replace(piece, to_vtp(*data, piece));
    }

    const SpectralSolution spectral_ = random_spectral(1);
    fs::path folder_, path_;
};

TEST_F(SpectralFiles, HoldEveryGroup) {
    const SpectralSolution loaded = load_spectral_solution(path_);
    expect_equal(spectral_.rgb, loaded.rgb);
    EXPECT_EQ(loaded.bands, 10);
    ASSERT_EQ(loaded.groups.size(), 4u);
    for (std::size_t g = 0; g < 4; ++g) {
        const BandGroup &a = spectral_.groups[g], &b = loaded.groups[g];
        EXPECT_EQ(a.direct_irradiance, b.direct_irradiance);
        EXPECT_EQ(a.indirect_irradiance, b.indirect_irradiance);
        EXPECT_EQ(a.standard_error, b.standard_error);
        EXPECT_EQ(a.glossy_elements, b.glossy_elements);
        ASSERT_EQ(a.materials.size(), b.materials.size());
        for (std::size_t i = 0; i < a.materials.size(); ++i) {
            EXPECT_EQ(a.materials[i].diffuse, b.materials[i].diffuse);
            EXPECT_EQ(a.materials[i].specular, b.materials[i].specular);
            EXPECT_EQ(a.materials[i].emission, b.materials[i].emission);
        }
        expect_equal(solution_of_group(spectral_, static_cast<int>(g)),
                     solution_of_group(loaded, static_cast<int>(g)));
    }
}

TEST_F(SpectralFiles, AreAnOrdinarySolutionToOthers) {
    expect_equal(spectral_.rgb, load_solution(path_));
}

TEST_F(SpectralFiles, AreNoBlocksToViewers) {
    testing::internal::CaptureStderr();
    vtkNew<vtkXMLMultiBlockDataReader> reader;
    reader->SetFileName(path_.c_str());
    reader->Update();
    EXPECT_EQ(vtkMultiBlockDataSet::SafeDownCast(reader->GetOutput())->GetNumberOfBlocks(), 5u)
        << "radiance, incoming, lights, environment, surface";
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

TEST_F(SpectralFiles, ShowRadianceOfTheGroups) {
    const auto shown = from_vtp(read("room/radiance.vtp"), "radiance");
    vtkCellData& cells = *shown->GetCellData();
    vtkDataArray& radiance = *cells.GetArray("Radiance");
    const Bands bands(10);
    std::vector<SpectrumSum> expected(spectral_.rgb.patches.patch_count(), SpectrumSum(0.0));
    for (int g = 0; g < bands.groups(); ++g) {
        const Solution s = solution_of_group(spectral_, g);
        for (std::uint32_t p = 0; p < s.patches.patch_count(); ++p)
            expected[p] +=
                bands.rgb_from_group(g) *
                SpectrumSum(s.emission(p) + s.direct_radiance(p) + s.finite_element_radiance(p));
    }
    vtkIdType cell = 0;
    for (; cell < radiance.GetNumberOfTuples(); ++cell) {
        const auto root = static_cast<std::uint32_t>(cells.GetArray("Root")->GetTuple1(cell));
        const auto leaf = static_cast<std::uint32_t>(cells.GetArray("Leaf")->GetTuple1(cell));
        const bool back = cells.GetArray("Side")->GetTuple1(cell) != 0.0;
        const PatchHierarchy& patches = spectral_.rgb.patches;
        const std::uint32_t p =
            patches.roots[root].first_leaf + leaf + (back ? patches.leaf_count : 0);
        for (int c = 0; c < 3; ++c)
            EXPECT_NEAR(radiance.GetComponent(cell, c), expected[p][c],
                        1e-5 * (1.0 + std::abs(expected[p][c])));
    }
    EXPECT_GT(cell, 0);
}

TEST_F(SpectralFiles, GiveWayToASolutionInRgb) {
    save_solution(spectral_.rgb, {}, path_);
    const SpectralSolution loaded = load_spectral_solution(path_);
    EXPECT_EQ(loaded.bands, 0);
    EXPECT_TRUE(loaded.groups.empty());
    for (const auto& [name, bytes] : files_below(folder_))
        EXPECT_EQ(name.find("bands"), std::string::npos);
    save_spectral_solution(spectral_, {}, path_);
    EXPECT_EQ(load_spectral_solution(path_).groups.size(), 4u);
}

TEST_F(SpectralFiles, DependOnTheSolutionAlone) {
    const auto before = files_below(folder_);
    save_spectral_solution(spectral_, {"bake", 1, {}}, path_);
    EXPECT_EQ(files_below(folder_), before);
}

TEST_F(SpectralFiles, AreNotSavedUnsound) {
    for (const float bad : {-1.0f, std::numeric_limits<float>::infinity()}) {
        SpectralSolution unsound = spectral_;
        unsound.groups[2].indirect_irradiance[0].y = bad;
        EXPECT_THROW(save_spectral_solution(unsound, {}, path_), Error);
        unsound = spectral_;
        unsound.groups[2].direct_irradiance.pop_back();
        EXPECT_THROW(save_spectral_solution(unsound, {}, path_), Error);
    }
}

TEST_F(SpectralFiles, NameTheDamagedGroup) {
    const std::string bytes = read("room/bands-03.vtp");
    std::string damaged = bytes;
    damaged[damaged.size() / 2] ^= 1;
    write(folder_ / "room" / "bands-03.vtp", damaged);
    expect_refused("bands-03.vtp", "damaged: its bytes do not match");
    write(folder_ / "room" / "bands-03.vtp", bytes.substr(0, bytes.size() / 2));
    expect_refused("bands-03.vtp", "damaged: ");
    fs::remove(folder_ / "room" / "bands-03.vtp");
    expect_refused<IoError>("bands-03.vtp", "cannot be read");
    // Who needs no bands does not mind.
    expect_equal(spectral_.rgb, load_solution(path_));
}

TEST_F(SpectralFiles, NameTheMissingGroup) {
    IndexFile index = parse_index(read("room.vtm"), path_);
    std::erase_if(index.pieces, [](const IndexedPiece& p) { return p.name == "bands-04"; });
    write(path_, format_index(index));
    expect_refused("room.vtm", "the block 'bands-04' is missing");
}

TEST_F(SpectralFiles, NameTheGroupOfOthers) {
    replace("bands-02", read("room/bands-01.vtp"));
    expect_refused("bands-02.vtp", "its bands are not those of group 2 of 4");
    const fs::path other = fresh_folder() / "room.vtm";
    save_spectral_solution(random_spectral(1, 12), {}, other);
    replace("bands-02", files_below(other.parent_path()).at("room/bands-02.vtp"));
    expect_refused("bands-02.vtp", "its bands are not those of group 2 of 4");
    save_spectral_solution(random_spectral(2), {}, other);
    replace("bands-02", files_below(other.parent_path()).at("room/bands-02.vtp"));
    expect_refused("bands-02.vtp", "is of the scene");
}

TEST_F(SpectralFiles, NameTheForgedArray) {
    const auto set = [](const char* name, double value) {
        return [=](vtkFieldData& fields) { fields.GetArray(name)->SetComponent(0, 0, value); };
    };
    const std::string bytes = read("room/bands-01.vtp");
    for (const double bad : {-1.0, std::numeric_limits<double>::quiet_NaN()})
        for (const char* name : {"IndirectIrradiance", "DirectIrradiance", "StandardError",
                                 "MaterialDiffuse", "MaterialEmission"}) {
            forge("bands-01", set(name, bad));
            expect_refused("bands-01.vtp", std::string("array '") + name + "', entry 0");
            replace("bands-01", bytes);
        }
    forge("bands-01", set("BandCount", 7));
    expect_refused("bands-01.vtp", "array 'BandCount': 7 bands; accepted: 8 to 60");
    replace("bands-01", bytes);
    forge("bands-01", [](vtkFieldData& fields) { fields.RemoveArray("StandardError"); });
    expect_refused("bands-01.vtp", "StandardError");
    replace("bands-01", bytes);
    forge("bands-01",
          [](vtkFieldData& fields) { fields.GetArray("DirectIrradiance")->SetNumberOfTuples(3); });
    expect_refused("bands-01.vtp", "DirectIrradiance");
}

}  // namespace
}  // namespace transillum::test
