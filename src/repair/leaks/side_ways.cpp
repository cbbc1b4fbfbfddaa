#include "repair/leaks/side_ways.h"

#include <glm/geometric.hpp>

#include <algorithm>

namespace transillum {

namespace {

constexpr std::uint32_t most_of_kind = 2048;

/// Fronts and backs apart, as an even stride over both would leave out one of them.
std::vector<Side> choose_starts(const std::vector<std::uint32_t>& part) {
    std::vector<std::uint32_t> size;
    const auto kind = [&](Side side) { return 2 * part[side] + side % 2; };
    for (Side side = 0; side < part.size(); ++side) {
        if (kind(side) >= size.size()) size.resize(kind(side) + 1, 0);
        ++size[kind(side)];
    }
    std::vector<std::uint32_t> seen(size.size(), 0);
    std::vector<Side> starts;
    for (Side side = 0; side < part.size(); ++side) {
        const std::uint32_t stride = (size[kind(side)] + most_of_kind - 1) / most_of_kind;
        if (seen[kind(side)]++ % stride == 0) starts.push_back(side);
    }
    return starts;
}

}  // namespace

Side side_met(const TriangleSoup& soup, std::uint32_t triangle, const glm::dvec3& direction) {
    return 2 * triangle + (glm::dot(area_vector(soup, triangle), direction) < 0.0 ? 0u : 1u);
}

std::vector<Way> find_ways(const TriangleSoup& soup, const TriangleTree& tree,
                           const std::vector<std::uint32_t>& part, double reach,
                           const Workers& workers, const Monitor& monitor) {
    const std::vector<Side> starts = choose_starts(part);
    std::vector<Way> ways(starts.size(), Way{0, 0, 0.0});  // which are left out in the end
    workers.for_ranges(starts.size(), 256, [&](std::size_t begin, std::size_t end, int) {
        for (std::size_t i = begin; i < end; ++i) {
            if (i % 256 == 0 && monitor.stop_requested()) break;
            const Side from = starts[i];
            const glm::dvec3 direction = reach * outward_of(soup, from);
            const auto hit = tree.first_hit(centre_of(soup, from / 2), direction,
                                            [&](std::uint32_t t) { return t == from / 2; });
            ways[i] = {from, Way::outside, reach};
            if (!hit) continue;
            // Where it runs in the plane of what it meets it tells nothing: a way to itself.
            const bool grazes = glm::dot(area_vector(soup, hit->triangle), direction) == 0.0;
            ways[i].to = grazes ? from : side_met(soup, hit->triangle, direction);
            ways[i].length = reach * std::max(hit->distance, 0.0);
        }
    });
    std::erase_if(ways, [](const Way& way) { return way.from == way.to; });
    return ways;
}

}  // namespace transillum
