#include "solution_view.h"

#include <transillum/base/error.h>
#include <transillum/render/render_solution.h>

#include <fmt/format.h>

#include <vtkCamera.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkCellPicker.h>
#include <vtkDoubleArray.h>
#include <vtkLookupTable.h>
#include <vtkPNGWriter.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkProperty.h>
#include <vtkTextProperty.h>
#include <vtkUnsignedCharArray.h>
#include <vtkWindowToImageFilter.h>

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace transillum::viewer {

const char* const key_help =
    "1-9, 0   quantity            [ ]   exposure\n"
    "w a s d  walk                q e   down, up\n"
    "drag     look around         wheel forward\n"
    "c        next camera         b     bookmark this one\n"
    "p        values of a patch   x     edges of patches\n"
    "i        go on with the iteration where the view stands still\n"
    "F2       save a picture      t     text\n"
    "Esc      quit                h     this help";

namespace {

/// All but a few outliers, which would leave no colours to the rest.
constexpr double outliers = 0.005;
constexpr int font_size = 14;
/// After which a view is one that stands still.
constexpr std::chrono::milliseconds stillness(400);

vtkNew<vtkLookupTable> blue_to_yellow() {
    constexpr std::array<std::array<double, 3>, 9> viridis{{{0.267, 0.005, 0.329},
                                                            {0.279, 0.175, 0.483},
                                                            {0.230, 0.322, 0.546},
                                                            {0.173, 0.449, 0.558},
                                                            {0.128, 0.567, 0.551},
                                                            {0.158, 0.684, 0.502},
                                                            {0.369, 0.789, 0.383},
                                                            {0.678, 0.864, 0.190},
                                                            {0.993, 0.906, 0.144}}};
    vtkNew<vtkLookupTable> table;
    table->SetNumberOfTableValues(256);
    for (int i = 0; i < 256; ++i) {
        const double x = i / 255.0 * (viridis.size() - 1);
        const auto k = std::min(static_cast<std::size_t>(x), viridis.size() - 2);
        const double share = x - static_cast<double>(k);
        std::array<double, 3> c{};
        for (std::size_t j = 0; j < 3; ++j)
            c[j] = viridis[k][j] + share * (viridis[k + 1][j] - viridis[k][j]);
        table->SetTableValue(i, c[0], c[1], c[2]);
    }
    return table;
}

std::pair<double, double> range_of(std::vector<double> values) {
    std::ranges::sort(values);
    const auto at = [&](double share) {
        return values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1))];
    };
    return {at(outliers), at(1.0 - outliers)};
}

}  // namespace

SolutionView::SolutionView(SpectralSolution solution, std::string name, const Workers& workers)
    : solution_(std::move(solution)),
      name_(std::move(name)),
      workers_(workers),
      quantities_(quantities_of(solution_.rgb)),
      mesh_(make_radiance_mesh(solution_, {}, workers)),
      radiance_(quantities_.size()),
      cameras_(solution_.rgb.cameras) {
    if (mesh_.triangles.empty()) throw InputError(name_, "nothing in it shines");
    radiance_[0] = mesh_.radiance;
    stops_ = mesh_.exposure;
    set_geometry();
    mapper_->SetInputData(data_);
    actor_->SetMapper(mapper_);
    actor_->GetProperty()->LightingOff();
    actor_->GetProperty()->SetEdgeColor(0.1, 0.1, 0.1);
    // Front and back of a surface lie in one place.
    actor_->GetProperty()->BackfaceCullingOn();
    bar_->SetLookupTable(blue_to_yellow());
    bar_->SetNumberOfLabels(5);
    bar_->SetMaximumWidthInPixels(90);
    bar_->SetPosition(0.76, 0.1);
    bar_->SetVerticalTitleSeparation(8);
    bar_->UnconstrainedFontSizeOn();
    for (vtkTextProperty* const text :
         {bar_->GetLabelTextProperty(), bar_->GetTitleTextProperty()}) {
        text->SetFontSize(font_size);
        text->ItalicOff();
        text->BoldOff();
        text->ShadowOff();
    }
    renderer_->AddActor2D(&overlay_.actor());  // first: under the text
    for (vtkTextActor* const text : {title_.Get(), help_.Get()}) {
        const bool is_title = text == title_.Get();
        text->GetPositionCoordinate()->SetCoordinateSystemToNormalizedViewport();
        text->SetPosition(0.01, is_title ? 0.99 : 0.01);
        vtkTextProperty& property = *text->GetTextProperty();
        property.SetFontFamilyToCourier();
        property.SetFontSize(font_size);
        property.SetVerticalJustification(is_title ? VTK_TEXT_TOP : VTK_TEXT_BOTTOM);
        property.SetBackgroundColor(0.0, 0.0, 0.0);
        property.SetBackgroundOpacity(0.6);
        renderer_->AddActor2D(text);
    }
    renderer_->SetBackground(0.086, 0.094, 0.106);
    renderer_->AddActor(actor_);
    renderer_->AddActor2D(bar_);
    window_->AddRenderer(renderer_);
    // By a software renderer, 270 000 leaves at 800x600: 4 samples 6 frames a second, 1 sample 12.
    window_->SetMultiSamples(0);
    window_->SetWindowName(("transillum: " + name_).c_str());
    look(choose_camera(cameras_, solution_.rgb.surface, ""));
    colour();
}

/// About the middle: floats far from the origin would be too coarse.
void SolutionView::set_geometry() {
    glm::dvec3 low(std::numeric_limits<double>::infinity()), high(-low);
    for (const glm::dvec3& p : mesh_.positions) {
        low = glm::min(low, p);
        high = glm::max(high, p);
    }
    middle_ = 0.5 * (low + high);
    size_ = glm::length(high - low);
    vtkNew<vtkPoints> points;
    points->SetDataTypeToFloat();
    points->SetNumberOfPoints(static_cast<vtkIdType>(mesh_.positions.size()));
    for (std::size_t v = 0; v < mesh_.positions.size(); ++v) {
        const glm::dvec3 p = mesh_.positions[v] - middle_;
        points->SetPoint(static_cast<vtkIdType>(v), p.x, p.y, p.z);
    }
    vtkNew<vtkCellArray> cells;
    for (const RadianceMesh::Triangle& t : mesh_.triangles) {
        cells->InsertNextCell(3);
        for (const std::uint32_t v : t.vertices) cells->InsertCellPoint(v);
    }
    data_->SetPoints(points);
    data_->SetPolys(cells);
}

void SolutionView::colour() {
    const Quantity& quantity = quantities_[shown_];
    if (quantity.is_picture)
        colour_as_picture(quantity);
    else
        colour_by_map(quantity);
    bar_->SetVisibility(!quantity.is_picture);
    annotate();
}

void SolutionView::colour_as_picture(const Quantity& quantity) {
    std::vector<Spectrum>& radiance = radiance_[shown_];
    if (radiance.empty()) {
        RadianceMeshOptions options;
        options.components = quantity.components;
        radiance = make_radiance_mesh(solution_, options, workers_).radiance;
    }
    vtkNew<vtkUnsignedCharArray> colours;
    colours->SetNumberOfComponents(3);
    colours->SetNumberOfTuples(static_cast<vtkIdType>(radiance.size()));
    for (std::size_t v = 0; v < radiance.size(); ++v)
        colours->SetTypedTuple(static_cast<vtkIdType>(v),
                               screen_colour(radiance[v], stops_).data());
    data_->GetCellData()->SetScalars(nullptr);
    data_->GetPointData()->SetScalars(colours);
    mapper_->SetScalarModeToUsePointData();
    mapper_->SetColorModeToDirectScalars();
}

void SolutionView::colour_by_map(const Quantity& quantity) {
    std::vector<double> values;
    for (const RadianceMesh::Triangle& t : mesh_.triangles)
        values.push_back(quantity.value(t.patch));
    vtkNew<vtkDoubleArray> scalars;
    scalars->SetNumberOfTuples(static_cast<vtkIdType>(values.size()));
    for (std::size_t i = 0; i < values.size(); ++i)
        scalars->SetTypedComponent(static_cast<vtkIdType>(i), 0, values[i]);
    const auto [low, high] = range_of(std::move(values));
    data_->GetPointData()->SetScalars(nullptr);
    data_->GetCellData()->SetScalars(scalars);
    mapper_->SetScalarModeToUseCellData();
    mapper_->SetColorModeToMapScalars();
    mapper_->SetLookupTable(bar_->GetLookupTable());
    mapper_->SetScalarRange(low, high);
    bar_->SetTitle(
        (quantity.unit.empty() ? quantity.name : quantity.name + "\n" + quantity.unit).c_str());
}

void SolutionView::annotate() {
    const Quantity& quantity = quantities_[shown_];
    std::string title = name_ + ": " + quantity.name;
    if (quantity.is_picture) title += fmt::format(", exposure {:+.1f} stops", stops_);
    if (still_)
        title += fmt::format(", {} bundles", still_->pass * StillPicture::bundles);
    else if (is_begun_)
        title += ", iterating";
    if (picked_) title += "\n\n" + describe_patch(solution_.rgb, *picked_);
    title_->SetInput(title.c_str());
    help_->SetInput(helps_ ? key_help : "h: help");
}

void SolutionView::show(std::size_t quantity) {
    if (quantity >= quantities_.size()) return;
    shown_ = quantity;
    stop_still_picture();
    colour();
    draw();
}

void SolutionView::expose(double stops) {
    stops_ = stops;
    if (quantities_[shown_].is_picture) colour();
    if (still_) show_still_picture();
    draw();
}

void SolutionView::toggle_edges() {
    vtkProperty& property = *actor_->GetProperty();
    property.SetEdgeVisibility(!property.GetEdgeVisibility());
    stop_still_picture();
    draw();
}

void SolutionView::toggle_help() {
    helps_ = !helps_;
    annotate();
    draw();
}

void SolutionView::toggle_text() {
    title_->SetVisibility(!title_->GetVisibility());
    help_->SetVisibility(!help_->GetVisibility());
    draw();
}

void SolutionView::look(const Camera& camera) {
    vtkCamera& view = *renderer_->GetActiveCamera();
    const glm::dvec3 eye = camera.eye - middle_, at = camera.look_at - middle_;
    view.SetPosition(eye.x, eye.y, eye.z);
    view.SetFocalPoint(at.x, at.y, at.z);
    view.SetViewUp(camera.up.x, camera.up.y, camera.up.z);
    view.SetViewAngle(camera.vertical_fov);
}

void SolutionView::look_at_next_camera() {
    if (cameras_.empty()) return;
    next_camera_ = (next_camera_ + 1) % cameras_.size();
    look(cameras_[next_camera_]);
    draw();
}

Camera SolutionView::camera() const {
    vtkCamera& view = *renderer_->GetActiveCamera();
    const auto point = [&](const double* p) { return glm::dvec3(p[0], p[1], p[2]); };
    return {fmt::format("bookmark {}", cameras_.size() - solution_.rgb.cameras.size() + 1),
            point(view.GetPosition()) + middle_, point(view.GetFocalPoint()) + middle_,
            point(view.GetViewUp()), view.GetViewAngle()};
}

SolutionView::View SolutionView::view() const {
    vtkCamera& camera = *renderer_->GetActiveCamera();
    const auto point = [](const double* p) { return glm::dvec3(p[0], p[1], p[2]); };
    const int* const size = window_->GetSize();
    return {point(camera.GetPosition()),
            point(camera.GetFocalPoint()),
            point(camera.GetViewUp()),
            camera.GetViewAngle(),
            size[0],
            size[1]};
}

void SolutionView::iterate_when_still(bool on) {
    // Pictures of bands are sums of four or more, each with an iteration of its own.
    iterates_ = on && solution_.groups.empty();
    stop_still_picture();
    draw();
}

void SolutionView::stop_still_picture() {
    moved_at_ = std::chrono::steady_clock::now();
    if (!is_begun_) return;
    is_begun_ = false;
    still_.reset();
    overlay_.hide();
    still_picture_->stop();
    annotate();
}

void SolutionView::look_after_still_picture() {
    if (view() != last_view_) return draw();  // the window has another size
    if (!iterates_ || shown_ != 0 || actor_->GetProperty()->GetEdgeVisibility()) return;
    if (!is_begun_) {
        if (std::chrono::steady_clock::now() - moved_at_ < stillness) return;
        // One thread is left to the window.
        if (!still_picture_)
            still_picture_ =
                std::make_unique<StillPicture>(solution_.rgb, std::max(1, workers_.count() - 1));
        still_picture_->begin(camera(), window_->GetSize()[0], window_->GetSize()[1]);
        is_begun_ = true;
        annotate();
        draw();
    } else if (auto came = still_picture_->take()) {
        still_ = std::move(came);
        show_still_picture();
        draw();
    }
}

void SolutionView::show_still_picture() {
    overlay_.show(still_->image, stops_);
    annotate();
}

void SolutionView::pick(int x, int y) {
    vtkNew<vtkCellPicker> picker;
    picker->SetTolerance(0.0);
    picked_.reset();
    if (picker->Pick(x, y, 0.0, renderer_) && picker->GetCellId() >= 0)
        picked_ = mesh_.triangles[static_cast<std::size_t>(picker->GetCellId())].patch;
    annotate();
    draw();
}

void SolutionView::save_picture(const std::filesystem::path& path) {
    vtkNew<vtkWindowToImageFilter> image;
    image->SetInput(window_);
    image->ReadFrontBufferOff();
    vtkNew<vtkPNGWriter> writer;
    writer->SetFileName(path.c_str());
    writer->SetInputConnection(image->GetOutputPort());
    writer->Write();
    if (writer->GetErrorCode() != 0) throw IoError(path.string(), "the picture cannot be written");
}

void SolutionView::draw() {
    // Near enough to stand before a wall, and no nearer: else depth is too coarse to tell the
    // inside of a thing from its outside along their common edges.
    vtkCamera& view = *renderer_->GetActiveCamera();
    const double* const eye = view.GetPosition();
    const double distance = glm::length(glm::dvec3(eye[0], eye[1], eye[2]));
    view.SetClippingRange(std::max(5e-4 * size_, distance - 0.55 * size_), distance + size_);
    if (const View now = this->view(); now != last_view_) {
        last_view_ = now;
        stop_still_picture();
    }
    window_->Render();
}

}  // namespace transillum::viewer
