#include "repair/defects/find_sheets.h"

#include <algorithm>
#include <numeric>

namespace transillum {

namespace {

constexpr std::uint32_t none = 0xffffffffu;

/// Disjoint sets whose members know whether they run like their set's first.
class TurnSets {
public:
    explicit TurnSets(std::size_t n) : parent_(n), turned_(n, 0) {
        std::iota(parent_.begin(), parent_.end(), 0u);
    }

    struct Place {
        std::uint32_t root;
        bool turned;
    };
    Place find(std::uint32_t i) {
        std::uint32_t root = i;
        std::uint8_t turned = 0;
        for (; parent_[root] != root; root = parent_[root]) turned ^= turned_[root];
        for (std::uint8_t rest = turned; parent_[i] != root && i != root;) {
            const std::uint32_t next = parent_[i];
            const std::uint8_t step = turned_[i];
            parent_[i] = root;
            turned_[i] = rest;
            rest ^= step;
            i = next;
        }
        return {root, turned != 0};
    }

    /// False where the two are joined already, the other way.
    bool join(std::uint32_t a, std::uint32_t b, bool turned) {
        const Place at_a = find(a), at_b = find(b);
        const bool between = at_a.turned ^ at_b.turned ^ turned;
        if (at_a.root == at_b.root) return !between;
        // The smallest index leads, so that numbering follows the file.
        const auto [first, later] = std::minmax(at_a.root, at_b.root);
        parent_[later] = first;
        turned_[later] = between;
        return true;
    }

private:
    std::vector<std::uint32_t> parent_;
    std::vector<std::uint8_t> turned_;  ///< against the parent
};

}  // namespace

Sheets find_sheets(const TriangleSoup& soup, const EdgeTable& edges) {
    const auto count = static_cast<std::uint32_t>(soup.triangles.size());
    TurnSets sets(count);
    std::vector<std::uint32_t> twisted;
    for (std::uint32_t e = 0; e < edges.size(); ++e) {
        if (edges[e].size() != 2) continue;
        const EdgeUse& a = edges[e][0];
        const EdgeUse& b = edges[e][1];
        if (!sets.join(a.triangle(), b.triangle(), a.ascending == b.ascending))
            twisted.push_back(a.triangle());
    }
    Sheets sheets;
    sheets.sheet.resize(count);
    sheets.turned.resize(count);
    std::vector<std::uint32_t> number(count, none), first;
    for (std::uint32_t t = 0; t < count; ++t) {
        const auto [root, turned] = sets.find(t);
        if (number[root] == none) {
            number[root] = static_cast<std::uint32_t>(first.size());
            first.push_back(t);
        }
        sheets.sheet[t] = number[root];
        sheets.turned[t] = turned;
    }
    sheets.orientable.assign(first.size(), true);
    sheets.mixed.assign(first.size(), false);
    for (const std::uint32_t t : twisted) sheets.orientable[sheets.sheet[t]] = false;
    for (std::uint32_t t = 0; t < count; ++t)
        if (sheets.turned[t]) sheets.mixed[sheets.sheet[t]] = true;
    return sheets;
}

}  // namespace transillum
