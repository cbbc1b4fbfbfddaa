#include <transillum/base/sampling.h>
#include <transillum/transport/choose_splits.h>

#include <algorithm>
#include <bit>
#include <limits>
#include <unordered_map>

namespace transillum {

namespace {

struct Candidate {
    std::uint32_t leaf = 0;
    double gain = 0.0;  ///< squared spread times area
};

/// Where leaves of one plane meet: a place, and the normal to about a degree.
struct Corner {
    glm::dvec3 place;
    glm::ivec3 normal;
    bool operator==(const Corner&) const = default;
};

struct HashOfCorner {
    std::size_t operator()(const Corner& c) const {
        std::uint64_t h = 0;
        for (int i = 0; i < 3; ++i) {
            h = hash_bits(h ^ std::bit_cast<std::uint64_t>(c.place[i] + 0.0));
            h = hash_bits(h ^ static_cast<std::uint32_t>(c.normal[i]));
        }
        return h;
    }
};

/// Corner of every leaf's corner, three a leaf. Snapped vertices and their midpoints are exact, so
/// equal places have equal coordinates.
std::vector<std::uint32_t> number_corners(const SurfaceMesh& mesh, const PatchHierarchy& leaves,
                                          std::uint32_t& count) {
    std::unordered_map<Corner, std::uint32_t, HashOfCorner> known;
    known.reserve(leaves.leaf_count);
    std::vector<std::uint32_t> corners;
    corners.reserve(std::size_t{3} * leaves.leaf_count);
    for (std::uint32_t leaf = 0; leaf < leaves.leaf_count; ++leaf) {
        const glm::ivec3 normal(glm::round(50.0 * normal_of(mesh, leaves.root_of_leaf[leaf])));
        for (const glm::dvec3& place : points_of_leaf(mesh, leaves, leaf))
            corners.push_back(
                known.try_emplace({place, normal}, static_cast<std::uint32_t>(known.size()))
                    .first->second);
    }
    count = static_cast<std::uint32_t>(known.size());
    return corners;
}

/// How far apart the means are, beyond their errors, of the patches of one side that meet at each
/// corner.
std::vector<double> ranges_at_corners(const std::vector<std::uint32_t>& corners,
                                      std::uint32_t corner_count, std::uint32_t first_patch,
                                      std::span<const Spectrum> values,
                                      std::span<const Spectrum> error) {
    struct Range {
        double low = std::numeric_limits<double>::infinity(), high = -low, error = 0.0;
    };
    std::vector<Range> ranges(corner_count);
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const std::size_t p = first_patch + i / 3;
        const double value = luminance(SpectrumSum(values[p]));
        Range& r = ranges[corners[i]];
        r.low = std::min(r.low, value);
        r.high = std::max(r.high, value);
        if (!error.empty()) r.error = std::max(r.error, luminance(SpectrumSum(error[p])));
    }
    std::vector<double> result;
    for (const Range& r : ranges) result.push_back(std::max(0.0, r.high - r.low - r.error));
    return result;
}

}  // namespace

double mean_luminance(const SurfaceMesh& mesh, const PatchHierarchy& patches,
                      std::span<const Spectrum> radiance) {
    double sum = 0.0, area = 0.0;
    for (std::uint32_t p = 0; p < patches.patch_count(); ++p) {
        const double l = luminance(SpectrumSum(radiance[p]));
        if (!(l > 0.0)) continue;
        const double a = area_of_leaf(mesh, patches, patches.leaf_of_patch(p));
        sum += a * l;
        area += a;
    }
    return area > 0.0 ? sum / area : 0.0;
}

SplitChoice choose_splits(const SurfaceMesh& mesh, const PatchHierarchy& patches,
                          const SplitPatches& children, std::span<const Spectrum> radiance,
                          std::span<const Spectrum> error, std::span<const Spectrum> direct,
                          const SplitOptions& options) {
    const PatchHierarchy& fine = children.patches;
    const double mean = mean_luminance(mesh, fine, radiance) +
                        (direct.empty() ? 0.0 : mean_luminance(mesh, fine, direct));
    const double tolerance = options.tolerance * mean;
    std::uint32_t corner_count = 0;
    const std::vector<std::uint32_t> corners = number_corners(mesh, fine, corner_count);
    std::vector<double> spread(patches.leaf_count, 0.0);
    for (const std::uint32_t side : {0u, fine.leaf_count}) {
        std::vector<double> range = ranges_at_corners(corners, corner_count, side, radiance, error);
        if (!direct.empty()) {
            const auto of_direct = ranges_at_corners(corners, corner_count, side, direct, {});
            for (std::size_t i = 0; i < range.size(); ++i) range[i] += of_direct[i];
        }
        for (std::size_t i = 0; i < corners.size(); ++i) {
            double& widest = spread[children.parent[i / 3]];
            widest = std::max(widest, range[corners[i]]);
        }
    }

    std::vector<Candidate> candidates;
    for (std::uint32_t leaf = 0; leaf < patches.leaf_count; ++leaf)
        if (spread[leaf] > tolerance && patches.level_of_leaf(leaf) < options.max_level)
            candidates.push_back(
                {leaf, spread[leaf] * spread[leaf] * area_of_leaf(mesh, patches, leaf)});
    SplitChoice choice;
    std::size_t most = candidates.size();
    if (options.max_leaves > 0)
        most = std::min<std::size_t>(most, options.max_leaves > patches.leaf_count
                                               ? (options.max_leaves - patches.leaf_count) / 3
                                               : 0);
    choice.limited = most < candidates.size();
    if (choice.limited)
        std::ranges::partial_sort(
            candidates, candidates.begin() + static_cast<std::ptrdiff_t>(most),
            [](const Candidate& a, const Candidate& b) {
                return a.gain > b.gain || (a.gain == b.gain && a.leaf < b.leaf);
            });
    choice.split.resize(patches.leaf_count);
    choice.count = static_cast<std::uint32_t>(most);
    for (std::size_t i = 0; i < most; ++i) choice.split[candidates[i].leaf] = 1;
    return choice;
}

}  // namespace transillum
