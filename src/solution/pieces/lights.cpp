#include "pieces.h"

#include "solution/vtk_arrays.h"

#include <vtkCellArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>

namespace transillum {

PolyData lights_piece(const DirectLight& direct) {
    const std::vector<LightSample>& samples = direct.samples;
    vtkNew<vtkPoints> points;
    points->SetDataTypeToDouble();
    vtkNew<vtkCellArray> vertices;
    for (const LightSample& sample : samples) {
        const vtkIdType point =
            points->InsertNextPoint(sample.position.x, sample.position.y, sample.position.z);
        vertices->InsertNextCell(1, &point);
    }
    auto piece = PolyData::New();
    piece->SetPoints(points);
    piece->SetVerts(vertices);

    vtkFieldData& data = *piece->GetPointData();
    const auto add = [&](const char* name, auto LightSample::*member) {
        add_array(data, name, samples.size(), [&](std::size_t i) { return samples[i].*member; });
    };
    add("Normal", &LightSample::normal);
    add("Area", &LightSample::area);
    add("Radiance", &LightSample::radiance);
    add("Root", &LightSample::root);
    add_array(data, "Back", samples.size(),
              [&](std::size_t i) { return std::uint8_t{samples[i].back}; });
    return piece;
}

void read_lights_piece(vtkPolyData& piece, const Path& file, DirectLight& direct) {
    const auto count = static_cast<std::size_t>(piece.GetNumberOfPoints());
    const ArrayReader reader{*piece.GetPointData(), file};
    const auto normals = reader.read<glm::dvec3>("Normal", count);
    const auto areas = reader.read<double>("Area", count);
    const auto radiances = reader.read<Spectrum>("Radiance", count);
    const auto roots = reader.read<std::uint32_t>("Root", count);
    const auto backs = reader.read_flags("Back", count);
    direct.samples.resize(count);
    for (std::size_t i = 0; i < count; ++i) {
        const double* p = piece.GetPoint(static_cast<vtkIdType>(i));
        direct.samples[i] = {{p[0], p[1], p[2]}, normals[i], areas[i],
                             radiances[i],       roots[i],   backs[i] != 0};
    }
}

}  // namespace transillum
