#include "first_shot/light_vectors.h"

#include <glm/geometric.hpp>

#include <algorithm>

namespace transillum {

namespace {

constexpr std::size_t patches_at_a_time = 4096;

}  // namespace

LightVectorSums::LightVectorSums(const SurfaceMesh& mesh, const PatchHierarchy& patches,
                                 DirectLight& light)
    : mesh_(mesh), patches_(patches), light_(light), sums_(patches.patch_count()) {
    light_.vectors.assign(patches.patch_count() * light_.first_samples.size(), glm::vec3(0.0f));
}

void LightVectorSums::add(std::size_t sample, const std::vector<PatchView>& views, double scale,
                          const Workers& workers) {
    const std::vector<std::uint32_t>& first = light_.first_samples;
    const auto next = std::ranges::upper_bound(first, sample);
    luminaire_ = static_cast<std::size_t>(next - first.begin()) - 1;
    is_open_ = true;
    workers.for_ranges(views.size(), patches_at_a_time, [&](std::size_t from, std::size_t to, int) {
        for (std::size_t p = from; p < to; ++p) {
            // Rounded as the tables would be.
            const auto kernel = static_cast<float>(views[p].mean_kernel * scale);
            const double share = double{views[p].visibility} * kernel;
            if (share > 0.0) add(light_.samples[sample], static_cast<std::uint32_t>(p), share);
        }
    });
    const bool is_last = sample + 1 == (next == first.end() ? light_.samples.size() : *next);
    if (is_last) close(workers);
}

void LightVectorSums::add(const LightSample& sample, std::uint32_t patch, double share) {
    const glm::dvec3 centre = leaf_centre(mesh_, patches_, patches_.leaf_of_patch(patch));
    sums_[patch].vector += share * glm::normalize(way_to_light(sample, centre));
    sums_[patch].share += share;
}

void LightVectorSums::close(const Workers& workers) {
    if (!is_open_) return;
    is_open_ = false;
    workers.for_ranges(sums_.size(), patches_at_a_time, [&](std::size_t from, std::size_t to, int) {
        for (std::size_t p = from; p < to; ++p) write(static_cast<std::uint32_t>(p));
    });
}

void LightVectorSums::write(std::uint32_t patch) {
    Sum& sum = sums_[patch];
    if (!(sum.share > 0.0)) return;
    const double length = glm::length(sum.vector);
    // Light from all around, or none of its directions known, comes along the normal.
    const glm::dvec3 direction =
        length > 0.0 ? sum.vector / length
                     : normal_of(mesh_, patches_.root_of_leaf[patches_.leaf_of_patch(patch)]) *
                           (patches_.is_back(patch) ? -1.0 : 1.0);
    light_.vectors[patch * light_.first_samples.size() + luminaire_] =
        glm::vec3(sum.share * direction);
    sum = {};
}

}  // namespace transillum
