#include "walk_style.h"

#include <transillum/base/error.h>

#include <fmt/format.h>

#include <vtkCamera.h>
#include <vtkObjectFactory.h>
#include <vtkRenderWindowInteractor.h>

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace transillum::viewer {

vtkStandardNewMacro(WalkStyle);

namespace {

constexpr double shares_a_second = 0.2;
constexpr unsigned long frame_milliseconds = 10;  ///< longer ones leave pauses between frames
constexpr double degrees_a_pixel = 0.2;
constexpr double stops_a_key = 0.5;
/// Pitch ends before the view is straight up or down.
constexpr double least_angle_to_up = 3.0;

/// Right, up, forward.
glm::dvec3 direction_of(char key) {
    switch (key) {
        case 'a':
            return {-1, 0, 0};
        case 'd':
            return {1, 0, 0};
        case 'q':
            return {0, -1, 0};
        case 'e':
            return {0, 1, 0};
        case 's':
            return {0, 0, -1};
        case 'w':
            return {0, 0, 1};
        default:
            return glm::dvec3(0.0);
    }
}

glm::dvec3 vector_of(const double* v) {
    return {v[0], v[1], v[2]};
}

}  // namespace

void WalkStyle::OnKeyPress() {
    const std::string key = Interactor->GetKeySym() ? Interactor->GetKeySym() : "";
    if (key.size() == 1 && direction_of(key[0]) != glm::dvec3(0.0)) {
        if (walking_.empty()) {
            last_step_ = std::chrono::steady_clock::now();
            walking_timer_ = Interactor->CreateRepeatingTimer(frame_milliseconds);
        }
        walking_.insert(key[0]);
    } else if (key.size() == 1 && key[0] >= '0' && key[0] <= '9') {
        view_->show(static_cast<std::size_t>(key[0] == '0' ? 9 : key[0] - '1'));
    } else if (key == "bracketleft" || key == "bracketright") {
        view_->expose(view_->stops() + (key == "bracketright" ? stops_a_key : -stops_a_key));
    } else if (key == "x") {
        view_->toggle_edges();
    } else if (key == "t") {
        view_->toggle_text();
    } else if (key == "i") {
        view_->toggle_iteration();
    } else if (key == "h") {
        view_->toggle_help();
    } else if (key == "c") {
        view_->look_at_next_camera();
    } else if (key == "b") {
        view_->bookmark();
    } else if (key == "p") {
        view_->pick(Interactor->GetEventPosition()[0], Interactor->GetEventPosition()[1]);
    } else if (key == "F2") {
        save_picture();
    } else if (key == "Escape") {
        Interactor->ExitCallback();
    }
}

void WalkStyle::OnKeyRelease() {
    const std::string key = Interactor->GetKeySym() ? Interactor->GetKeySym() : "";
    if (key.size() != 1 || walking_.erase(key[0]) == 0 || !walking_.empty()) return;
    Interactor->DestroyTimer(walking_timer_);
}

void WalkStyle::OnTimer() {
    if (walking_.empty()) return view_->look_after_still_picture();
    const auto now = std::chrono::steady_clock::now();
    const double seconds = std::chrono::duration<double>(now - last_step_).count();
    last_step_ = now;
    glm::dvec3 direction(0.0);
    for (const char key : walking_) direction += direction_of(key);
    // A slow frame must not carry through a wall.
    step(shares_a_second * std::min(seconds, 0.2) * direction);
}

void WalkStyle::step(const glm::dvec3& shares) {
    vtkCamera& camera = *view_->renderer().GetActiveCamera();
    const glm::dvec3 forward = glm::normalize(vector_of(camera.GetDirectionOfProjection()));
    const glm::dvec3 right = glm::normalize(glm::cross(forward, vector_of(camera.GetViewUp())));
    const glm::dvec3 up = glm::cross(right, forward);
    const glm::dvec3 move = view_->size() * (shares.x * right + shares.y * up + shares.z * forward);
    const glm::dvec3 eye = vector_of(camera.GetPosition()) + move;
    const glm::dvec3 at = vector_of(camera.GetFocalPoint()) + move;
    camera.SetPosition(eye.x, eye.y, eye.z);
    camera.SetFocalPoint(at.x, at.y, at.z);
    view_->draw();
}

void WalkStyle::OnMouseMove() {
    if (!is_dragging_) return;
    const int* const now = Interactor->GetEventPosition();
    const int* const before = Interactor->GetLastEventPosition();
    turn(degrees_a_pixel * (now[0] - before[0]), -degrees_a_pixel * (now[1] - before[1]));
}

/// As if what is seen was dragged along. \param yaw, pitch [degrees]
void WalkStyle::turn(double yaw, double pitch) {
    vtkCamera& camera = *view_->renderer().GetActiveCamera();
    camera.Yaw(yaw);
    const glm::dvec3 forward = glm::normalize(vector_of(camera.GetDirectionOfProjection()));
    const glm::dvec3 up = glm::normalize(vector_of(camera.GetViewUp()));
    const double to_up = glm::degrees(std::acos(std::clamp(glm::dot(forward, up), -1.0, 1.0)));
    const double after = to_up - pitch;
    if (after > least_angle_to_up && after < 180.0 - least_angle_to_up) camera.Pitch(pitch);
    view_->draw();
}

void WalkStyle::save_picture() {
    std::filesystem::path file;
    do file = fmt::format("{}-{:03}.png", picture_stem_.string(), ++pictures_);
    while (std::filesystem::exists(file));
    try {
        view_->save_picture(file);
        fmt::print("{}\n", file.string());
        std::fflush(stdout);
    } catch (const IoError& e) {
        fmt::print(stderr, "transillum-view: {}\n", e.what());
    }
}

}  // namespace transillum::viewer
