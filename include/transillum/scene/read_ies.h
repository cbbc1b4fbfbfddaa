/// IES LM-63 photometric files.
#pragma once

#include <transillum/base/monitor.h>
#include <transillum/scene/photometry.h>

#include <filesystem>

namespace transillum {

/// Reads LM-63 of 1986 (without a first line of its own), 1991, 1995 and 2002, type C. The
/// multiplier and the ballast factors are multiplied in (the second, of ballast and lamp, only
/// before 1995: later files reserve its place). TILT=INCLUDE is read and, as the luminaire's tilt
/// is not known, noted as not honoured; so is the size of the luminous opening.
/// \throws InputError naming file and line, what was found and what is accepted: types A and B,
/// TILT in another file, azimuths of another symmetry, counts and values out of range; IoError.
[[nodiscard]] Photometry read_ies(const std::filesystem::path& path, Monitor& monitor);

}  // namespace transillum
