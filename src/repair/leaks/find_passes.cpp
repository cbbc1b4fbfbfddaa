#include "repair/leaks/find_passes.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <tuple>

namespace transillum {

namespace {

/// Closest points of two segments (Ericson, Real-Time Collision Detection, 5.1.9).
void approach(const glm::dvec3& p, const glm::dvec3& along_p, const glm::dvec3& q,
              const glm::dvec3& along_q, Pass& best) {
    const glm::dvec3 r = p - q;
    const double a = glm::dot(along_p, along_p), e = glm::dot(along_q, along_q);
    const double b = glm::dot(along_p, along_q), c = glm::dot(along_p, r), f = glm::dot(along_q, r);
    const double across = a * e - b * b;
    double s = across > 1e-24 * a * e ? std::clamp((b * f - c * e) / across, 0.0, 1.0) : 0.5;
    double t = e > 0.0 ? (b * s + f) / e : 0.0;
    if (t < 0.0 || t > 1.0) {
        t = std::clamp(t, 0.0, 1.0);
        s = a > 0.0 ? std::clamp((b * t - c) / a, 0.0, 1.0) : 0.0;
    }
    const glm::dvec3 on_p = p + s * along_p, on_q = q + t * along_q;
    const double distance = glm::length(on_p - on_q);
    if (distance < best.distance) best = {on_p, on_q, distance, best.edge};
}

struct Box {
    glm::dvec3 low{std::numeric_limits<double>::infinity()},
        high{-std::numeric_limits<double>::infinity()};

    void add(const glm::dvec3& p) {
        low = glm::min(low, p);
        high = glm::max(high, p);
    }
    [[nodiscard]] double distance(const Box& other) const {
        return glm::length(glm::max(glm::max(low - other.high, other.low - high), glm::dvec3(0.0)));
    }
};

/// A path in stretches of a few segments: of a long one, most are far from an edge.
class Stretches {
public:
    explicit Stretches(std::span<const glm::dvec3> path) : path_(path) {
        for (std::size_t i = 0; i + 1 < path.size(); ++i) {
            if (i % length == 0) boxes_.emplace_back();
            boxes_.back().add(path[i]);
            boxes_.back().add(path[i + 1]);
        }
    }
    [[nodiscard]] Pass pass_at(std::size_t edge, const glm::dvec3& from,
                               const glm::dvec3& to) const {
        Box box;
        box.add(from);
        box.add(to);
        Pass pass;
        pass.edge = edge;
        for (std::size_t b = 0; b < boxes_.size(); ++b) {
            if (boxes_[b].distance(box) >= pass.distance) continue;
            const std::size_t end = std::min((b + 1) * length, path_.size() - 1);
            for (std::size_t i = b * length; i < end; ++i)
                approach(from, to - from, path_[i], path_[i + 1] - path_[i], pass);
        }
        return pass;
    }

private:
    static constexpr std::size_t length = 8;

    std::span<const glm::dvec3> path_;
    std::vector<Box> boxes_;
};

}  // namespace

std::vector<Pass> find_passes(const TriangleSoup& soup,
                              const std::vector<SideGraph::BorderEdge>& border,
                              std::span<const glm::dvec3> path, const Workers& workers) {
    const Stretches stretches(path);
    std::vector<Pass> passes(border.size());
    workers.for_ranges(border.size(), 256, [&](std::size_t begin, std::size_t end, int) {
        for (std::size_t i = begin; i < end; ++i) {
            const auto& v = soup.triangles[border[i].triangle].vertices;
            const std::uint32_t a = v[border[i].corner], b = v[(border[i].corner + 1) % 3];
            passes[i] = stretches.pass_at(i, soup.positions[a], soup.positions[b]);
        }
    });
    std::ranges::sort(passes, {},
                      [](const Pass& pass) { return std::tuple(pass.distance, pass.edge); });
    return passes;
}

}  // namespace transillum
