#include "random_solution.h"

#include "solution/index_file.h"
#include "solution/vtk_bytes.h"

#include <transillum/base/error.h>
#include <transillum/solution/load_solution.h>

#include <gmock/gmock.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkFieldData.h>
#include <vtkNew.h>
#include <vtkPointData.h>

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
        const Shape shape{
            .splits = 2, .uvs = true, .lights = 2, .environment = Environment::Kind::image};
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
        const auto data = from_vtp(files_.at("room/" + piece + ".vtp"), piece);
        change(*data);
        replace(piece, to_vtp(*data, piece));
    }
    void forge_image(const std::string& piece,
                     const std::function<void(vtkImageData&)>& change) const {
        const auto data = from_vti(files_.at("room/" + piece + ".vti"), piece);
        change(*data);
        replace(piece, to_vti(*data, piece));
    }
    void replace(const std::string& piece, const std::string& forged) const {
        std::vector<std::pair<std::string, std::string>> pieces;
        for (const char* name : {"radiance", "incoming", "lights", "environment", "surface",
                                 "texture-0", "texture-1", "texture-2"})
            pieces.emplace_back(name,
                                name == piece ? forged : files_.at("room/" + file_of_piece(name)));
        write(folder_ / "room" / file_of_piece(piece), forged);
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

TEST_F(Damage, AnotherFormat) {
    std::string text = files_.at("room.vtm");
    const std::string format = "transillum_format=\"";
    for (const int other : {solution_format_version - 1, solution_format_version + 1}) {
        text.replace(text.find(format) + format.size(), 1, std::to_string(other));
        write(path_, text);
        expect_refused("room.vtm", "written by format " + std::to_string(other) +
                                       ", this program reads format " +
                                       std::to_string(solution_format_version));
    }
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
    expect_refused("surface.vtp", "subdivision level 12; accepted: 0 to 11");
    restore();
    forge_cell("surface", "Material", 9);
    expect_refused("surface.vtp", "root 1 material: index 9 of 3");
}

TEST_F(Damage, TreesThatAreNone) {
    const auto forge_number = [this](bool of_cells, const char* array, int index, int change) {
        forge("surface", [=](vtkPolyData& data) {
            vtkDataArray* numbers = of_cells ? data.GetCellData()->GetArray(array)
                                             : data.GetFieldData()->GetArray(array);
            numbers->SetComponent(index, 0, numbers->GetComponent(index, 0) + change);
        });
    };
    for (const int root : {0, 1, 2})
        for (const int change : {-1, 1}) {
            forge_number(true, "LeafCount", root, change);
            expect_refused("surface.vtp", "root ");
            forge_number(true, "Level", root, change);
            expect_refused("surface.vtp", "root ");
        }
    for (const int leaf : {0, 1, 5, 20})
        for (const int change : {-1, 1, 100}) {
            forge_number(false, "LeafLevel", leaf, change);
            expect_refused("surface.vtp", "root ");
        }
    forge("surface", [](vtkPolyData& data) { data.GetFieldData()->RemoveArray("LeafLevel"); });
    expect_refused("surface.vtp", "array 'LeafLevel' is missing");
    restore();
    static_cast<void>(load_solution(path_));
}

TEST_F(Damage, OfTextures) {
    const auto forge_field = [this](const char* array, double value) {
        forge_image("texture-2", [=](vtkImageData& image) {
            image.GetFieldData()->GetArray(array)->SetComponent(0, 0, value);
        });
    };
    forge_field("WrapU", 3);
    expect_refused("texture-2.vti", "array 'WrapU': 3, at most 2");
    restore();
    forge_field("Encoding", 7);
    expect_refused("texture-2.vti", "array 'Encoding': 7, at most 2");
    restore();
    forge_field("Encoding", 1);
    expect_refused("texture-2.vti", "array 'Texels' is");
    restore();
    for (const double value : {-1.0, std::numeric_limits<double>::quiet_NaN()}) {
        forge_image("texture-2", [=](vtkImageData& image) {
            image.GetPointData()->GetArray("Texels")->SetComponent(0, 1, value);
        });
        expect_refused("room.vtm", "texture 2 texel");
        restore();
    }
    forge_image("texture-0", [](vtkImageData& image) {
        vtkNew<vtkImageData> empty;
        image.DeepCopy(empty);
    });
    expect_refused("texture-0.vti", "expected a flat one");
    restore();
    forge_image("texture-0",
                [](vtkImageData& image) { image.GetFieldData()->RemoveArray("Name"); });
    expect_refused("texture-0.vti", "array 'Name' is missing");
    restore();
    replace("texture-0", files_.at("room/surface.vtp"));
    expect_refused("texture-0.vti", "VTK cannot read");
}

TEST_F(Damage, OfTextureIndices) {
    const auto forge_field = [this](const char* array, double value) {
        forge("surface", [=](vtkPolyData& data) {
            data.GetFieldData()->GetArray(array)->SetComponent(0, 0, value);
        });
    };
    forge_field("MaterialTextures", 3);
    expect_refused("room.vtm", "material 0 texture: 3");
    restore();
    forge_field("TextureCount", 4);
    expect_refused("room.vtm", "the block 'texture-3' is missing");
    restore();
    forge_field("TextureCount", 4e9);
    expect_refused("surface.vtp", "array 'TextureCount': 4000000000");
    restore();
    forge_field("TextureCount", 1);
    expect_refused("room.vtm", "material 0 texture: 2");
}

TEST_F(Damage, RunRecord) {
    for (const char* text : {"", "{", "[]", "{\"threads\": \"many\"}"}) {
        write(folder_ / "room" / "run.json", text);
        EXPECT_THROW(static_cast<void>(load_run_record(path_)), InputError) << text;
    }
}

}  // namespace transillum::test
