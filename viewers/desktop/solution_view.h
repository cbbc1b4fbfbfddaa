/// A window that shows a solution (VTK): its triangles in the colours of a quantity, the colour map
/// of that, and text. What the keys ask for are functions here.
#pragma once

#include "picture_overlay.h"
#include "quantities.h"
#include "still_picture.h"

#include <vtkActor.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkScalarBarActor.h>
#include <vtkTextActor.h>

#include <chrono>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace transillum::viewer {

class SolutionView {
public:
    SolutionView(SpectralSolution solution, std::string name, const Workers& workers);

    [[nodiscard]] vtkRenderWindow& window() { return *window_; }
    [[nodiscard]] vtkRenderer& renderer() { return *renderer_; }
    [[nodiscard]] const std::vector<Quantity>& quantities() const { return quantities_; }
    /// Length of the scene's diagonal [scene units].
    [[nodiscard]] double size() const { return size_; }

    void show(std::size_t quantity);
    void expose(double stops);
    [[nodiscard]] double stops() const { return stops_; }
    void toggle_edges();
    void toggle_help();
    /// Title, help and what was picked; the colour map stays.
    void toggle_text();

    /// The solution's, and those that were bookmarked.
    [[nodiscard]] const std::vector<Camera>& cameras() const { return cameras_; }
    void look(const Camera& camera);
    void look_at_next_camera();
    [[nodiscard]] Camera camera() const;
    void bookmark() { cameras_.push_back(camera()); }

    /// What lies under a pixel from the lower left, or nothing.
    void pick(int x, int y);
    [[nodiscard]] std::optional<std::uint32_t> picked() const { return picked_; }

    /// Whether the iteration goes on where the view stands still; shown as total radiance.
    void iterate_when_still(bool on);
    void toggle_iteration() { iterate_when_still(!iterates_); }
    /// To be called every so often: begins a picture when the view has stood still for a while, and
    /// shows what came of it. Never waits.
    void look_after_still_picture();

    /// \throws IoError
    void save_picture(const std::filesystem::path& path);
    void draw();

private:
    void set_geometry();
    void colour();
    void colour_as_picture(const Quantity& quantity);
    void colour_by_map(const Quantity& quantity);
    void show_still_picture();
    void stop_still_picture();
    void annotate();
    /// What the picture depends on that may change by itself.
    struct View {
        glm::dvec3 eye, look_at, up;
        double fov = 0.0;
        int width = 0, height = 0;
        bool operator==(const View&) const = default;
    };
    [[nodiscard]] View view() const;

    SpectralSolution solution_;
    const std::string name_;
    const Workers& workers_;
    std::vector<Quantity> quantities_;
    RadianceMesh mesh_;                            ///< total radiance
    std::vector<std::vector<Spectrum>> radiance_;  ///< of pictures' vertices, where shown before
    std::vector<Camera> cameras_;
    std::size_t shown_ = 0, next_camera_ = 0;
    double stops_ = 0.0, size_ = 1.0;
    glm::dvec3 middle_{0.0};
    bool helps_ = true;
    std::optional<std::uint32_t> picked_;

    bool iterates_ = false, is_begun_ = false;
    View last_view_;
    std::chrono::steady_clock::time_point moved_at_;
    std::optional<StillPicture::Shown> still_;
    std::unique_ptr<StillPicture> still_picture_;  ///< null until first asked for

    vtkNew<vtkPolyData> data_;
    vtkNew<vtkPolyDataMapper> mapper_;
    vtkNew<vtkActor> actor_;
    PictureOverlay overlay_;  ///< the still picture
    vtkNew<vtkScalarBarActor> bar_;
    vtkNew<vtkTextActor> title_, help_;  ///< at the top, with what was picked; at the bottom
    vtkNew<vtkRenderer> renderer_;
    vtkNew<vtkRenderWindow> window_;
};

/// What the keys do, line by line.
extern const char* const key_help;

}  // namespace transillum::viewer
