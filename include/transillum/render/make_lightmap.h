/// What a solution looks like from anywhere, as a texture: for programs that light static geometry
/// so. The mesh keeps the triangles of the scene, however fine the patches; what they shine with is
/// in the lightmap, as RadianceMesh would interpolate it.
#pragma once

#include <transillum/render/make_radiance_mesh.h>

namespace transillum {

inline constexpr int largest_lightmap = 16384;

struct LightmapOptions {
    Components components;  ///< monte_carlo has no say
    int size = 0;      ///< edge [texels]; 0: a power of two for about two texels a patch's edge
    ToneMapping tone;  ///< of RadianceMesh::display and the picture for viewers
};

struct Lightmap {
    RadianceMesh mesh;  ///< with lightmap_uvs, lightmap_png, and the scene's uvs if it has any
    Image image;        ///< linear [W sr^-1 m^-2]; square; 0 where nothing lies
    int charts = 0;
    double texel = 0.0;  ///< edge [scene units]
};

/// Sides that shine are cut into charts, connected parts of an object that face one way, none of
/// which overlaps itself. Charts are padded by two texels, into which their borders are continued,
/// and stitched: linear filtering gives the same on both sides of a seam, without mip levels.
/// Does not depend on the number of threads.
/// \throws UsageError for a size that is negative, above largest_lightmap, or too small for so many
/// charts; InputError where no side shines
[[nodiscard]] Lightmap make_lightmap(const SpectralSolution& spectral,
                                     const LightmapOptions& options, const Workers& workers);

}  // namespace transillum
