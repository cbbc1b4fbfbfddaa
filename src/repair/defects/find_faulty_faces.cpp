#include "repair/defects/edge_table.h"
#include "repair/defects/find_defects.h"

#include <algorithm>
#include <array>
#include <span>
#include <tuple>

namespace transillum {

namespace {

/// A triangle by its vertices in ascending order.
struct FaceKey {
    std::array<std::uint32_t, 3> sorted{};
    bool turned = false;  ///< against that order
    bool is_dark = false, has_dark_back = false, has_black_back = false;
    std::uint32_t triangle = 0;
};
using Faces = std::span<const FaceKey>;

FaceKey key_of(const TriangleSoup& soup, const Scene& scene, std::uint32_t triangle) {
    const SoupTriangle& t = soup.triangles[triangle];
    const Material& material = scene.materials[scene.polygons[t.polygon].material];
    FaceKey key;
    key.sorted = t.vertices;
    std::rotate(key.sorted.begin(), std::ranges::min_element(key.sorted), key.sorted.end());
    key.turned = key.sorted[1] > key.sorted[2];
    if (key.turned) std::swap(key.sorted[1], key.sorted[2]);
    key.is_dark = !material.emits();
    key.has_dark_back = key.is_dark || !(material.back_emits || t.both_sides);
    key.has_black_back = !(material.back_reflects || t.both_sides);
    key.triangle = triangle;
    return key;
}

/// Faces with three vertices on the same ones one after another, the one to keep of each winding
/// first.
std::vector<FaceKey> sorted_faces(const TriangleSoup& soup, const Scene& scene) {
    std::vector<FaceKey> keys;
    keys.reserve(soup.triangles.size());
    for (std::uint32_t t = 0; t < soup.triangles.size(); ++t)
        if (!repeats_vertex(soup.triangles[t])) keys.push_back(key_of(soup, scene, t));
    std::ranges::sort(keys, {}, [](const FaceKey& k) {
        return std::tie(k.sorted, k.turned, k.is_dark, k.has_dark_back, k.has_black_back,
                        k.triangle);
    });
    return keys;
}

/// Calls `visit` with the faces on the same vertices: those of one winding, those of the other.
template <class Visit>
void for_each_place(Faces keys, const Visit& visit) {
    while (!keys.empty()) {
        const auto begin = keys.begin();
        const auto end =
            std::ranges::find_if(keys, [&](const FaceKey& k) { return k.sorted != begin->sorted; });
        const auto turned = std::find_if(begin, end, [](const FaceKey& k) { return k.turned; });
        visit(Faces(begin, turned), Faces(turned, end));
        keys = Faces(end, keys.end());
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
    const auto set_duplicates = [&](Faces faces, bool back_is_free) {
        if (faces.empty()) return;
        const FaceKey& first = faces.front();
        back_is_free = back_is_free && first.has_black_back;
        for (const FaceKey& k : faces.subspan(1)) {
            const bool is_back = back_is_free && k.is_dark && !k.has_black_back;
            set(k.triangle, is_back ? FaceFault::back : FaceFault::duplicate, first.triangle);
            back_is_free = back_is_free && !is_back;
        }
    };
    const std::vector<FaceKey> keys = sorted_faces(soup, scene);
    for_each_place(keys, [&](Faces straight, Faces turned) {
        set_duplicates(straight, turned.empty());
        set_duplicates(turned, straight.empty());
        if (straight.empty() || turned.empty()) return;
        const auto [first, later] = std::minmax(straight.front().triangle, turned.front().triangle);
        if (material(first) == material(later)) set(later, FaceFault::opposite, first);
    });
    // Duplicates of a face that an opposite one stands for.
    for (FaultyFace& face : faults)
        if (face.fault == FaceFault::duplicate && faults[face.first].fault == FaceFault::opposite)
            face.first = faults[face.first].first;
    return faults;
}

std::vector<std::array<std::uint32_t, 2>> find_two_material_walls(const TriangleSoup& soup,
                                                                  const Scene& scene) {
    std::vector<std::array<std::uint32_t, 2>> walls;
    const std::vector<FaceKey> keys = sorted_faces(soup, scene);
    for_each_place(keys, [&](Faces straight, Faces turned) {
        if (straight.empty() || turned.empty()) return;
        const auto [first, later] = std::minmax(straight.front().triangle, turned.front().triangle);
        if (scene.polygons[soup.triangles[first].polygon].material !=
                scene.polygons[soup.triangles[later].polygon].material &&
            has_area(soup, first))
            walls.push_back({first, later});
    });
    std::ranges::sort(walls);
    return walls;
}

}  // namespace transillum
