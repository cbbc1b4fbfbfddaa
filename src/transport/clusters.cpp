#include "transport/clusters.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <limits>
#include <numeric>
#include <span>

namespace transillum {

namespace {

/// Nothing that arrives there is sent on, and nothing else is sent.
bool is_dead(const Material& m, bool back) {
    const bool reflects = max_channel(m.diffuse) > 0.0f || max_channel(m.specular) > 0.0f;
    return !(reflects && (!back || m.back_reflects)) && !(m.emits() && (!back || m.back_emits));
}

/// Position and normal of a root side, so scaled that a normal turned around is as far as the scene
/// is wide.
using Feature = std::array<double, 6>;

struct RootSide {
    Feature feature;
    double area;
    std::uint32_t id;  ///< 2 * root + back
};

struct Group {
    std::span<RootSide> members;
    double priority = 0.0;  ///< area-weighted variance along the widest axis
    int axis = 0;
    double middle = 0.0;
};

Group measure(std::span<RootSide> members) {
    Group g{members};
    double area = 0.0;
    Feature mean{}, square{};
    for (const RootSide& m : members) {
        area += m.area;
        for (int k = 0; k < 6; ++k) {
            mean[k] += m.area * m.feature[k];
            square[k] += m.area * m.feature[k] * m.feature[k];
        }
    }
    if (area == 0.0 || members.size() < 2) return g;
    for (int k = 0; k < 6; ++k) {
        const double variance = square[k] - mean[k] * mean[k] / area;
        if (variance > g.priority) {
            g.priority = variance;
            g.axis = k;
            g.middle = mean[k] / area;
        }
    }
    return g;
}

std::vector<RootSide> root_sides(const SurfaceMesh& mesh) {
    glm::dvec3 low(std::numeric_limits<double>::infinity()), high(-low);
    for (const glm::dvec3& p : mesh.positions) {
        low = glm::min(low, p);
        high = glm::max(high, p);
    }
    const double size = glm::length(high - low);
    std::vector<RootSide> sides;
    for (std::uint32_t r = 0; r < mesh.triangles.size(); ++r) {
        const auto& v = mesh.triangles[r].vertices;
        const glm::dvec3 centre =
            (mesh.positions[v[0]] + mesh.positions[v[1]] + mesh.positions[v[2]]) / 3.0;
        const glm::dvec3 p = (centre - low) / size;
        const double area = area_of(mesh, r);
        for (const std::uint32_t back : {0u, 1u}) {
            const glm::dvec3 n = normal_of(mesh, r) * (back ? -0.5 : 0.5);
            sides.push_back({{p.x, p.y, p.z, n.x, n.y, n.z}, area, 2 * r + back});
        }
    }
    return sides;
}

}  // namespace

Clusters make_clusters(const SurfaceMesh& mesh, const PatchHierarchy& patches) {
    std::vector<RootSide> sides = root_sides(mesh);
    const std::span<RootSide> dead(std::ranges::stable_partition(sides, [&](const RootSide& s) {
        return !is_dead(mesh.materials[mesh.triangles[s.id / 2].material], s.id % 2 == 1);
    }));
    const std::span<RootSide> living(sides.data(), sides.size() - dead.size());
    const std::size_t most = most_clusters - (dead.empty() ? 0 : 1);
    std::vector<Group> groups;
    if (!living.empty()) groups.push_back(measure(living));
    while (!groups.empty() && groups.size() < most) {
        const auto widest = std::max_element(
            groups.begin(), groups.end(),
            [](const Group& a, const Group& b) { return a.priority < b.priority; });
        if (widest->priority <= 0.0) break;
        const Group whole = *widest;
        const auto split = std::stable_partition(
            whole.members.begin(), whole.members.end(),
            [&](const RootSide& s) { return s.feature[whole.axis] < whole.middle; });
        const auto first = static_cast<std::size_t>(split - whole.members.begin());
        if (first == 0 || first == whole.members.size()) {  // equal but for rounding
            widest->priority = 0.0;
            continue;
        }
        *widest = measure(whole.members.first(first));
        groups.push_back(measure(whole.members.subspan(first)));
    }
    if (!dead.empty()) groups.push_back({dead});

    Clusters clusters{static_cast<std::uint32_t>(groups.size()),
                      std::vector<std::uint8_t>(patches.patch_count() + 1)};
    for (std::uint32_t g = 0; g < groups.size(); ++g)
        for (const RootSide& s : groups[g].members) {
            const std::uint32_t root = s.id / 2;
            const std::uint32_t first =
                patches.roots[root].first_leaf + (s.id % 2 ? patches.leaf_count : 0);
            std::fill_n(clusters.of_patch.begin() + first, patches.leaves_of(root),
                        static_cast<std::uint8_t>(g));
        }
    clusters.of_patch.back() = static_cast<std::uint8_t>(clusters.count);
    return clusters;
}

}  // namespace transillum
