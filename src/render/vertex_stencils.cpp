#include "render/vertex_stencils.h"

#include <algorithm>

namespace transillum {

namespace {

/// Patches that were never seen have a say only where no other has.
constexpr float least_weight = 1e-6f;
constexpr std::uint32_t hangs_on_none = 0xffffffffu;

class StencilBuilder {
public:
    StencilBuilder(const Solution& solution, const VertexGrid& grid)
        : solution_(solution), grid_(grid), hanging_(grid.vertex_count(), hangs_on_none) {
        for (std::uint32_t i = 0; i < grid.hanging.size(); ++i)
            hanging_[grid.hanging[i].vertex] = i;
    }

    void append(std::uint32_t vertex, bool back, float scale,
                std::vector<VertexStencils::Entry>& entries) const {
        if (hanging_[vertex] != hangs_on_none) {
            const VertexGrid::Hanging& h = grid_.hanging[hanging_[vertex]];
            append(h.from, back, scale * (1.0f - h.share), entries);
            append(h.to, back, scale * h.share, entries);
            return;
        }
        const std::size_t begin = entries.size();
        const PatchHierarchy& patches = solution_.patches;
        float whole = 0.0f;
        for (const std::uint32_t leaf : grid_.leaves_at(vertex)) {
            const GlossySide* const side = solution_.glossy.find(patches.root_of_leaf[leaf], back);
            if (!side) continue;
            const std::uint32_t patch = leaf + (back ? patches.leaf_count : 0);
            const float weight = std::max(solution_.coverage[patch], least_weight);
            entries.push_back(
                {patch, static_cast<std::uint32_t>(side - solution_.glossy.sides.data()), weight});
            whole += weight;
        }
        for (std::size_t i = begin; i < entries.size(); ++i) entries[i].weight *= scale / whole;
    }

private:
    const Solution& solution_;
    const VertexGrid& grid_;
    std::vector<std::uint32_t> hanging_;
};

}  // namespace

VertexStencils::VertexStencils(const Solution& solution, const VertexGrid& grid) {
    const StencilBuilder builder(solution, grid);
    first_.reserve(2 * grid.vertex_count() + 1);
    first_.push_back(0);
    for (std::uint32_t vertex = 0; vertex < grid.vertex_count(); ++vertex)
        for (const bool back : {false, true}) {
            builder.append(vertex, back, 1.0f, entries_);
            first_.push_back(static_cast<std::uint32_t>(entries_.size()));
        }
}

}  // namespace transillum
