#include "repair/defects/edge_table.h"
#include "repair/defects/find_defects.h"

#include <transillum/base/sampling.h>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <unordered_map>
#include <utility>

namespace transillum {

namespace {

constexpr std::uint32_t none = 0xffffffffu;

/// Vertices that are taken for themselves, by cells of a grid. Different cells may share a key:
/// distances decide.
class VertexGrid {
public:
    VertexGrid(const std::vector<glm::dvec3>& positions, double tolerance)
        : positions_(positions), tolerance_(tolerance), next_(positions.size(), none) {
        low_ = positions.front();
        for (const glm::dvec3& p : positions) low_ = glm::min(low_, p);
        first_.reserve(positions.size());
    }

    void add(std::uint32_t vertex) {
        const glm::dvec3 cell = cell_of(positions_[vertex]);
        const auto [at, is_new] = first_.try_emplace(key_of(cell), vertex);
        if (!is_new) next_[vertex] = std::exchange(at->second, vertex);
    }

    /// Of those within the tolerance the nearest that `accepts`, the earliest of several; or none.
    template <class Accepts>
    [[nodiscard]] std::uint32_t nearest(std::uint32_t vertex, const Accepts& accepts) const {
        const glm::dvec3& p = positions_[vertex];
        const glm::dvec3 from = cell_of(p - tolerance_), to = cell_of(p + tolerance_);
        std::uint32_t best = none;
        double best_distance = tolerance_;
        // Cells are wider than what is near, so these are all; counting from one to the other would
        // never end where they are too large for a double to count.
        for (unsigned corner = 0; corner < 8; ++corner) {
            const glm::bvec3 other(corner & 1u, corner & 2u, corner & 4u);
            if (glm::any(glm::bvec3(other.x && from.x == to.x, other.y && from.y == to.y,
                                    other.z && from.z == to.z)))
                continue;
            const auto at = first_.find(key_of(glm::mix(from, to, other)));
            if (at == first_.end()) continue;
            for (std::uint32_t v = at->second; v != none; v = next_[v]) {
                const double d = glm::length(positions_[v] - p);
                if (d > best_distance || (d == best_distance && v > best)) continue;
                if (!accepts(v)) continue;
                best = v;
                best_distance = d;
            }
        }
        return best;
    }

private:
    /// Cells far wider than the tolerance, as most vertices need to look into one only.
    [[nodiscard]] glm::dvec3 cell_of(const glm::dvec3& p) const {
        return glm::floor((p - low_) / (16.0 * tolerance_));
    }
    [[nodiscard]] static std::uint64_t key_of(const glm::dvec3& cell) {
        const auto part = [](double x) {
            return static_cast<std::uint64_t>(static_cast<std::int64_t>(std::fmod(x, 0x1p62)));
        };
        return hash_bits(hash_bits(hash_bits(part(cell.x)) ^ part(cell.y)) ^ part(cell.z));
    }

    const std::vector<glm::dvec3>& positions_;
    double tolerance_;
    glm::dvec3 low_{};
    std::unordered_map<std::uint64_t, std::uint32_t> first_;
    std::vector<std::uint32_t> next_;
};

/// Vertices by turns, each for itself or in the place of one of those within the tolerance.
class VertexJoins {
public:
    VertexJoins(const TriangleSoup& soup, double tolerance)
        : soup_(soup),
          corners_(soup),
          grid_(soup.positions, tolerance),
          next_joined_(soup.positions.size(), none),
          taken_(soup.positions.size()) {
        std::iota(taken_.begin(), taken_.end(), 0u);
    }

    /// \param by_triangle only one with which, or with what takes its place, it shares a triangle;
    /// else only one with which it shares none
    void add(std::uint32_t v, bool by_triangle) {
        const std::uint32_t near = grid_.nearest(v, [&](std::uint32_t candidate) {
            for (std::uint32_t i = candidate; i != none; i = next_joined_[i])
                if (share_triangle(v, i)) return by_triangle;
            return !by_triangle;
        });
        if (near == none) {
            grid_.add(v);
        } else {
            taken_[v] = near;
            next_joined_[v] = std::exchange(next_joined_[near], v);
        }
    }

    [[nodiscard]] const std::vector<std::uint32_t>& taken() const { return taken_; }

private:
    [[nodiscard]] bool share_triangle(std::uint32_t a, std::uint32_t b) const {
        return std::ranges::any_of(corners_[a], [&](std::uint32_t corner) {
            const auto& v = soup_.triangles[corner / 3].vertices;
            return v[0] == b || v[1] == b || v[2] == b;
        });
    }

    const TriangleSoup& soup_;
    VertexCorners corners_;
    VertexGrid grid_;
    std::vector<std::uint32_t> next_joined_, taken_;
};

std::vector<std::uint32_t> join_vertices(const TriangleSoup& soup, const std::vector<bool>& which,
                                         double tolerance, bool by_triangle) {
    VertexJoins joins(soup, tolerance);
    for (std::uint32_t v = 0; v < soup.positions.size(); ++v)
        if (which[v]) joins.add(v, by_triangle);
    return joins.taken();
}

std::vector<std::uint32_t> all_as_they_are(const TriangleSoup& soup) {
    std::vector<std::uint32_t> taken(soup.positions.size());
    std::iota(taken.begin(), taken.end(), 0u);
    return taken;
}

}  // namespace

std::vector<std::uint32_t> find_near_vertices(const TriangleSoup& soup, double tolerance) {
    if (soup.positions.empty() || !(tolerance > 0.0)) return all_as_they_are(soup);
    return join_vertices(soup, border_vertices(soup), tolerance, false);
}

std::vector<std::uint32_t> find_short_edges(const TriangleSoup& soup,
                                            const std::vector<bool>& which, double tolerance) {
    if (soup.positions.empty() || !(tolerance > 0.0)) return all_as_they_are(soup);
    return join_vertices(soup, which, tolerance, true);
}

}  // namespace transillum
