/// PolyData to and from the bytes of a .vtp file. VTK's own messages become the text of the error.
#pragma once

#include <vtkPolyData.h>
#include <vtkSmartPointer.h>

#include <filesystem>
#include <string>

namespace transillum {

/// Appended, compressed, 64-bit headers, little-endian.
/// \param file where they are meant to go, for messages.
/// \throws IoError
[[nodiscard]] std::string to_vtp(vtkPolyData& data, const std::filesystem::path& file);

/// \throws InputError
[[nodiscard]] vtkSmartPointer<vtkPolyData> from_vtp(const std::string& bytes,
                                                    const std::filesystem::path& file);

}  // namespace transillum
