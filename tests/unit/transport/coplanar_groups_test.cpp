#include "transport/coplanar_groups.h"
#include "support/scene_builder.h"

#include <gtest/gtest.h>
#include <glm/geometric.hpp>

#include <set>

namespace {

using namespace transillum;
using namespace transillum::testing_support;

TEST(CoplanarGroups, AreTheFacesOfABox) {
    SceneBuilder b;
    b.box({0, 0, 0}, {1, 2, 3}, Facing::outwards);
    const SurfaceMesh mesh = b.surface();
    const auto group = coplanar_groups(mesh);
    EXPECT_EQ(std::set(group.begin(), group.end()).size(), 6u);
    for (std::uint32_t r = 0; r < group.size(); ++r)
        for (std::uint32_t s = 0; s < group.size(); ++s)
            EXPECT_EQ(group[r] == group[s], glm::dot(normal_of(mesh, r), normal_of(mesh, s)) > 0.5);
}

TEST(CoplanarGroups, KeepApartWhatOnlyTouchesOrTurnsAway) {
    SceneBuilder b;
    b.polygon({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}});
    b.polygon({{1, 1, 0}, {2, 1, 0}, {2, 2, 0}, {1, 2, 0}});  // meets it in a corner
    b.polygon({{1, 1, 0}, {2, 1, 0}, {2, 0, 0}, {1, 0, 0}});  // faces down
    b.polygon({{0, 1, 0}, {1, 1, 0}, {1, 2, 0}, {0, 2, 0}});  // beside it
    const SurfaceMesh mesh = b.surface();
    const auto group = coplanar_groups(mesh);
    ASSERT_EQ(group.size(), 8u);
    const auto of_polygon = [&](int polygon) {
        for (std::uint32_t r = 0; r < group.size(); ++r)
            if (mesh.triangles[r].source_face == static_cast<std::uint32_t>(polygon))
                return group[r];
        return 0xffffffffu;
    };
    EXPECT_NE(of_polygon(0), of_polygon(2));
    EXPECT_NE(of_polygon(1), of_polygon(2));
    EXPECT_EQ(of_polygon(0), of_polygon(3));
    // By way of polygon 3, which has an edge in common with both.
    EXPECT_EQ(of_polygon(0), of_polygon(1));
}

}  // namespace
