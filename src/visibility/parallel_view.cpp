#include <transillum/visibility/parallel_view.h>

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace transillum {

ParallelView::ParallelView(const SurfaceMesh& mesh, const PatchHierarchy& patches, int resolution)
    : mesh_(mesh),
      patches_(patches),
      buffer_(mesh, patches, pixel_size_for(mesh, resolution)),
      pixels_(patches.patch_count()),
      views_(patches.patch_count()) {}

const std::vector<PatchView>& ParallelView::look(const Bundle& bundle, const Workers& workers) {
    constexpr auto relaxed = std::memory_order_relaxed;
    for (Pixels& p : pixels_) {
        p.all.store(0, relaxed);
        p.first.store(0, relaxed);
    }
    // Counts of whole numbers come out alike in any order.
    buffer_.trace(bundle, workers, [&](const TileLists& tile, int) {
        for (int i = 0; i < tile.width * tile.height; ++i) {
            for (std::uint32_t f = tile.first[i]; f < tile.first[i + 1]; ++f) {
                Pixels& p = pixels_[lower_patch(tile.fragments[f], patches_.leaf_count)];
                p.all.fetch_add(1, relaxed);
                if (f == tile.first[i]) p.first.fetch_add(1, relaxed);
            }
        }
    });
    const glm::dvec3& direction = bundle.frame[2];
    std::ranges::fill(views_, PatchView{});
    for (std::uint32_t leaf = 0; leaf < patches_.leaf_count; ++leaf) {
        const double facing = -glm::dot(normal_of(mesh_, patches_.root_of_leaf[leaf]), direction);
        const std::uint32_t patch = leaf + (facing < 0.0 ? patches_.leaf_count : 0);
        const auto all = static_cast<float>(pixels_[patch].all.load(relaxed));
        const auto first = static_cast<float>(pixels_[patch].first.load(relaxed));
        const float seen = all > 0.0f ? first / all : is_open(patch, direction) ? 1.0f : 0.0f;
        views_[patch] = {static_cast<float>(std::abs(facing)), seen};
    }
    return views_;
}

bool ParallelView::is_open(std::uint32_t patch, const glm::dvec3& direction) {
    if (!rays_) rays_ = std::make_unique<RayTracer>(mesh_);
    const std::uint32_t leaf = patches_.leaf_of_patch(patch), root = patches_.root_of_leaf[leaf];
    const glm::dvec3 centre = leaf_centre(mesh_, patches_, leaf);
    const double out = buffer_.pixel_size() * (buffer_.window_width() + buffer_.window_height());
    return !rays_->occluded(centre, normal_of(mesh_, root), centre - out * direction,
                            glm::dvec3(0.0));
}

}  // namespace transillum
