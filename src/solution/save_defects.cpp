#include <transillum/solution/save_defects.h>

#include "vtk_arrays.h"
#include "vtk_bytes.h"

#include <transillum/base/staged_files.h>

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkNew.h>
#include <vtkPoints.h>

#include <algorithm>
#include <array>

namespace transillum {

namespace {

void write_vtp(vtkPolyData& data, const std::filesystem::path& path) {
    StagedFiles files(path);
    files.write_main(to_vtp(data, path));
    files.put_in_place();
}

/// VTK numbers cells vertices first, then lines, then polygons.
std::vector<DefectSite> in_order_of_cells(const std::vector<DefectSite>& sites) {
    std::vector<DefectSite> sorted;
    for (const DefectSite& site : sites)
        if (site.vertex_count > 0) sorted.push_back(site);
    std::ranges::stable_sort(sorted, {}, &DefectSite::vertex_count);
    return sorted;
}

}  // namespace

void save_defects(const CheckReport& report, const Scene& scene,
                  const std::filesystem::path& path) {
    const TriangleSoup soup = make_soup(scene);
    const std::vector<DefectSite> sites = in_order_of_cells(report.sites);
    vtkNew<vtkPoints> points;
    points->SetDataTypeToDouble();
    std::array<vtkNew<vtkCellArray>, 3> cells;  // by the number of vertices, less one
    for (const DefectSite& site : sites) {
        std::array<vtkIdType, 3> ids{};
        for (std::size_t i = 0; i < site.vertex_count; ++i) {
            const glm::dvec3& p = soup.positions[site.vertices[i]];
            ids[i] = points->InsertNextPoint(p.x, p.y, p.z);
        }
        cells[site.vertex_count - 1u]->InsertNextCell(site.vertex_count, ids.data());
    }
    vtkNew<vtkPolyData> data;
    data->SetPoints(points);
    data->SetVerts(cells[0]);
    data->SetLines(cells[1]);
    data->SetPolys(cells[2]);
    vtkFieldData& fields = *data->GetCellData();
    const auto add = [&](const char* name, const auto& value_of) {
        add_array(fields, name, sites.size(), [&](std::size_t i) { return value_of(sites[i]); });
    };
    add("Defect", [](const DefectSite& s) { return static_cast<std::uint8_t>(s.defect); });
    add("Polygon", [](const DefectSite& s) { return s.polygon; });
    add("Other", [](const DefectSite& s) { return s.other; });
    add("Object", [&](const DefectSite& s) { return scene.polygons[s.polygon].object; });
    std::vector<std::string> names;
    for (std::size_t d = 0; d < defect_count; ++d)
        names.emplace_back(name_of(static_cast<Defect>(d)));
    add_strings(*data->GetFieldData(), "DefectNames", names);
    write_vtp(*data, path);
}

void save_leaks(const std::vector<Leak>& leaks, const std::filesystem::path& path) {
    vtkNew<vtkPoints> points;
    points->SetDataTypeToDouble();
    vtkNew<vtkCellArray> lines;
    std::vector<std::string> from;
    for (const Leak& leak : leaks) {
        lines->InsertNextCell(static_cast<int>(leak.path.size()));
        for (const glm::dvec3& p : leak.path)
            lines->InsertCellPoint(points->InsertNextPoint(p.x, p.y, p.z));
        from.push_back(leak.from);
    }
    vtkNew<vtkPolyData> data;
    data->SetPoints(points);
    data->SetLines(lines);
    vtkFieldData& fields = *data->GetCellData();
    const auto add = [&](const char* name, const auto& value_of) {
        add_array(fields, name, leaks.size(), [&](std::size_t i) { return value_of(leaks[i]); });
    };
    add("Length", [](const Leak& leak) { return leak.length; });
    add("Width", [](const Leak& leak) { return leak.width; });
    add("Opening", [](const Leak& leak) { return std::uint8_t(leak.is_opening); });
    add_strings(*data->GetFieldData(), "From", from);
    write_vtp(*data, path);
}

}  // namespace transillum
