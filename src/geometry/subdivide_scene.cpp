#include <transillum/base/error.h>
#include <transillum/geometry/patch_hierarchy.h>
#include <transillum/geometry/subdivide_scene.h>
#include <transillum/repair/triangle_soup.h>

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>
#include <unordered_map>

namespace transillum {

namespace {

struct Corner {
    std::uint32_t vertex = 0;
    glm::dvec2 uv{0.0};
};

/// Edge i runs from corner i to the next.
using Triangle = std::array<Corner, 3>;

std::string shown(double value) {
    std::ostringstream text;
    text << value;
    return text.str();
}

void check(const SceneSubdivision& o) {
    if ((o.max_edge != 0.0) == (o.level != -1))
        throw UsageError("subdivision by both or neither of edge and level; accepted: one of them");
    if (o.level == -1 && !(o.max_edge > 0.0 && std::isfinite(o.max_edge)))
        throw UsageError("longest edge " + shown(o.max_edge) + "; accepted: above 0, finite");
    if (o.max_edge == 0.0 && (o.level < 0 || o.level > max_subdivision_level))
        throw UsageError("subdivision level " + std::to_string(o.level) + "; accepted: 0 to " +
                         std::to_string(max_subdivision_level));
}

class SceneSubdivider {
public:
    SceneSubdivider(const Scene& scene, const SceneSubdivision& options)
        : scene_(scene), options_(options) {
        result_.path = scene.path;
        result_.materials = scene.materials;
        result_.textures = scene.textures;
        result_.objects = scene.objects;
        result_.cameras = scene.cameras;
        result_.lighting = scene.lighting;
    }

    Scene subdivide(const TriangleSoup& soup) {
        check_level(soup);
        result_.positions = soup.positions;
        for (std::uint32_t t = 0; t < soup.triangles.size(); ++t) {
            polygon_ = &scene_.polygons[soup.triangles[t].polygon];
            Triangle triangle;
            for (std::size_t i = 0; i < 3; ++i) {
                triangle[i].vertex = soup.triangles[t].vertices[i];
                if (!soup.uvs.empty()) triangle[i].uv = glm::dvec2(soup.uvs[t][i]);
            }
            subdivide(triangle, 0);
        }
        return std::move(result_);
    }
    [[nodiscard]] int deepest() const { return deepest_; }

private:
    void check_level(const TriangleSoup& soup) const;
    [[nodiscard]] bool is_halved(const Corner& a, const Corner& b, int depth) const;
    void subdivide(const Triangle& t, int depth);
    void cut_one(const Triangle& t, int depth);
    void cut_two(const Triangle& t, int depth);
    Corner midpoint(const Corner& a, const Corner& b);
    void emit(const Triangle& t);

    [[nodiscard]] glm::dvec3 position(const Corner& c) const { return result_.positions[c.vertex]; }
    /// The same from either end.
    [[nodiscard]] double length(const Corner& a, const Corner& b) const {
        return glm::length(position(a) - position(b));
    }

    const Scene& scene_;
    SceneSubdivision options_;
    Scene result_;
    const Polygon* polygon_ = nullptr;
    std::unordered_map<std::uint64_t, std::uint32_t> midpoints_;  ///< by both ends
    int deepest_ = 0;
};

/// One level is kept for the triangles that close the gap to finer neighbours.
void SceneSubdivider::check_level(const TriangleSoup& soup) const {
    const auto too_many = [](const std::string& count, const char* mend) {
        throw UsageError("subdivision into " + count + " triangles; accepted: at most " +
                         std::to_string(most_subdivided_triangles) + "; " + mend);
    };
    if (options_.level >= 0) {
        const std::uint64_t count = std::uint64_t{soup.triangles.size()} << (2 * options_.level);
        if (count > most_subdivided_triangles) too_many(std::to_string(count), "lower the level");
        return;
    }
    double longest = 0.0, half_area = 0.0;
    for (std::uint32_t t = 0; t < soup.triangles.size(); ++t) {
        const auto& v = soup.triangles[t].vertices;
        for (std::size_t i = 0; i < 3; ++i)
            longest = std::max(longest,
                               glm::length(soup.positions[v[i]] - soup.positions[v[(i + 1) % 3]]));
        half_area += glm::length(area_vector(soup, t));
    }
    const double least = std::ldexp(longest, 1 - max_subdivision_level);
    if (options_.max_edge < least)
        throw UsageError("longest edge " + shown(options_.max_edge) + "; accepted: at least " +
                         shown(least) + ", a " + std::to_string(1 << (max_subdivision_level - 1)) +
                         "th of the longest there is (midpoints are exact down to level " +
                         std::to_string(max_subdivision_level) + ")");
    // No triangle of that edge is larger than the equilateral one.
    const double fewest = half_area / (std::sqrt(0.75) * options_.max_edge * options_.max_edge);
    if (fewest > static_cast<double>(most_subdivided_triangles))
        too_many("more than " + shown(fewest), "raise the longest edge");
}

bool SceneSubdivider::is_halved(const Corner& a, const Corner& b, int depth) const {
    return options_.level >= 0 ? depth < options_.level : length(a, b) > options_.max_edge;
}

Corner SceneSubdivider::midpoint(const Corner& a, const Corner& b) {
    const auto [low, high] = std::minmax(a.vertex, b.vertex);
    const auto [found, is_new] = midpoints_.try_emplace(
        std::uint64_t{low} << 32 | high, static_cast<std::uint32_t>(result_.positions.size()));
    if (is_new) {
        const glm::dvec3 middle = 0.5 * (position(a) + position(b));
        result_.positions.push_back(middle);
    }
    return {found->second, 0.5 * (a.uv + b.uv)};
}

void SceneSubdivider::emit(const Triangle& t) {
    if (result_.polygons.size() == most_subdivided_triangles)
        throw UsageError("subdivision into more than " + std::to_string(most_subdivided_triangles) +
                         " triangles; accepted: at most these; raise the longest edge");
    Polygon polygon = *polygon_;
    polygon.first_corner = static_cast<std::uint32_t>(result_.corners.size());
    polygon.corner_count = 3;
    result_.polygons.push_back(polygon);
    for (const Corner& c : t) {
        result_.corners.push_back(c.vertex);
        if (!scene_.uvs.empty()) result_.uvs.emplace_back(c.uv);
    }
}

/// Edge 0 is halved.
void SceneSubdivider::cut_one(const Triangle& t, int depth) {
    const Corner m = midpoint(t[0], t[1]);
    subdivide({t[0], m, t[2]}, depth);
    subdivide({m, t[1], t[2]}, depth);
}

/// Edges 0 and 1 are halved: the corner between them, and a quadrilateral.
void SceneSubdivider::cut_two(const Triangle& t, int depth) {
    const Corner m = midpoint(t[0], t[1]), n = midpoint(t[1], t[2]);
    subdivide({m, t[1], n}, depth);
    if (length(t[0], n) <= length(m, t[2])) {
        subdivide({t[0], m, n}, depth);
        subdivide({t[0], n, t[2]}, depth);
    } else {
        subdivide({t[0], m, t[2]}, depth);
        subdivide({m, n, t[2]}, depth);
    }
}

void SceneSubdivider::subdivide(const Triangle& t, int depth) {
    deepest_ = std::max(deepest_, depth);
    std::array<bool, 3> halved{};
    for (std::size_t i = 0; i < 3; ++i) halved[i] = is_halved(t[i], t[(i + 1) % 3], depth);
    const auto count = std::ranges::count(halved, true);
    if (count == 0) return emit(t);
    const auto turned = [&](std::size_t first) {
        return Triangle{t[first], t[(first + 1) % 3], t[(first + 2) % 3]};
    };
    const auto at = [&](bool value) {
        return static_cast<std::size_t>(std::ranges::find(halved, value) - halved.begin());
    };
    if (count == 1) return cut_one(turned(at(true)), depth + 1);
    if (count == 2) return cut_two(turned((at(false) + 1) % 3), depth + 1);
    const std::array<Corner, 3> m{midpoint(t[0], t[1]), midpoint(t[1], t[2]), midpoint(t[2], t[0])};
    for (std::size_t i = 0; i < 3; ++i) subdivide({t[i], m[i], m[(i + 2) % 3]}, depth + 1);
    subdivide(m, depth + 1);
}

std::uint64_t drop_without_area(TriangleSoup& soup) {
    std::uint32_t kept = 0;
    for (std::uint32_t t = 0; t < soup.triangles.size(); ++t) {
        if (!has_area(soup, t)) continue;
        soup.triangles[kept] = soup.triangles[t];
        if (!soup.uvs.empty()) soup.uvs[kept] = soup.uvs[t];
        ++kept;
    }
    const std::uint64_t dropped = soup.triangles.size() - kept;
    soup.triangles.resize(kept);
    if (!soup.uvs.empty()) soup.uvs.resize(kept);
    return dropped;
}

void tell(const SubdivisionReport& r, const SoupCounts& counts, const Scene& scene,
          Monitor& monitor) {
    monitor.note(scene.path + ": vertices are on a grid of " +
                 shown(std::ldexp(1.0, r.grid.exponent)) + ", moved by up to " +
                 shown(r.grid.largest_move));
    if (counts.without_area > 0)
        monitor.note(scene.path + ": left out " + std::to_string(counts.without_area) +
                     " polygons and triangles without area");
    monitor.note(scene.path + ": " + std::to_string(r.triangles_before) + " triangles became " +
                 std::to_string(r.triangles));
}

}  // namespace

Scene subdivide_scene(const Scene& scene, const SceneSubdivision& options, Monitor& monitor,
                      SubdivisionReport* report) {
    check(options);
    SubdivisionReport told;
    Scene snapped = scene;
    told.grid = snap_scene(snapped, Rounding::dyadic);
    SoupCounts counts;
    TriangleSoup soup = make_soup(snapped, &counts);
    counts.without_area += drop_without_area(soup);
    if (soup.triangles.empty())
        throw InputError(scene.path, "no triangle with an area; accepted: at least one");
    told.triangles_before = soup.triangles.size();
    SceneSubdivider subdivider(scene, options);
    Scene result = subdivider.subdivide(soup);
    told.triangles = result.polygons.size();
    told.deepest = subdivider.deepest();
    tell(told, counts, scene, monitor);
    if (report) *report = told;
    return result;
}

}  // namespace transillum
