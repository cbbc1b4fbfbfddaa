/// What check found, to look at in ParaView.
#pragma once

#include <transillum/repair/check_scene.h>

#include <filesystem>

namespace transillum {

/// A .vtp of vertices, lines and triangles at the places of the defects. Cell arrays: `Defect` (its
/// number; the field array `DefectNames` spells them), `Polygon`, `Other` (of a pair, else the
/// same) and `Object`. Sites without a place (polygons that give no triangle) are left out.
/// \throws IoError, and what was there is as it was before
void save_defects(const CheckReport& report, const Scene& scene, const std::filesystem::path& path);

/// A .vtp of one polyline a leak or opening. Cell arrays: `Length`, `Width`, `Opening` (0 or 1);
/// field array: `From`. \throws IoError, as above
void save_leaks(const std::vector<Leak>& leaks, const std::filesystem::path& path);

}  // namespace transillum
