#include "repair/defects/edge_table.h"
#include "repair/defects/find_defects.h"

#include <algorithm>
#include <array>
#include <tuple>

namespace transillum {

namespace {

/// A triangle by its vertices in ascending order.
struct FaceKey {
    std::array<std::uint32_t, 3> sorted{};
    bool turned = false;   ///< against that order
    bool is_dark = false;  ///< does not emit
    std::uint32_t triangle = 0;
};

FaceKey key_of(const TriangleSoup& soup, const Scene& scene, std::uint32_t triangle) {
    const SoupTriangle& t = soup.triangles[triangle];
    FaceKey key{t.vertices, false, true, triangle};
    std::rotate(key.sorted.begin(), std::ranges::min_element(key.sorted), key.sorted.end());
    key.turned = key.sorted[1] > key.sorted[2];
    if (key.turned) std::swap(key.sorted[1], key.sorted[2]);
    key.is_dark = !scene.materials[scene.polygons[t.polygon].material].emits();
    return key;
}

/// Faces with three vertices on the same ones one after another, the one to keep of each winding
/// first.
std::vector<FaceKey> sorted_faces(const TriangleSoup& soup, const Scene& scene) {
    std::vector<FaceKey> keys;
    keys.reserve(soup.triangles.size());
    for (std::uint32_t t = 0; t < soup.triangles.size(); ++t)
        if (!repeats_vertex(soup.triangles[t])) keys.push_back(key_of(soup, scene, t));
    std::sort(keys.begin(), keys.end(), [](const FaceKey& a, const FaceKey& b) {
        return std::tie(a.sorted, a.turned, a.is_dark, a.triangle) <
               std::tie(b.sorted, b.turned, b.is_dark, b.triangle);
    });
    return keys;
}

/// Calls `visit(key, first)` for the ones after the first of each winding, and
/// `both(first, first_turned)` where there are both windings.
template <class Visit, class Both>
void for_each_double(const std::vector<FaceKey>& keys, const Visit& visit, const Both& both) {
    for (std::size_t i = 0; i < keys.size();) {
        std::size_t end = i;
        std::size_t first = i;
        while (end < keys.size() && keys[end].sorted == keys[i].sorted) {
            if (keys[end].turned != keys[first].turned) {
                first = end;
                both(keys[i].triangle, keys[first].triangle);
            } else if (end != first) {
                visit(keys[end].triangle, keys[first].triangle);
            }
            ++end;
        }
        i = end;
    }
}

}  // namespace

std::vector<FaultyFace> find_faulty_faces(const TriangleSoup& soup, const Scene& scene) {
    std::vector<FaultyFace> faults(soup.triangles.size());
    for (std::uint32_t t = 0; t < soup.triangles.size(); ++t) {
        if (repeats_vertex(soup.triangles[t]))
            faults[t].fault = FaceFault::repeated_index;
        else if (!has_area(soup, t))
            faults[t].fault = FaceFault::zero_area;
    }
    const auto material = [&](std::uint32_t t) {
        return scene.polygons[soup.triangles[t].polygon].material;
    };
    const auto set = [&](std::uint32_t t, FaceFault fault, std::uint32_t first) {
        if (faults[t].fault == FaceFault::none) faults[t] = {fault, first};
    };
    std::vector<std::array<std::uint32_t, 2>> opposites;
    for_each_double(
        sorted_faces(soup, scene),
        [&](std::uint32_t t, std::uint32_t first) { set(t, FaceFault::duplicate, first); },
        [&](std::uint32_t a, std::uint32_t b) {
            if (material(a) == material(b)) opposites.push_back({std::min(a, b), std::max(a, b)});
        });
    for (const auto& [first, later] : opposites) set(later, FaceFault::opposite, first);
    // Duplicates of a face that an opposite one stands for.
    for (FaultyFace& face : faults)
        if (face.fault == FaceFault::duplicate && faults[face.first].fault == FaceFault::opposite)
            face.first = faults[face.first].first;
    return faults;
}

std::vector<std::array<std::uint32_t, 2>> find_two_material_walls(const TriangleSoup& soup,
                                                                  const Scene& scene) {
    std::vector<std::array<std::uint32_t, 2>> walls;
    for_each_double(
        sorted_faces(soup, scene), [](std::uint32_t, std::uint32_t) {},
        [&](std::uint32_t a, std::uint32_t b) {
            if (scene.polygons[soup.triangles[a].polygon].material !=
                    scene.polygons[soup.triangles[b].polygon].material &&
                has_area(soup, a))
                walls.push_back({std::min(a, b), std::max(a, b)});
        });
    std::ranges::sort(walls);
    return walls;
}

}  // namespace transillum
