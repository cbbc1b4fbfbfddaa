/// The transillumination buffer (paper §3): for one global direction, the list of all surface
/// points behind every pixel of a window perpendicular to it, sorted by depth.
///
/// Root triangles are rasterized, leaves are looked up by barycentric coordinates, so the cost
/// follows the roots. The buffer exists tile by tile: each is filled, sorted and handed to a
/// visitor while it is in cache.
#pragma once

#include <transillum/base/parallel.h>
#include <transillum/geometry/patch_hierarchy.h>
#include <transillum/geometry/surface_mesh.h>
#include <transillum/visibility/stage_seconds.h>

#include <glm/mat3x3.hpp>

#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace transillum {

/// A surface point behind a pixel: from the high bit, its depth along the direction (31 bits below
/// a zero, ordered as an unsigned number), 1 if its front faces forwards, along the direction, and
/// its leaf (31 bits). Ascending order is order of depth; where two surfaces coincide, a front that
/// faces backwards comes first.
using Fragment = std::uint64_t;

[[nodiscard]] inline std::uint32_t leaf_of(Fragment f) {
    return static_cast<std::uint32_t>(f) & 0x7fffffffu;
}
[[nodiscard]] inline bool front_faces_forwards(Fragment f) {
    return (static_cast<std::uint32_t>(f) >> 31) != 0;
}
/// Patch that light travelling against the direction meets; it sends along the direction.
[[nodiscard]] inline std::uint32_t upper_patch(Fragment f, std::uint32_t leaf_count) {
    return leaf_of(f) + (front_faces_forwards(f) ? 0 : leaf_count);
}
/// Patch that light travelling along the direction meets.
[[nodiscard]] inline std::uint32_t lower_patch(Fragment f, std::uint32_t leaf_count) {
    return leaf_of(f) + (front_faces_forwards(f) ? leaf_count : 0);
}

/// A direction and the window before it.
struct Bundle {
    glm::dmat3 frame{
        1.0};  ///< orthonormal; third column: the direction; first two: the window's axes
    double offset_x = 0.0, offset_y = 0.0;  ///< of the pixel grid, in [0, 1) pixels
    int random_row = 0;  ///< where a visitor begins that samples some of the rows, in [0, 256)
};

/// The bundle of a number of the scrambled low-discrepancy sequence: uniform over the sphere, with
/// a random turn in the plane and a sub-pixel offset (a fixed grid is biased for surfaces that
/// align with it).
[[nodiscard]] Bundle sample_bundle(std::uint32_t index, std::uint64_t seed);

/// Pixel lists of one tile: fragments of pixel i are [first[i], first[i + 1]), i = row * tile width
/// + column.
struct TileLists {
    int width = 0, height = 0;
    int row0 = 0, column0 = 0;  ///< the tile's first pixel in the window
    std::span<const std::uint32_t> first;
    std::span<const Fragment> fragments;
};

/// Where points of the scene lie in a bundle's window.
struct WindowTransform {
    glm::dmat3 axes{1.0};   ///< the bundle's frame
    glm::dvec3 scale{1.0};  ///< pixels, and steps of a fragment's depth, to a scene unit
    glm::dvec3 shift{0.0};
    /// x, y: pixels, centres at whole numbers; z: as a fragment's upper 32 bits.
    [[nodiscard]] glm::dvec3 to_window(const glm::dvec3& point) const {
        return point * axes * scale + shift;
    }
    [[nodiscard]] glm::dvec3 to_scene(const glm::dvec3& window) const {
        return axes * ((window - shift) / scale);
    }
};

class TransilluminationBuffer {
public:
    /// Keeps references to both. \param pixel_size edge of a pixel [scene units], the same for
    /// every direction. \throws UsageError when the window would have more than 16384 pixels a
    /// side.
    TransilluminationBuffer(const SurfaceMesh& mesh, const PatchHierarchy& patches,
                            double pixel_size);
    ~TransilluminationBuffer();

    using Visitor = std::function<void(const TileLists& tile, int worker)>;
    /// Visits every tile that holds a fragment, several at once. The lists do not depend on the
    /// number of workers.
    void trace(const Bundle& bundle, const Workers& workers, const Visitor& visit);

    [[nodiscard]] double pixel_size() const { return pixel_size_; }
    [[nodiscard]] int window_width() const { return width_; }  ///< of the last bundle [pixels]
    [[nodiscard]] int window_height() const { return height_; }
    /// Of the last bundle; of the one being traced, for a visitor.
    [[nodiscard]] const WindowTransform& window() const { return window_; }
    /// Since it was made.
    [[nodiscard]] StageSeconds seconds() const;

private:
    struct Scratch;
    struct Plane;
    struct DepthRamp;
    class LeavesAlong;
    struct ProjectedVertex {
        std::int32_t x, y;  ///< pixels / fixed_unit_
        double depth;       ///< in [0, 2^63)
    };
    /// Triangles by tile, of one range of triangles.
    using Bins = std::vector<std::vector<std::uint32_t>>;

    void project(const Bundle& bundle, const Workers& workers);
    void bin(const Workers& workers);
    void fill_tile(int tile, Scratch& scratch) const;
    void draw(std::uint32_t root, const struct TileRect& rect, Scratch& scratch) const;
    Plane depth_plane(std::uint32_t root) const;
    std::array<Plane, 2> barycentric_planes(const std::array<struct FixedPoint, 3>& v,
                                            std::int64_t twice_area) const;
    bool are_coplanar(std::uint32_t root_a, std::uint32_t root_b) const;
    bool is_behind(Fragment a, Fragment b, int x, int y) const;
    void order_near(Fragment* begin, Fragment* end, int x, int y) const;

    const SurfaceMesh& mesh_;
    const PatchHierarchy& patches_;
    double pixel_size_;
    int sub_pixel_bits_;      ///< of projected vertices: 8 in the largest windows, else more
    double fixed_unit_;       ///< of these bits
    double plane_tolerance_;  ///< what snapping may move a vertex out of its plane
    int width_ = 0, height_ = 0, tiles_x_ = 0, tiles_y_ = 0;
    WindowTransform window_;
    std::vector<ProjectedVertex> projected_;
    std::vector<Bins> bins_;
    std::vector<Scratch> scratch_;  ///< one a worker
};

/// Pixel size for which a bundle's window is about `resolution` pixels wide: the mean width of the
/// bounding box over directions, divided by it. \throws UsageError unless resolution is in [16,
/// 8192].
[[nodiscard]] double pixel_size_for(const SurfaceMesh& mesh, int resolution);

/// Pixel size for which a leaf of mean area is three pixels wide, of windows between 256 and 4096
/// wide. What sampling by pixels adds to the variance of a leaf goes with pixel area over its own:
/// of the whole surface, that is the mean by area of 1 / area, which is 1 / mean area, however
/// large the largest leaves are.
[[nodiscard]] double automatic_pixel_size(const SurfaceMesh& mesh, const PatchHierarchy& patches);

}  // namespace transillum
