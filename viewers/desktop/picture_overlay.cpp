#include "picture_overlay.h"

#include <transillum/base/srgb.h>

#include <algorithm>
#include <cmath>

namespace transillum::viewer {

std::array<unsigned char, 3> screen_colour(const Spectrum& radiance, double stops) {
    const Spectrum shown = display_colour(radiance, stops);
    std::array<unsigned char, 3> bytes{};
    for (int c = 0; c < channel_count; ++c)
        bytes[static_cast<std::size_t>(c)] =
            static_cast<unsigned char>(std::lround(255.0f * srgb_from_linear(shown[c])));
    return bytes;
}

PictureOverlay::PictureOverlay() {
    mapper_->SetInputData(data_);
    mapper_->SetColorWindow(255.0);
    mapper_->SetColorLevel(127.5);
    actor_->SetMapper(mapper_);
    hide();
}

/// VTK's rows begin at the bottom.
void PictureOverlay::show(const Image& image, double stops) {
    data_->SetDimensions(image.width, image.height, 1);
    data_->AllocateScalars(VTK_UNSIGNED_CHAR, 3);
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x)
            std::ranges::copy(
                screen_colour(image.at(x, y), stops),
                static_cast<unsigned char*>(data_->GetScalarPointer(x, image.height - 1 - y, 0)));
    data_->Modified();
    actor_->VisibilityOn();
}

}  // namespace transillum::viewer
