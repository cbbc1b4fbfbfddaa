/// What segments and rays meet, found in a tree of boxes (CGAL, exact predicates).
#pragma once

#include <transillum/repair/triangle_soup.h>

#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace transillum {

class TriangleTree {
public:
    /// Keeps a reference. \pre every triangle has area
    explicit TriangleTree(const TriangleSoup& soup);
    ~TriangleTree();

    struct Hit {
        std::uint32_t triangle = 0;
        double distance = 0.0;  ///< in lengths of `direction`
    };
    using Skip = std::function<bool(std::uint32_t triangle)>;

    /// The first triangle that a ray meets.
    [[nodiscard]] std::optional<Hit> first_hit(const glm::dvec3& origin,
                                               const glm::dvec3& direction, const Skip& skip) const;
    /// All that a closed segment meets.
    [[nodiscard]] std::vector<std::uint32_t> met_by(const glm::dvec3& from,
                                                    const glm::dvec3& to) const;
    /// All whose boxes meet a cube.
    [[nodiscard]] std::vector<std::uint32_t> near_to(const glm::dvec3& centre, double radius) const;

private:
    struct Tree;
    std::unique_ptr<Tree> tree_;
    const TriangleSoup& soup_;
};

}  // namespace transillum
