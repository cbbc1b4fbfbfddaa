#include "solution/export/mesh_bytes.h"
#include "solution/vtk_arrays.h"
#include "solution/vtk_bytes.h"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>

namespace transillum {

std::string mesh_vtp(const RadianceMesh& mesh, const std::filesystem::path& file) {
    vtkNew<vtkPoints> points;
    points->SetDataTypeToDouble();
    for (const glm::dvec3& p : mesh.positions) points->InsertNextPoint(p.x, p.y, p.z);
    vtkNew<vtkCellArray> cells;
    for (const RadianceMesh::Triangle& t : mesh.triangles) {
        cells->InsertNextCell(3);
        for (const std::uint32_t v : t.vertices) cells->InsertCellPoint(v);
    }
    vtkNew<vtkPolyData> data;
    data->SetPoints(points);
    data->SetPolys(cells);
    const std::size_t vertices = mesh.positions.size(), triangles = mesh.triangles.size();
    vtkPointData& of_points = *data->GetPointData();
    add_array(of_points, "Radiance", vertices, [&](std::size_t v) { return mesh.radiance[v]; });
    add_array(of_points, "Display", vertices, [&](std::size_t v) { return mesh.display[v]; });
    of_points.SetActiveScalars("Radiance");
    vtkCellData& of_cells = *data->GetCellData();
    add_array(of_cells, "Object", triangles,
              [&](std::size_t t) { return mesh.triangles[t].object; });
    add_array(of_cells, "Material", triangles,
              [&](std::size_t t) { return mesh.triangles[t].material; });
    add_strings(*data->GetFieldData(), "ObjectNames", mesh.objects);
    add_strings(*data->GetFieldData(), "MaterialNames", mesh.materials);
    add_value(*data->GetFieldData(), "Exposure", mesh.exposure);
    return to_vtp(*data, file);
}

}  // namespace transillum
