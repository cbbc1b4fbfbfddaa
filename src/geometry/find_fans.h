/// Shading fans through the half-edge surface (OpenMesh).
#pragma once

#include <transillum/geometry/surface_mesh.h>

namespace transillum {

/// Sets RootTriangle::fans and SurfaceMesh::fan_count, and counts edges in the report.
void find_fans(SurfaceMesh& mesh, double crease_angle, SurfaceReport& report);

}  // namespace transillum
