/// What ParaView sees: the solution through VTK's own multi-block reader.
#include "random_solution.h"

#include <transillum/solution/save_solution.h>

#include <gmock/gmock.h>
#include <vtkCellData.h>
#include <vtkCompositeDataSet.h>
#include <vtkDataArray.h>
#include <vtkInformation.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkXMLMultiBlockDataReader.h>
#include <glm/geometric.hpp>

#include <cmath>
#include <set>

namespace transillum::test {

namespace {

struct Blocks {
    explicit Blocks(const Solution& solution) {
        const auto path = fresh_folder() / "a <room>.vtm";
        save_solution(solution, {}, path);
        reader->SetFileName(path.c_str());
        reader->Update();
        auto* root = vtkMultiBlockDataSet::SafeDownCast(reader->GetOutput());
        for (unsigned i = 0; i < root->GetNumberOfBlocks(); ++i) {
            names.emplace_back(root->GetMetaData(i)->Get(vtkCompositeDataSet::NAME()));
            pieces[names.back()] = vtkPolyData::SafeDownCast(root->GetBlock(i));
        }
    }
    vtkNew<vtkXMLMultiBlockDataReader> reader;
    std::vector<std::string> names;
    std::map<std::string, vtkPolyData*> pieces;
};

std::vector<std::string> array_names(vtkFieldData& fields) {
    std::vector<std::string> names;
    for (int i = 0; i < fields.GetNumberOfArrays(); ++i) {
        names.emplace_back(fields.GetAbstractArray(i)->GetName());
    }
    return names;
}

glm::dvec3 point(vtkPolyData& data, vtkIdType i) {
    const double* p = data.GetPoint(i);
    return {p[0], p[1], p[2]};
}

/// Twice the area times the normal.
glm::dvec3 cell_vector(vtkPolyData& data, vtkIdType cell) {
    vtkIdType size = 0;
    const vtkIdType* corners = nullptr;
    data.GetCellPoints(cell, size, corners);
    EXPECT_EQ(size, 3);
    const glm::dvec3 a = point(data, corners[0]);
    return glm::cross(point(data, corners[1]) - a, point(data, corners[2]) - a);
}

}  // namespace

TEST(Viewer, SeesNamedBlocks) {
    EXPECT_THAT(Blocks(random_solution({}, 1)).names,
                testing::ElementsAre("radiance", "incoming", "lights", "surface"));
    EXPECT_THAT(Blocks(random_solution({.light_samples = 0}, 1)).names,
                testing::ElementsAre("radiance", "lights", "surface"));
}

/// In a scene they would be walls as large as their pixels are many.
TEST(Viewer, IsNotShownTheTextures) {
    testing::internal::CaptureStderr();
    Blocks blocks(random_solution({.uvs = true}, 1));
    EXPECT_THAT(blocks.names, testing::ElementsAre("radiance", "incoming", "lights", "surface"));
    EXPECT_EQ(blocks.reader->GetErrorCode(), 0u);
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

TEST(Viewer, SeesTheArrays) {
    Blocks blocks(random_solution({.uvs = true}, 1));
    EXPECT_THAT(array_names(*blocks.pieces["radiance"]->GetCellData()),
                testing::UnorderedElementsAre("Radiance", "Emission", "DirectRadiance",
                                              "FiniteElementRadiance", "DirectIrradiance",
                                              "IndirectIrradiance", "StandardError", "Coverage",
                                              "Area", "Level", "SourceObject", "SourceFace", "Side",
                                              "Material", "BinOffset", "BinCount", "Root", "Leaf"));
    EXPECT_THAT(array_names(*blocks.pieces["incoming"]->GetCellData()),
                testing::IsSupersetOf({"Visibility", "GeometryFactor"}));
    EXPECT_THAT(array_names(*blocks.pieces["lights"]->GetPointData()),
                testing::UnorderedElementsAre("Normal", "Area", "Emitted", "Root", "Back", "Kind",
                                              "Light"));
    EXPECT_THAT(
        array_names(*blocks.pieces["surface"]->GetCellData()),
        testing::UnorderedElementsAre("Normals", "UVs", "Material", "SourceObject", "SourceFace",
                                      "Level", "LeafCount", "Fans", "FirstShotFront",
                                      "FirstShotBack", "BinLevelFront", "BinLevelBack"));
    EXPECT_THAT(array_names(*blocks.pieces["surface"]->GetFieldData()),
                testing::IsSupersetOf({"FormatVersion", "ProgramVersion", "Units", "SceneHash",
                                       "Iterations", "Seed", "MaterialDiffuse", "CameraEye"}));
}

TEST(Viewer, ShowsRadianceAtOnce) {
    Blocks blocks(random_solution({}, 1));
    vtkDataArray* scalars = blocks.pieces["radiance"]->GetCellData()->GetScalars();
    ASSERT_NE(scalars, nullptr);
    EXPECT_STREQ(scalars->GetName(), "Radiance");
    EXPECT_EQ(scalars->GetDataType(), VTK_FLOAT);
    EXPECT_EQ(scalars->GetNumberOfComponents(), 3);
}

TEST(Viewer, RadianceIsTheSumOfItsParts) {
    Blocks blocks(random_solution({}, 1));
    vtkCellData& cells = *blocks.pieces["radiance"]->GetCellData();
    ASSERT_GT(blocks.pieces["radiance"]->GetNumberOfCells(), 0);
    for (vtkIdType i = 0; i < blocks.pieces["radiance"]->GetNumberOfCells(); ++i) {
        for (int c = 0; c < 3; ++c) {
            const double sum = cells.GetArray("Emission")->GetComponent(i, c) +
                               cells.GetArray("DirectRadiance")->GetComponent(i, c) +
                               cells.GetArray("FiniteElementRadiance")->GetComponent(i, c);
            // Two additions in float.
            EXPECT_NEAR(cells.GetArray("Radiance")->GetComponent(i, c), sum, sum * 0x1p-23);
        }
    }
}

TEST(Viewer, CellsTileTheirRootsAndBacksFaceBack) {
    const Solution solution = random_solution({.levels = {3, 0, 2}, .light_samples = 0}, 4);
    Blocks blocks(solution);
    vtkPolyData& piece = *blocks.pieces["radiance"];
    piece.BuildCells();
    std::map<std::pair<int, int>, glm::dvec3> sums;
    double area_sum = 0.0;
    for (vtkIdType i = 0; i < piece.GetNumberOfCells(); ++i) {
        const auto value = [&](const char* name) {
            return piece.GetCellData()->GetArray(name)->GetComponent(i, 0);
        };
        const glm::dvec3 vector = cell_vector(piece, i);
        sums[{static_cast<int>(value("Root")), static_cast<int>(value("Side"))}] += vector;
        EXPECT_NEAR(value("Area"), glm::length(vector) / 2, 1e-6 * value("Area"));
        area_sum += value("Area");
    }
    // Dark are the back of root 1, unless its material emits there, and the front of root 2.
    EXPECT_EQ(sums.size(), solution.surface.materials[1].back_emits ? 5u : 4u);
    EXPECT_GT(area_sum, 0.0);
    for (const auto& [root_and_side, sum] : sums) {
        const auto root = static_cast<std::uint32_t>(root_and_side.first);
        const double sign = root_and_side.second != 0 ? -1.0 : 1.0;
        const glm::dvec3 whole =
            2.0 * area_of(solution.surface, root) * normal_of(solution.surface, root) * sign;
        EXPECT_LT(glm::length(sum - whole), 1e-12) << root;
    }
    // Leaves of a side share their corners: (n+1)(n+2)/2 of them.
    const std::map<int, vtkIdType> corners{{0, 45}, {1, 3}, {2, 15}};
    vtkIdType expected = 0;
    for (const auto& [root_and_side, sum] : sums) expected += corners.at(root_and_side.first);
    EXPECT_EQ(piece.GetNumberOfPoints(), expected);
}

TEST(Viewer, LeavesOfSeveralLevelsTileTheirRootsAndShareTheirPoints) {
    const Solution solution =
        random_solution({.levels = {0, 2, 1}, .splits = 3, .light_samples = 0}, 4);
    ASSERT_FALSE(solution.patches.mixed_roots.empty());
    Blocks blocks(solution);
    vtkPolyData& piece = *blocks.pieces["radiance"];
    piece.BuildCells();
    std::map<std::pair<int, int>, double> shares;
    std::map<std::pair<int, int>, std::set<std::array<double, 3>>> places;
    for (vtkIdType i = 0; i < piece.GetNumberOfCells(); ++i) {
        const auto value = [&](const char* name) {
            return static_cast<int>(piece.GetCellData()->GetArray(name)->GetComponent(i, 0));
        };
        const auto root = static_cast<std::uint32_t>(value("Root"));
        const std::pair side{value("Root"), value("Side")};
        const double share = std::ldexp(1.0, -2 * value("Level"));
        const glm::dvec3 whole = 2.0 * area_of(solution.surface, root) *
                                 normal_of(solution.surface, root) * (side.second ? -1.0 : 1.0);
        EXPECT_LT(glm::length(cell_vector(piece, i) - share * whole), 1e-12);
        shares[side] += share;
        vtkIdType size = 0;
        const vtkIdType* corners = nullptr;
        piece.GetCellPoints(i, size, corners);
        for (vtkIdType c = 0; c < size; ++c) {
            const glm::dvec3 p = point(piece, corners[c]);
            places[side].insert({p.x, p.y, p.z});
        }
    }
    vtkIdType points = 0;
    for (const auto& [side, share] : shares) EXPECT_EQ(share, 1.0);
    for (const auto& [side, distinct] : places) points += std::ssize(distinct);
    EXPECT_EQ(piece.GetNumberOfPoints(), points);
}

TEST(Viewer, EmptyBlocksOfADarkSceneOpen) {
    Blocks blocks(random_solution({.lit = false}, 1));
    EXPECT_EQ(blocks.pieces["radiance"]->GetNumberOfCells(), 0);
    EXPECT_EQ(blocks.pieces["surface"]->GetNumberOfCells(), 3);
}

}  // namespace transillum::test
