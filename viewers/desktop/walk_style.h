/// What mouse and keys do.
#pragma once

#include "solution_view.h"

#include <vtkInteractorStyle.h>

#include <chrono>
#include <filesystem>
#include <set>
#include <string>

namespace transillum::viewer {

class WalkStyle : public vtkInteractorStyle {
public:
    static WalkStyle* New();
    vtkTypeMacro(WalkStyle, vtkInteractorStyle);

    /// Keeps a reference. \param picture_stem of pictures that a key saves
    void set_view(SolutionView& view, std::filesystem::path picture_stem) {
        view_ = &view;
        picture_stem_ = std::move(picture_stem);
    }

    void OnKeyPress() override;
    void OnKeyRelease() override;
    void OnChar() override {}  // VTK's own keys
    void OnTimer() override;
    void OnMouseMove() override;
    void OnLeftButtonDown() override { is_dragging_ = true; }
    void OnLeftButtonUp() override { is_dragging_ = false; }
    void OnMouseWheelForward() override { step({0.0, 0.0, 0.03}); }
    void OnMouseWheelBackward() override { step({0.0, 0.0, -0.03}); }

private:
    /// Moves the eye by shares of the scene's size: right, up, forward.
    void step(const glm::dvec3& shares);
    void turn(double yaw, double pitch);
    void save_picture();

    SolutionView* view_ = nullptr;
    std::filesystem::path picture_stem_;
    int walking_timer_ = 0;
    std::set<char> walking_;  ///< keys that are held
    std::chrono::steady_clock::time_point last_step_;
    int pictures_ = 0;
    bool is_dragging_ = false;
};

}  // namespace transillum::viewer
