#include "pieces.h"

#include "solution/vtk_arrays.h"

#include <transillum/base/error.h>

#include <vtkNew.h>
#include <vtkPoints.h>

#include <array>

namespace transillum {

PolyData environment_piece(const Texture& image) {
    auto piece = PolyData::New();
    piece->SetPoints(vtkNew<vtkPoints>());  // VTK reads no piece without
    vtkFieldData& fields = *piece->GetFieldData();
    add_strings(fields, "ImageName", {image.name});
    add_value(fields, "ImageSize", std::array<std::int32_t, 2>{image.width, image.height});
    add_value(fields, "ImageWrap",
              std::array<std::uint8_t, 2>{static_cast<std::uint8_t>(image.wrap_u),
                                          static_cast<std::uint8_t>(image.wrap_v)});
    add_array(fields, "ImageRadiance", image.texels.size(),
              [&](std::size_t i) { return image.texels[i]; });
    return piece;
}

void read_environment_piece(vtkPolyData& piece, const Path& file, Environment& environment) {
    const ArrayReader reader{*piece.GetFieldData(), file};
    auto image = std::make_shared<Texture>();
    image->name = reader.read_strings("ImageName", 1)[0];
    const auto size = reader.read_value<std::array<std::int32_t, 2>>("ImageSize");
    if (size[0] < 1 || size[1] < 1)
        throw InputError(file.string(), "array 'ImageSize': " + std::to_string(size[0]) + " x " +
                                            std::to_string(size[1]) + " pixels");
    image->width = size[0];
    image->height = size[1];
    const auto wrap = reader.read_value<std::array<std::uint8_t, 2>>("ImageWrap");
    image->wrap_u = Texture::Wrap(wrap[0]);
    image->wrap_v = Texture::Wrap(wrap[1]);
    image->texels =
        reader.read<Spectrum>("ImageRadiance", static_cast<std::size_t>(size[0]) * size[1]);
    environment.image = std::move(image);
}

}  // namespace transillum
