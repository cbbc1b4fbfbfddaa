#include "members.h"
#include "pieces.h"

#include <vtkCellArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>

namespace transillum {

namespace {

template <class Each>
void for_sample_members(Each each) {
    each("Normal", &LightSample::normal);
    each("Area", &LightSample::area);
    each("Emitted", &LightSample::emitted);
    each("Root", &LightSample::root);
    each("Back", &LightSample::back);
    each("Kind", &LightSample::kind);
    each("Light", &LightSample::light);
}

}  // namespace

PolyData lights_piece(const Solution& solution) {
    const std::vector<LightSample>& samples = solution.direct.samples;
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
    for_sample_members(
        [&](const char* name, auto member) { add_member(data, name, samples, member); });
    add_lighting(solution.lighting, *piece->GetFieldData());
    return piece;
}

void read_lights_piece(vtkPolyData& piece, const Path& file, Solution& solution) {
    std::vector<LightSample>& samples = solution.direct.samples;
    samples.resize(static_cast<std::size_t>(piece.GetNumberOfPoints()));
    for (std::size_t i = 0; i < samples.size(); ++i) {
        const double* p = piece.GetPoint(static_cast<vtkIdType>(i));
        samples[i].position = {p[0], p[1], p[2]};
    }
    const ArrayReader reader{*piece.GetPointData(), file};
    for_sample_members(
        [&](const char* name, auto member) { read_member(reader, name, samples, member); });
    read_lighting(*piece.GetFieldData(), file, solution.lighting);
}

}  // namespace transillum
