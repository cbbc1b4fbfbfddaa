#include "random_solution.h"

#include "solution/index_file.h"
#include "solution/vtk_bytes.h"

#include <transillum/base/error.h>
#include <transillum/solution/load_solution.h>

#include <gmock/gmock.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkFieldData.h>

#include <fstream>
#include <functional>
#include <limits>

namespace transillum::test {

namespace fs = std::filesystem;

namespace {

void write(const fs::path& file, const std::string& bytes) {
    std::ofstream(file, std::ios::binary) << bytes;
}

class Damage : public testing::Test {
protected:
    Damage() : folder_(fresh_folder()), path_(folder_ / "room.vtm") {
        const Shape shape{.lights = 2, .environment = Environment::Kind::image};
        save_solution(random_solution(shape, 1), {"bake", 1, {}}, path_);
        files_ = files_below(folder_);
        files_.erase("room");
        files_.erase("room/run.json");
    }

    /// Loading fails with a typed error whose text names the file; VTK says nothing on its own.
    template <class E = InputError>
    void expect_refused(const std::string& file, const std::string& message = "") const {
        testing::internal::CaptureStderr();
        try {
            static_cast<void>(load_solution(path_));
            ADD_FAILURE() << "loaded: " << file << ' ' << message;
        } catch (const E& error) {
            EXPECT_THAT(error.what(), testing::HasSubstr(file));
            EXPECT_THAT(error.what(), testing::HasSubstr(message));
        }
        EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
    }

    /// Rewrites a piece, checksum and all: the damage that only the checks of values can find.
    void forge(const std::string& piece, const std::function<void(vtkPolyData&)>& change) const {
        std::vector<std::pair<std::string, std::string>> pieces;
        for (const char* name : {"radiance", "incoming", "lights", "environment", "surface"}) {
            std::string bytes = files_.at("room/" + std::string(name) + ".vtp");
            if (name == piece) {
                const auto data = from_vtp(bytes, name);
                change(*data);
                bytes = to_vtp(*data, name);
                write(folder_ / "room" / (piece + ".vtp"), bytes);
            }
            pieces.emplace_back(name, bytes);
        }
        write(path_, format_index(index_of("room", pieces)));
    }

    void restore() const {
        for (const auto& [name, bytes] : files_) write(folder_ / name, bytes);
    }

    fs::path folder_, path_;
    std::map<std::string, std::string> files_;
};

}  // namespace

TEST_F(Damage, TruncatedAnywhere) {
    for (const auto& [name, bytes] : files_) {
        const std::size_t step = bytes.size() / 40 + 1;
        for (std::size_t size = 0; size < bytes.size(); size += step) {
            write(folder_ / name, bytes.substr(0, size));
            expect_refused(name);
        }
        write(folder_ / name, bytes.substr(0, bytes.size() - 1));
        expect_refused(name);
        write(folder_ / name, bytes + " ");
        expect_refused(name);
        restore();
    }
    static_cast<void>(load_solution(path_));
}

TEST_F(Damage, AnyFlippedBitOfAPiece) {
    for (const auto& [name, bytes] : files_) {
        if (name == "room.vtm") continue;
        const std::size_t step = bytes.size() / 97 + 1;
        for (std::size_t at = 0; at < bytes.size(); at += step) {
            std::string damaged = bytes;
            damaged[at] = static_cast<char>(damaged[at] ^ (1 << (at % 8)));
            write(folder_ / name, damaged);
            expect_refused(name, "checksum");
        }
        restore();
    }
}

TEST_F(Damage, AnyFlippedBitOfTheIndex) {
    const std::string bytes = files_.at("room.vtm");
    for (std::size_t at = 0; at < bytes.size(); ++at) {
        std::string damaged = bytes;
        damaged[at] = static_cast<char>(damaged[at] ^ (1 << (at % 8)));
        write(path_, damaged);
        // A wrong name, folder or checksum shows only at the files.
        EXPECT_THROW(static_cast<void>(load_solution(path_)), Error) << "byte " << at;
    }
}

TEST_F(Damage, MissingFiles) {
    for (const auto& [name, bytes] : files_) {
        fs::remove(folder_ / name);
        expect_refused<IoError>(name, "No such file");
        restore();
    }
}

TEST_F(Damage, FolderInsteadOfFile) {
    fs::remove(path_);
    fs::create_directory(path_);
    expect_refused<IoError>("room.vtm", "Is a directory");
}

TEST_F(Damage, SolutionsMixedUp) {
    save_solution(random_solution({}, 2), {}, folder_ / "other.vtm");
    fs::copy_file(folder_ / "other" / "radiance.vtp", folder_ / "room" / "radiance.vtp",
                  fs::copy_options::overwrite_existing);
    expect_refused("radiance.vtp", "damaged");
}

TEST_F(Damage, ForeignFiles) {
    for (const char* text :
         {"", "v 0 0 0\n",
          "<?xml version=\"1.0\"?>\n<VTKFile type=\"vtkMultiBlockDataSet\" version=\"1.0\">\n"
          "<vtkMultiBlockDataSet><DataSet index=\"0\" file=\"a.vtp\"/></vtkMultiBlockDataSet>\n"
          "</VTKFile>\n"}) {
        write(path_, text);
        expect_refused("room.vtm", "not a transillum solution");
    }
}

TEST_F(Damage, NewerFormat) {
    std::string text = files_.at("room.vtm");
    const std::string format = "transillum_format=\"";
    text.replace(text.find(format) + format.size(), 1, "2");
    write(path_, text);
    expect_refused("room.vtm", "written by format 2, this program reads up to 1");
}

TEST_F(Damage, MissingBlock) {
    write(path_, format_index(index_of("room", {{"radiance", files_.at("room/radiance.vtp")}})));
    expect_refused("room.vtm", "block 'surface' is missing");
}

TEST_F(Damage, MissingArray) {
    forge("radiance", [](vtkPolyData& data) { data.GetCellData()->RemoveArray("Coverage"); });
    expect_refused("radiance.vtp", "array 'Coverage' is missing");
    restore();
    forge("surface", [](vtkPolyData& data) { data.GetFieldData()->RemoveArray("SettingValue"); });
    expect_refused("surface.vtp", "array 'SettingValue' is missing");
}

TEST_F(Damage, ArrayOfAnotherShape) {
    forge("radiance", [](vtkPolyData& data) {
        data.GetCellData()->RemoveArray("DirectIrradiance");
        data.GetCellData()->GetArray("Area")->SetName("DirectIrradiance");
    });
    expect_refused("radiance.vtp", "array 'DirectIrradiance' is");
}

TEST_F(Damage, ValuesOutOfRange) {
    const auto forge_cell = [this](const char* piece, const char* array, double value) {
        forge(piece, [=](vtkPolyData& data) {
            data.GetCellData()->GetArray(array)->SetComponent(1, 0, value);
        });
    };
    forge_cell("radiance", "StandardError", std::numeric_limits<double>::quiet_NaN());
    expect_refused("room.vtm", "standard error of patch");
    restore();
    forge_cell("radiance", "Root", 77);
    expect_refused("radiance.vtp", "root 77 of 3");
    restore();
    forge_cell("radiance", "Leaf", 1000);
    expect_refused("radiance.vtp", "out of order");
    restore();
    forge_cell("incoming", "Side", 2);
    expect_refused("incoming.vtp", "neither 0 nor 1");
    restore();
    forge_cell("surface", "Level", 12);
    expect_refused("surface.vtp", "outside [0, 11]");
    restore();
    forge_cell("surface", "Material", 9);
    expect_refused("room.vtm", "root 1 material: index 9 of 3");
}

TEST_F(Damage, LightsOutOfRange) {
    const auto forge_field = [this](const char* piece, const char* array, double value) {
        restore();
        forge(piece, [=](vtkPolyData& data) {
            data.GetFieldData()->GetArray(array)->SetComponent(0, 0, value);
        });
    };
    forge_field("lights", "LightKind", 3);
    expect_refused("room.vtm", "light 0 kind: index 3 of 3");
    forge_field("lights", "LightPhotometry", 7);
    expect_refused("lights.vtp", "array 'LightPhotometry': 7 of 1");
    forge_field("lights", "PhotometryCandelaCount", 4e9);
    expect_refused("lights.vtp", "array 'PhotometryCandela' is");
    forge_field("lights", "PhotometryVertical", 200.0);
    expect_refused("room.vtm", "photometry, vertical angle");
    forge_field("lights", "EnvironmentKind", 5);
    expect_refused("room.vtm", "environment kind: index 5 of 5");
    forge_field("environment", "ImageSize", -1);
    expect_refused("environment.vtp", "array 'ImageSize': -1 x 3 pixels");
    forge_field("environment", "ImageSize", 2e9);
    expect_refused("environment.vtp");
    forge_field("environment", "ImageRadiance", std::numeric_limits<double>::infinity());
    expect_refused("room.vtm", "environment texel");
}

TEST_F(Damage, RunRecord) {
    for (const char* text : {"", "{", "[]", "{\"threads\": \"many\"}"}) {
        write(folder_ / "room" / "run.json", text);
        EXPECT_THROW(static_cast<void>(load_run_record(path_)), InputError) << text;
    }
}

}  // namespace transillum::test
