/// A picture that covers the window, over what it draws and under its text.
#pragma once

#include <transillum/render/image.h>

#include <vtkActor2D.h>
#include <vtkImageData.h>
#include <vtkImageMapper.h>
#include <vtkNew.h>

#include <array>

namespace transillum::viewer {

/// What a screen shows of a radiance that is exposed by so many stops.
[[nodiscard]] std::array<unsigned char, 3> screen_colour(const Spectrum& radiance, double stops);

class PictureOverlay {
public:
    PictureOverlay();

    [[nodiscard]] vtkActor2D& actor() { return *actor_; }
    void show(const Image& image, double stops);
    void hide() { actor_->VisibilityOff(); }

private:
    vtkNew<vtkImageData> data_;
    vtkNew<vtkImageMapper> mapper_;
    vtkNew<vtkActor2D> actor_;
};

}  // namespace transillum::viewer
