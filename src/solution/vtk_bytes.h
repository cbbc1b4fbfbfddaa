/// PolyData and images to and from the bytes of .vtp and .vti files. VTK's own messages become the
/// text of the error.
#pragma once

#include <vtkImageData.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>

#include <filesystem>
#include <string>

namespace transillum {

/// Appended, compressed, 64-bit headers, little-endian.
/// \param file where they are meant to go, for messages.
/// \throws IoError
[[nodiscard]] std::string to_vtp(vtkPolyData& data, const std::filesystem::path& file);
[[nodiscard]] std::string to_vti(vtkImageData& data, const std::filesystem::path& file);

/// \throws InputError
[[nodiscard]] vtkSmartPointer<vtkPolyData> from_vtp(const std::string& bytes,
                                                    const std::filesystem::path& file);
[[nodiscard]] vtkSmartPointer<vtkImageData> from_vti(const std::string& bytes,
                                                     const std::filesystem::path& file);

}  // namespace transillum
