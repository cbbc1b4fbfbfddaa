// Files for other programs, read by what others read them with, or by their specification.
#include "random_solution.h"

#include <transillum/base/error.h>
#include <transillum/scene/load_scene.h>
#include <transillum/solution/save_radiance_mesh.h>

#include <gtest/gtest.h>
#include <vtkCellData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkStringArray.h>
#include <vtkXMLPolyDataReader.h>
#include <nlohmann/json.hpp>

#include <cstring>
#include <fstream>
#include <iterator>

namespace transillum::test {

namespace {

/// Two squares far from the origin, one an object.
RadianceMesh two_squares() {
    RadianceMesh mesh;
    mesh.objects = {"left <&>", "nothing", "right"};
    mesh.materials = {"red"};
    for (const double x : {1e6, 1e6 + 4.0}) {
        const auto first = static_cast<std::uint32_t>(mesh.positions.size());
        for (const auto& [i, j] : {std::pair{0, 0}, {1, 0}, {1, 1}, {0, 1}}) {
            mesh.positions.emplace_back(x + i, -1e6 + j, 0.125);
            mesh.radiance.emplace_back(10.0f * static_cast<float>(i), 20.0f, 0.0f);
            mesh.display.emplace_back(0.5f * static_cast<float>(i), 1.0f, 0.0f);
        }
        const std::uint32_t object = first == 0 ? 0 : 2;
        mesh.triangles.push_back({{first, first + 1, first + 2}, object, 0, 0});
        mesh.triangles.push_back({{first, first + 2, first + 3}, object, 0, 0});
    }
    mesh.exposure = -1.5;
    return mesh;
}

std::string bytes_of(const std::filesystem::path& path) {
    std::ifstream in(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

template <class T>
T at(const std::string& bytes, std::size_t offset) {
    T value;
    std::memcpy(&value, bytes.data() + offset, sizeof value);
    return value;
}

/// Positions of the faces' corners, in order.
void expect_geometry(const std::filesystem::path& path, const RadianceMesh& mesh) {
    Monitor silent;
    const Scene scene = load_scene(path, {}, silent);
    ASSERT_EQ(scene.polygons.size(), mesh.triangles.size());
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
        for (std::uint32_t c = 0; c < 3; ++c)
            EXPECT_EQ(scene.positions[scene.corners[scene.polygons[t].first_corner + c]],
                      mesh.positions[mesh.triangles[t].vertices[c]]);
}

TEST(RadianceMeshFiles, OfGltfHoldDisplayColoursToBeShownAsTheyAre) {
    const RadianceMesh mesh = two_squares();
    const auto path = fresh_folder() / "mesh.glb";
    save_radiance_mesh(mesh, path);
    expect_geometry(path, mesh);
    const std::string bytes = bytes_of(path);
    EXPECT_EQ(at<std::uint32_t>(bytes, 8), bytes.size());
    const auto json_size = at<std::uint32_t>(bytes, 12);
    const auto json = nlohmann::json::parse(bytes.substr(20, json_size));
    EXPECT_EQ(json["asset"]["extras"]["exposure"], -1.5);
    EXPECT_TRUE(json["materials"][0]["extensions"].contains("KHR_materials_unlit"));
    ASSERT_EQ(json["meshes"].size(), 2u);
    EXPECT_EQ(json["nodes"][0]["name"], "left <&>");
    EXPECT_EQ(json["nodes"][1]["name"], "right");
    const auto& attributes = json["meshes"][1]["primitives"][0]["attributes"];
    const auto& accessor = json["accessors"][attributes["COLOR_0"].get<std::size_t>()];
    EXPECT_EQ(accessor["count"], 4);
    const auto& view = json["bufferViews"][accessor["bufferView"].get<std::size_t>()];
    const std::size_t offset = 20 + json_size + 8 + view["byteOffset"].get<std::size_t>();
    for (std::size_t v = 0; v < 4; ++v)
        EXPECT_EQ(at<Spectrum>(bytes, offset + v * sizeof(Spectrum)), mesh.display[4 + v]);
}

TEST(RadianceMeshFiles, OfPlyHoldBytesAndRadiance) {
    const RadianceMesh mesh = two_squares();
    const auto path = fresh_folder() / "mesh.ply";
    save_radiance_mesh(mesh, path);
    expect_geometry(path, mesh);
    const std::string bytes = bytes_of(path), end = "end_header\n";
    const std::size_t first = bytes.find(end) + end.size(), stride = 3 * 8 + 3 + 3 * 4;
    EXPECT_EQ(bytes.size(), first + 8 * stride + 4 * 13);
    const auto* second = reinterpret_cast<const unsigned char*>(bytes.data()) + first + stride + 24;
    EXPECT_EQ(second[0], 188) << "0.5 by the curve of sRGB";
    EXPECT_EQ(second[1], 255);
    EXPECT_EQ(second[2], 0);
    EXPECT_EQ(at<Spectrum>(bytes, first + stride + 27), mesh.radiance[1]);
}

TEST(RadianceMeshFiles, OfVtkHoldArraysWithTheirNames) {
    const RadianceMesh mesh = two_squares();
    const auto path = fresh_folder() / "mesh.vtp";
    save_radiance_mesh(mesh, path);
    vtkNew<vtkXMLPolyDataReader> reader;
    reader->SetFileName(path.c_str());
    reader->Update();
    vtkPolyData& data = *reader->GetOutput();
    ASSERT_EQ(data.GetNumberOfCells(), 4);
    ASSERT_EQ(data.GetNumberOfPoints(), 8);
    for (vtkIdType v = 0; v < 8; ++v) {
        EXPECT_EQ(data.GetPoint(v)[0], mesh.positions[static_cast<std::size_t>(v)].x);
        EXPECT_EQ(data.GetPointData()->GetArray("Radiance")->GetComponent(v, 0),
                  mesh.radiance[static_cast<std::size_t>(v)].x);
    }
    EXPECT_EQ(data.GetCellData()->GetArray("Object")->GetComponent(3, 0), 2);
    auto* names =
        vtkStringArray::SafeDownCast(data.GetFieldData()->GetAbstractArray("ObjectNames"));
    ASSERT_NE(names, nullptr);
    EXPECT_EQ(names->GetValue(0), "left <&>");
}

TEST(RadianceMeshFiles, AreRefusedWhereThereIsNothingOrNoSuchFormat) {
    const auto folder = fresh_folder();
    EXPECT_THROW(save_radiance_mesh(two_squares(), folder / "mesh.obj"), UsageError);
    EXPECT_THROW(save_radiance_mesh({}, folder / "mesh.glb"), InputError);
    EXPECT_THROW(save_radiance_mesh(two_squares(), folder / "missing" / "mesh.glb"), IoError);
    EXPECT_TRUE(std::filesystem::is_empty(folder));
}

}  // namespace

}  // namespace transillum::test
