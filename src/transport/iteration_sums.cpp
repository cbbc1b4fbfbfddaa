#include "transport/iteration_sums.h"

#include <algorithm>

namespace transillum {

namespace {

/// By its share, each sum of a block; products of two by its square.
PatchSums part_of(const PatchSums& s, double share) {
    const double square = share * share;
    return {share * s.received,          share * s.coverage,           share * s.fragments,
            square * s.received_squared, square * s.received_coverage, square * s.coverage_squared};
}

/// The square of a sum of n equal terms is n times the sum of their squares, and never more.
PatchSums united(std::span<const LeafShare> parts, std::span<const PatchSums> sums,
                 std::uint32_t offset, double scale) {
    PatchSums all;
    for (const LeafShare& part : parts)
        all += part_of(sums[offset + part.leaf], scale * double{part.share});
    const auto n = static_cast<double>(parts.size());
    all.received_squared *= n;
    all.received_coverage *= n;
    all.coverage_squared *= n;
    return all;
}

/// Calls for every pair of bins that have something in common, with the share of the earlier one.
template <class Body>
void for_common_bins(const GlossySide& earlier, const GlossySide& side, Body body) {
    const int finest = std::max(earlier.bin_level, side.bin_level);
    const float share =
        1.0f / static_cast<float>(bin_count(std::max(0, side.bin_level - earlier.bin_level)));
    const int edge = 1 << finest;
    const auto at = [&](int x, int y, int level) {
        const int shift = finest - level;
        return ((y >> shift) << level) + (x >> shift);
    };
    for (int y = 0; y < edge; ++y)
        for (int x = 0; x < edge; ++x)
            body(at(x, y, earlier.bin_level), at(x, y, side.bin_level), share);
}

}  // namespace

bool is_of(const IterationSums& sums, const PatchHierarchy& patches, const GlossySides& glossy,
           double pixel_size) {
    const auto alike = [](const GlossySide& a, const GlossySide& b) {
        return a.root == b.root && a.back == b.back && a.bin_level == b.bin_level &&
               a.first_element == b.first_element;
    };
    return sums.pixel_size == pixel_size && std::ranges::equal(sums.sides, glossy.sides, alike) &&
           sums.patches == patches;
}

FiniteElementSums inherited(const IterationSums& sums, const FiniteElementSums& elements,
                            const PatchHierarchy& patches, const GlossySides& glossy,
                            double pixel_size) {
    if (elements.patches.empty()) return {};
    const double scale = sums.pixel_size * sums.pixel_size / (pixel_size * pixel_size);
    const LeafShares shares = leaf_shares(sums.patches, patches);
    FiniteElementSums out;
    out.patches.resize(patches.patch_count());
    for (std::uint32_t p = 0; p < out.patches.size(); ++p)
        out.patches[p] = united(shares.of(patches.leaf_of_patch(p)), elements.patches,
                                patches.is_back(p) ? sums.patches.leaf_count : 0, scale);
    out.glossy.resize(glossy.element_count);
    std::size_t next = 0;
    for (const GlossySide& side : glossy.sides) {
        // Both lists are in the same order.
        while (next < sums.sides.size() && std::pair(sums.sides[next].back, sums.sides[next].root) <
                                               std::pair(side.back, side.root))
            ++next;
        const GlossySide* const earlier = next < sums.sides.size() ? &sums.sides[next] : nullptr;
        if (!earlier || earlier->root != side.root || earlier->back != side.back) continue;
        const std::uint32_t offset = side.back ? patches.leaf_count : 0;
        const std::uint32_t earlier_offset = side.back ? sums.patches.leaf_count : 0;
        for (std::uint32_t p = side.first_patch; p < side.first_patch + side.leaf_count; ++p)
            for (const LeafShare& part : shares.of(p - offset))
                for_common_bins(*earlier, side, [&](int from, int to, float share) {
                    out.glossy[side.element(to, p)] +=
                        share * part.share * static_cast<float>(scale) *
                        elements.glossy[earlier->element(from, earlier_offset + part.leaf)];
                });
    }
    out.escaped = scale * elements.escaped;
    out.entered = scale * elements.entered;
    out.weights = elements.weights;
    out.blocks = elements.blocks;
    return out;
}

}  // namespace transillum
