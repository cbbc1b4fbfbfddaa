/// What a point sees through the five faces of a hemicube (paper §4), by the same scan conversion
/// as the transillumination buffer.
#pragma once

#include <transillum/geometry/patch_hierarchy.h>
#include <transillum/geometry/surface_mesh.h>

#include <glm/mat3x3.hpp>

#include <cstdint>
#include <functional>
#include <vector>

namespace transillum {

/// Relative strength of a point's light towards a unit direction, not negative.
using Distribution = std::function<double(const glm::dvec3& direction)>;

/// A small surface element, seen from a point of unit area density: geometry only.
struct PatchView {
    /// Mean over the patch of cos * cos' / r^2, cos at the point and cos' at the patch, as if
    /// unoccluded [1 / square unit].
    float mean_kernel = 0.0f;
    float visibility = 0.0f;  ///< seen share of it [0, 1]
};

/// Its memory is reused from view to view; not thread-safe, one a worker.
class Hemicube {
public:
    /// Keeps references. \param resolution pixels along an edge of the cube [16, 4096], even.
    /// \throws UsageError otherwise.
    Hemicube(const SurfaceMesh& mesh, const PatchHierarchy& patches, int resolution);
    ~Hemicube();

    /// The view from `position`, upwards along the third column of `frame`. One entry a patch.
    /// Flux is kept: the sum of area * mean_kernel * visibility over them is the cosine-weighted
    /// solid angle (at most pi) under which they are seen.
    const std::vector<PatchView>& look(const glm::dvec3& position, const glm::dmat3& frame);
    /// The view all around a point in free space, through a cube: two hemicubes back to back. The
    /// distribution takes the place of the cosine at the point, so that with 1 the sum is the solid
    /// angle (at most 4 pi) but for the error of each patch, which is small.
    const std::vector<PatchView>& look_around(const glm::dvec3& position, const glm::dmat3& frame,
                                              const Distribution& distribution);

private:
    struct Face;
    /// Sums over the pixels of a patch; float would lose the last pixels of a large one.
    struct PatchSums {
        double seen = 0.0;     ///< cosine-weighted solid angle, where nearest
        double covered = 0.0;  ///< the same, where present at all
        double area = 0.0;     ///< surface behind these pixels
        std::uint32_t pixels = 0;
    };
    struct Pixel {
        float distance;
        std::uint32_t patch;
    };

    const std::vector<PatchView>& look_through(std::vector<Face> faces);
    void keep_flux();
    void weigh_pixels(std::size_t face);
    double weight(std::size_t face, std::size_t pixel, const glm::dvec3& d) const;
    void draw_face(const Face& face);
    void draw_root(const Face& face, std::uint32_t root);
    void add_seen(const Face& face);
    PatchView view_of(const PatchSums& sums, std::uint32_t patch) const;
    PatchView view_of_missed(std::uint32_t patch) const;
    bool is_inside(const Face& face, int x, int y, std::uint32_t patch, double distance) const;
    double front_share(std::uint32_t leaf) const;

    const SurfaceMesh& mesh_;
    const PatchHierarchy& patches_;
    int resolution_;
    glm::dvec3 position_{0.0};
    glm::dmat3 frame_{1.0};
    std::vector<Face> faces_;
    std::vector<std::vector<Pixel>> pixels_;      ///< one a face
    const Distribution* distribution_ = nullptr;  ///< none: the cosine to the axis
    std::vector<std::vector<float>>
        weights_;  ///< of pixels, by face, where there is a distribution
    std::vector<double> leaf_area_;
    std::vector<PatchSums> sums_;
    std::vector<PatchView> views_;
};

}  // namespace transillum
