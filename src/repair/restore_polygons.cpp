#include "repair/restore_polygons.h"

#include "repair/position_hash.h"

#include <algorithm>
#include <limits>
#include <map>
#include <span>
#include <unordered_map>

namespace transillum {

namespace {

using Positions = std::array<glm::dvec3, 3>;

Positions positions_of(const TriangleSoup& soup, const SoupTriangle& t) {
    return {soup.positions[t.vertices[0]], soup.positions[t.vertices[1]],
            soup.positions[t.vertices[2]]};
}

/// The same but for the corner it begins with?
bool is_same(const Positions& a, Positions b) {
    for (int i = 0; i < 3; ++i) {
        if (a == b) return true;
        std::rotate(b.begin(), b.begin() + 1, b.end());
    }
    return false;
}

enum class Fate { kept, turned, taken_apart };

class Restoration {
public:
    Restoration(const Scene& scene, const TriangleSoup& made, const TriangleSoup& left)
        : scene_(scene), made_(made), left_(left), restored_(scene) {
        restored_.positions.clear();
        restored_.corners.clear();
        restored_.uvs.clear();
        restored_.polygons.clear();
    }

    Scene run() {
        std::size_t m = 0, l = 0;
        for (std::uint32_t p = 0; p < scene_.polygons.size(); ++p) {
            const auto mine = range_of(made_, p, m);
            const auto now = range_of(left_, p, l);
            add(p, mine, now, l - now.size());
        }
        return std::move(restored_);
    }

private:
    static std::span<const SoupTriangle> range_of(const TriangleSoup& soup, std::uint32_t polygon,
                                                  std::size_t& next) {
        const std::size_t first = next;
        while (next < soup.triangles.size() && soup.triangles[next].polygon == polygon) ++next;
        return {soup.triangles.data() + first, next - first};
    }

    [[nodiscard]] Fate fate_of(std::span<const SoupTriangle> before,
                               std::span<const SoupTriangle> after) const {
        if (before.size() != after.size()) return Fate::taken_apart;
        const bool both = !after.empty() && after.front().both_sides;
        std::size_t same = 0, turned = 0;
        for (std::size_t i = 0; i < before.size(); ++i) {
            if (after[i].both_sides != both) return Fate::taken_apart;
            const Positions was = positions_of(made_, before[i]);
            Positions is = positions_of(left_, after[i]);
            if (is_same(was, is)) ++same;
            std::swap(is[1], is[2]);
            if (is_same(was, is)) ++turned;
        }
        if (same == before.size()) return Fate::kept;
        // Other polygons may be triangulated otherwise from their other side.
        return turned == 1 && before.size() == 1 ? Fate::turned : Fate::taken_apart;
    }

    void add(std::uint32_t number, std::span<const SoupTriangle> before,
             std::span<const SoupTriangle> after, std::size_t first) {
        if (after.empty()) return;
        const Polygon& polygon = scene_.polygons[number];
        const Fate fate = fate_of(before, after);
        if (fate == Fate::taken_apart) {
            for (std::size_t i = 0; i < after.size(); ++i) add_triangle(polygon, first + i);
            return;
        }
        const std::size_t begin = restored_.corners.size();
        for (std::uint32_t c = 0; c < polygon.corner_count; ++c) {
            const std::uint32_t corner =
                polygon.first_corner +
                (fate == Fate::kept ? c : (polygon.corner_count - c) % polygon.corner_count);
            add_corner(scene_.positions[scene_.corners[corner]]);
            if (!scene_.uvs.empty()) restored_.uvs.push_back(scene_.uvs[corner]);
        }
        close(polygon, begin, after.front().both_sides);
    }

    void add_triangle(const Polygon& polygon, std::size_t t) {
        const std::size_t begin = restored_.corners.size();
        for (int i = 0; i < 3; ++i) {
            add_corner(left_.positions[left_.triangles[t].vertices[i]]);
            if (!left_.uvs.empty()) restored_.uvs.push_back(left_.uvs[t][i]);
        }
        close(polygon, begin, left_.triangles[t].both_sides);
    }

    void add_corner(const glm::dvec3& position) {
        const auto [at, is_new] =
            number_of_.try_emplace(position + 0.0,  // -0 is at the place of 0
                                   static_cast<std::uint32_t>(restored_.positions.size()));
        if (is_new) restored_.positions.push_back(position);
        restored_.corners.push_back(at->second);
    }

    void close(const Polygon& polygon, std::size_t begin, bool both_sides) {
        restored_.polygons.push_back(polygon);
        Polygon& p = restored_.polygons.back();
        p.first_corner = static_cast<std::uint32_t>(begin);
        p.corner_count = static_cast<std::uint32_t>(restored_.corners.size() - begin);
        if (both_sides) p.material = with_two_sides(p.material);
    }

    std::uint32_t with_two_sides(std::uint32_t number) {
        const auto known = two_sided_.find(number);
        if (known != two_sided_.end()) return known->second;
        Material m = scene_.materials[number];
        std::uint32_t variant = number;
        if (!m.back_reflects || (m.emits() && !m.back_emits)) {
            m.back_reflects = true;
            m.back_emits = m.emits();
            variant = static_cast<std::uint32_t>(restored_.materials.size());
            restored_.materials.push_back(std::move(m));
        }
        two_sided_.emplace(number, variant);
        return variant;
    }

    const Scene& scene_;
    const TriangleSoup& made_;
    const TriangleSoup& left_;
    Scene restored_;
    std::unordered_map<glm::dvec3, std::uint32_t, PositionHash> number_of_;
    std::map<std::uint32_t, std::uint32_t> two_sided_;
};

}  // namespace

Scene restore_polygons(const Scene& scene, const TriangleSoup& made, const TriangleSoup& left) {
    return Restoration(scene, made, left).run();
}

}  // namespace transillum
