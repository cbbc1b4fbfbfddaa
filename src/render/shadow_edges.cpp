#include "render/shadow_edges.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>

namespace transillum {

namespace {

constexpr std::size_t samples_a_word = ShadowEdges::samples_a_word;
/// Of a view, in which a patch is seen.
constexpr double least_pixels = 2.0;

std::size_t words_for(std::size_t samples) {
    return (samples + samples_a_word - 1) / samples_a_word;
}

/// Samples that are wholly seen, and that are not seen at all.
struct Found {
    std::uint64_t seen = 0, hidden = 0;
    Found& operator&=(const Found& other) {
        seen &= other.seen;
        hidden &= other.hidden;
        return *this;
    }
};
constexpr Found all_found{~std::uint64_t{0}, ~std::uint64_t{0}};

/// A row of words a patch, or a vertex and side.
struct FoundTable {
    std::size_t words;
    std::vector<Found> found;

    FoundTable(std::size_t rows, std::size_t words_a_row)
        : words(words_a_row), found(rows * words_a_row, all_found) {}
    [[nodiscard]] const Found& at(std::size_t row, std::size_t word) const {
        return found[row * words + word];
    }
    void narrow(std::size_t row, const FoundTable& by, std::size_t row_of_by) {
        for (std::size_t w = 0; w < words; ++w)
            found[row * words + w] &= by.found[row_of_by * words + w];
    }
};

/// How many pixels of the first shot's views a patch fills.
class ViewPixels {
public:
    explicit ViewPixels(const Solution& s)
        : s_(s),
          per_solid_angle_(per_square(s.direct.view_pixel)),
          per_area_(per_square(s.direct.parallel_pixel)) {}

    struct Patch {
        glm::dvec3 centre, area_normal;
    };
    [[nodiscard]] Patch patch(std::uint32_t leaf) const {
        return {leaf_centre(s_.surface, s_.patches, leaf),
                area_of_leaf(s_.surface, s_.patches, leaf) *
                    normal_of(s_.surface, s_.patches.root_of_leaf[leaf])};
    }
    [[nodiscard]] double count(const Patch& patch, const LightSample& sample) const {
        if (sample.kind == LightSample::Kind::directional)
            return std::abs(glm::dot(patch.area_normal, sample.normal)) * per_area_;
        const glm::dvec3 way = sample.position - patch.centre;
        const double squared = glm::dot(way, way);
        return std::abs(glm::dot(patch.area_normal, way)) / (squared * std::sqrt(squared)) *
               per_solid_angle_;
    }

private:
    static double per_square(double edge) { return edge > 0.0 ? 1.0 / (edge * edge) : 0.0; }

    const Solution& s_;
    double per_solid_angle_, per_area_;
};

/// Samples behind a patch's horizon are both: that leaves it to its neighbours.
FoundTable what_patches_found(const Solution& s, std::size_t words, const Workers& workers) {
    const DirectLight& light = s.direct;
    const std::size_t n = light.samples.size();
    const ViewPixels pixels(s);
    FoundTable table(s.patches.patch_count(), words);
    workers.for_ranges(s.patches.patch_count(), 256, [&](std::size_t begin, std::size_t end, int) {
        for (std::size_t p = begin; p < end; ++p) {
            const ViewPixels::Patch patch =
                pixels.patch(s.patches.leaf_of_patch(static_cast<std::uint32_t>(p)));
            for (std::size_t i = 0; i < n; ++i) {
                if (!(light.geometry_factor[p * n + i] > 0.0f)) continue;
                Found& found = table.found[p * words + i / samples_a_word];
                const std::uint64_t bit = std::uint64_t{1} << (i % samples_a_word);
                const bool is_sure = pixels.count(patch, light.samples[i]) >= least_pixels;
                const float visibility = light.visibility[p * n + i];
                if (!is_sure || visibility < 1.0f) found.seen &= ~bit;
                if (!is_sure || visibility > 0.0f) found.hidden &= ~bit;
            }
        }
    });
    return table;
}

/// Patches of each side that touch a vertex, or in whose edge it hangs.
FoundTable what_vertices_found(const FoundTable& of_patches, const PatchHierarchy& patches,
                               const VertexGrid& grid) {
    FoundTable table(2 * grid.vertex_count(), of_patches.words);
    for (const std::size_t side : {0u, 1u}) {
        for (std::uint32_t v = 0; v < grid.vertex_count(); ++v)
            for (const std::uint32_t leaf : grid.leaves_at(v))
                table.narrow(2 * v + side, of_patches, leaf + side * patches.leaf_count);
        for (auto h = grid.hanging.rbegin(); h != grid.hanging.rend(); ++h)
            for (const std::size_t end : {h->from, h->to})
                table.narrow(2 * end + side, table, 2 * std::size_t{h->vertex} + side);
        for (const VertexGrid::Hanging& h : grid.hanging)
            for (const std::size_t end : {h.from, h.to})
                table.narrow(2 * std::size_t{h.vertex} + side, table, 2 * end + side);
    }
    return table;
}

}  // namespace

ShadowEdges::ShadowEdges(const DirectLight& light)
    : words_(words_for(light.samples.size())), of_patches_(words_) {
    for (std::size_t i = 0; i < light.samples.size(); ++i)
        of_patches_[i / samples_a_word].doubtful |= std::uint64_t{1} << (i % samples_a_word);
}

ShadowEdges::ShadowEdges(const Solution& solution, const VertexGrid& grid, const Workers& workers)
    : ShadowEdges(solution.direct) {
    const std::vector<Word> all = std::move(of_patches_);
    const PatchHierarchy& patches = solution.patches;
    const FoundTable found = what_patches_found(solution, words_, workers);
    const FoundTable around = what_vertices_found(found, patches, grid);
    row_size_ = words_;
    of_patches_.resize(found.found.size());
    for (std::uint32_t p = 0; p < patches.patch_count(); ++p)
        for (std::size_t w = 0; w < words_; ++w) {
            Found here = found.at(p, w);
            const std::uint64_t behind_horizon = here.seen & here.hidden;
            for (const std::size_t vertex : grid.leaf_vertices[patches.leaf_of_patch(p)])
                here &= around.at(2 * vertex + (patches.is_back(p) ? 1 : 0), w);
            // What no patch about it faces is hidden.
            const std::uint64_t seen = here.seen & ~here.hidden & ~behind_horizon;
            of_patches_[p * words_ + w] = {seen, all[w].doubtful & ~(seen | here.hidden)};
        }
}

double ShadowEdges::doubtful_share() const {
    std::uint64_t doubtful = 0, lit = 0;
    for (const Word& word : of_patches_) {
        doubtful += static_cast<std::uint64_t>(std::popcount(word.doubtful));
        lit += static_cast<std::uint64_t>(std::popcount(word.doubtful | word.seen));
    }
    return lit > 0 ? static_cast<double>(doubtful) / static_cast<double>(lit) : 0.0;
}

}  // namespace transillum
