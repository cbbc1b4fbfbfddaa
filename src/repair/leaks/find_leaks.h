/// Ways from outside to what luminaires light and cameras see.
#pragma once

#include <transillum/base/monitor.h>
#include <transillum/base/parallel.h>
#include <transillum/repair/check_scene.h>

namespace transillum {

/// For every luminaire, light and camera that outside can be reached from, one way there: a wide
/// one where there is any (an opening), else the shortest (a leak). Ways lead over the sides of
/// triangles, around borders, and straight through free space, so that no gap is too narrow to be
/// found. Where a way is narrow it is closed and another one sought, up to a few dozen times. The
/// narrow gaps of a scene that is open anyway are not looked for.
/// \param width below which a gap is a leak [scene units]
/// \returns where a stop is requested, only what was found before
/// \pre triangles have area and meet in shared vertices and edges only
[[nodiscard]] std::vector<Leak> find_leaks(const TriangleSoup& soup, const Scene& scene,
                                           double width, const Workers& workers, Monitor& monitor);

}  // namespace transillum
