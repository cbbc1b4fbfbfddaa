#include "render/lightmap/chart.h"
#include "render/lightmap/fill_chart.h"
#include "render/surface_radiance.h"
#include "render/tone_mapping.h"

#include <transillum/base/error.h>
#include <transillum/render/make_lightmap.h>
#include <transillum/solution/stored_patches.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <map>
#include <string>
#include <tuple>

namespace transillum {

namespace {

constexpr int least_lightmap = 64;
constexpr int largest_by_default = 4096;
/// Of the lightmap's texels, those that are found a use for.
constexpr double usual_share = 0.6;

struct ShiningSides {
    std::vector<RootSide> sides;
    std::size_t patches = 0;
    double area = 0.0;
};

ShiningSides shining_sides(const Solution& s) {
    ShiningSides result;
    for (const std::uint32_t patch : stored_patches(s)) {
        ++result.patches;
        const std::uint32_t leaf = s.patches.leaf_of_patch(patch);
        const RootSide side{s.patches.root_of_leaf[leaf], s.patches.is_back(patch)};
        if (!result.sides.empty() && result.sides.back() == side) continue;
        result.sides.push_back(side);
        result.area += area_of(s.surface, side.root);
    }
    return result;
}

/// A patch has half the area of the square over its edge.
int size_for(std::size_t patches) {
    constexpr double texels_a_patch = 2.0;
    const double texels = texels_a_patch * static_cast<double>(patches) / usual_share;
    const auto size = std::bit_ceil(static_cast<unsigned>(std::ceil(std::sqrt(texels))));
    return std::clamp(static_cast<int>(size), least_lightmap, largest_by_default);
}

void check(const LightmapOptions& o) {
    if (o.size < 0 || o.size > largest_lightmap)
        throw UsageError("lightmap of " + std::to_string(o.size) +
                         " texels; accepted: 0 (automatic) to " + std::to_string(largest_lightmap));
}

/// The finest that fit, nearly. Where they don't though texels are as long as the scene, it is the
/// padding that needs the room.
std::vector<Chart> lay_out(const SurfaceMesh& mesh, const ShiningSides& shining, int size,
                           double& texel) {
    constexpr double coarser = 1.08;
    const double side = std::sqrt(shining.area);
    const ChartMaker maker(mesh, shining.sides);
    for (texel = side / size; texel < side; texel *= coarser) {
        std::vector<Chart> charts = maker.make(texel);
        if (pack_charts(charts, size)) return charts;
        double used = 0.0;
        for (const Chart& c : charts) used += double(c.width) * c.height;
        texel *= std::max(1.0, std::sqrt(used) / size);
    }
    throw UsageError("lightmap of " + std::to_string(size) + " texels; accepted for " +
                     std::to_string(shining.sides.size()) + " triangles: a larger one");
}

class LightmapMesh {
public:
    LightmapMesh(const RadianceField& field, int size)
        : field_(field), surface_(field.solution.surface), size_(size) {
        mesh_.objects = surface_.objects;
        for (const Material& m : surface_.materials) mesh_.materials.push_back(m.name);
    }

    void add(const Chart& chart) {
        vertices_.clear();
        for (const Chart::Triangle& t : chart.triangles) {
            const RootTriangle& root = surface_.triangles[t.side.root];
            const PatchHierarchy& patches = field_.solution.patches;
            RadianceMesh::Triangle triangle;
            triangle.object = root.object;
            triangle.material = root.material;
            triangle.patch =
                patches.roots[t.side.root].first_leaf + (t.side.back ? patches.leaf_count : 0u);
            for (std::size_t i = 0; i < 3; ++i) triangle.vertices[i] = vertex(chart, t, i);
            if (t.side.back) std::swap(triangle.vertices[1], triangle.vertices[2]);
            mesh_.triangles.push_back(triangle);
        }
    }

    RadianceMesh take() {
        std::ranges::stable_sort(mesh_.triangles, {}, &RadianceMesh::Triangle::object);
        return std::move(mesh_);
    }

private:
    std::uint32_t vertex(const Chart& chart, const Chart::Triangle& t, std::size_t corner) {
        const std::uint32_t number = surface_.triangles[t.side.root].vertices[corner];
        const glm::vec2 uv = surface_.uvs.empty()
                                 ? glm::vec2(0.0f)
                                 : surface_.uvs[3 * std::size_t{t.side.root} + corner];
        const auto [found, is_new] = vertices_.try_emplace(
            {number, uv.x, uv.y}, static_cast<std::uint32_t>(mesh_.positions.size()));
        if (!is_new) return found->second;
        mesh_.positions.push_back(surface_.positions[number]);
        if (!surface_.uvs.empty()) mesh_.uvs.push_back(uv);
        mesh_.lightmap_uvs.emplace_back((t.corners[corner] + glm::dvec2(chart.x, chart.y)) /
                                        double(size_));
        mesh_.radiance.push_back(field_.at(t.side, {corner == 1, corner == 2}));
        return found->second;
    }

    const RadianceField& field_;
    const SurfaceMesh& surface_;
    const int size_;
    std::map<std::tuple<std::uint32_t, float, float>, std::uint32_t> vertices_;  ///< of a chart
    RadianceMesh mesh_;
};

}  // namespace

Lightmap make_lightmap(const SpectralSolution& spectral, const LightmapOptions& options,
                       const Workers& workers) {
    check(options);
    const Solution& s = spectral.rgb;
    const ShiningSides shining = shining_sides(s);
    if (shining.sides.empty())
        throw InputError("lightmap", "nothing to write: no side of the solution shines");
    const int size = options.size > 0 ? options.size : size_for(shining.patches);
    Lightmap result;
    const std::vector<Chart> charts = lay_out(s.surface, shining, size, result.texel);
    result.charts = static_cast<int>(charts.size());
    const std::size_t texels = std::size_t(size) * size;
    result.image = {size, size, std::vector<Spectrum>(texels, Spectrum(0.0f)),
                    std::vector<float>(texels, 0.0f)};

    const VertexGrid grid = build_vertex_grid(s.surface, s.patches);
    const std::vector<Spectrum> values =
        surface_radiance(spectral, &grid, options.components, workers);
    const RadianceField field{s, grid, values};
    // Charts share no texel.
    workers.for_ranges(charts.size(), 1, [&](std::size_t begin, std::size_t end, int) {
        for (std::size_t i = begin; i < end; ++i) fill_chart(charts[i], field, result.image);
    });

    LightmapMesh mesh(field, size);
    for (const Chart& chart : charts) mesh.add(chart);
    result.mesh = mesh.take();
    const float factor =
        surface_exposure_factor(result.image.pixels, result.image.emitter_mask, options.tone);
    result.mesh.exposure = std::log2(double{factor});
    for (const Spectrum& radiance : result.mesh.radiance)
        result.mesh.display.push_back(compress_highlights(factor * radiance));
    result.image.emitter_mask.clear();  // no channel of a lightmap
    result.mesh.lightmap_png = png_bytes(result.image, {result.mesh.exposure, false});
    return result;
}

}  // namespace transillum
