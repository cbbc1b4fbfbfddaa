#include "render/hanging_vertices.h"
#include "render/surface_radiance.h"
#include "render/tone_mapping.h"
#include "render/vertex_grid.h"

#include <transillum/render/make_radiance_mesh.h>
#include <transillum/solution/stored_patches.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace transillum {

namespace {

class MeshBuilder {
public:
    MeshBuilder(const Solution& solution, const VertexGrid& grid, std::vector<Spectrum> values,
                bool interpolate)
        : solution_(solution),
          grid_(grid),
          hanging_(grid),
          values_(std::move(values)),
          interpolate_(interpolate),
          numbers_(2 * grid.vertex_count(), none) {}

    RadianceMesh build() {
        const SurfaceMesh& surface = solution_.surface;
        mesh_.objects = surface.objects;
        for (const Material& m : surface.materials) mesh_.materials.push_back(m.name);
        for (const std::uint32_t patch : stored_patches(solution_)) add(patch);
        std::ranges::stable_sort(mesh_.triangles, {}, &RadianceMesh::Triangle::object);
        return std::move(mesh_);
    }
    /// 1 for vertices of emitters.
    [[nodiscard]] const std::vector<float>& emitter_mask() const { return emits_; }

private:
    static constexpr std::uint32_t none = 0xffffffffu;

    void add(std::uint32_t patch) {
        const std::uint32_t leaf = solution_.patches.leaf_of_patch(patch);
        const auto& corners = grid_.leaf_vertices[leaf];
        std::vector<std::uint32_t> around;
        for (std::size_t c = 0; c < 3; ++c) {
            const std::uint32_t from = corners[c], to = corners[(c + 1) % 3];
            around.push_back(vertex(patch, from));
            for (const HangingVertices::Place& place : hanging_.between(from, to))
                around.push_back(place.vertex != HangingVertices::none
                                     ? vertex(patch, place.vertex)
                                     : add_between(patch, from, to, place));
        }
        if (around.size() == 3) return add_triangle(patch, around[0], around[1], around[2]);
        // Each edge of the polygon with the middle: none of these is without area.
        const std::uint32_t middle = add_middle(patch);
        for (std::size_t i = 0; i < around.size(); ++i)
            add_triangle(patch, around[i], around[(i + 1) % around.size()], middle);
    }

    std::uint32_t vertex(std::uint32_t patch, std::uint32_t number) {
        if (!interpolate_) return add_vertex(grid_.positions[number], values_[patch], patch);
        const std::size_t i =
            number + (solution_.patches.is_back(patch) ? grid_.vertex_count() : 0);
        if (numbers_[i] == none)
            numbers_[i] = add_vertex(grid_.positions[number], values_[i], patch);
        return numbers_[i];
    }

    /// Where another surface has a vertex, which this one does not take part in.
    std::uint32_t add_between(std::uint32_t patch, std::uint32_t from, std::uint32_t to,
                              const HangingVertices::Place& place) {
        if (!interpolate_) return add_vertex(place.position, values_[patch], patch);
        const Spectrum a = mesh_.radiance[vertex(patch, from)];
        const Spectrum b = mesh_.radiance[vertex(patch, to)];
        return add_vertex(place.position, a + place.share * (b - a), patch);
    }

    std::uint32_t add_middle(std::uint32_t patch) {
        const std::uint32_t leaf = solution_.patches.leaf_of_patch(patch);
        if (!interpolate_) return add_vertex(grid_.leaf_centres[leaf], values_[patch], patch);
        Spectrum mean(0.0f);
        for (const std::uint32_t v : grid_.leaf_vertices[leaf])
            mean += mesh_.radiance[vertex(patch, v)] / 3.0f;
        return add_vertex(grid_.leaf_centres[leaf], mean, patch);
    }

    std::uint32_t add_vertex(const glm::dvec3& position, const Spectrum& radiance,
                             std::uint32_t patch) {
        mesh_.positions.push_back(position);
        mesh_.radiance.push_back(radiance);
        emits_.push_back(solution_.emits(patch) ? 1.0f : 0.0f);
        return static_cast<std::uint32_t>(mesh_.positions.size() - 1);
    }

    void add_triangle(std::uint32_t patch, std::uint32_t a, std::uint32_t b, std::uint32_t c) {
        if (solution_.patches.is_back(patch)) std::swap(b, c);
        const std::uint32_t leaf = solution_.patches.leaf_of_patch(patch);
        const RootTriangle& root =
            solution_.surface.triangles[solution_.patches.root_of_leaf[leaf]];
        mesh_.triangles.push_back({{a, b, c}, root.object, root.material, patch});
    }

    const Solution& solution_;
    const VertexGrid& grid_;
    const HangingVertices hanging_;
    /// Of each patch or vertex, see surface_radiance().
    const std::vector<Spectrum> values_;
    const bool interpolate_;
    std::vector<std::uint32_t> numbers_;  ///< in the mesh: of the grid's, as values_ has them
    std::vector<float> emits_;
    RadianceMesh mesh_;
};

}  // namespace

RadianceMesh make_radiance_mesh(const SpectralSolution& spectral,
                                const RadianceMeshOptions& options, const Workers& workers) {
    const Solution& solution = spectral.rgb;
    const VertexGrid grid = build_vertex_grid(solution.surface, solution.patches);
    MeshBuilder builder(solution, grid,
                        surface_radiance(spectral, options.interpolate ? &grid : nullptr,
                                         options.components, workers),
                        options.interpolate);
    RadianceMesh mesh = builder.build();
    const float factor =
        surface_exposure_factor(mesh.radiance, builder.emitter_mask(), options.tone);
    mesh.exposure = std::log2(double{factor});
    for (const Spectrum& radiance : mesh.radiance)
        mesh.display.push_back(compress_highlights(factor * radiance));
    return mesh;
}

}  // namespace transillum
