#include <transillum/base/sampling.h>
#include <transillum/visibility/ray_tracer.h>

#include <gtest/gtest.h>
#include <glm/geometric.hpp>

namespace transillum {
namespace {

void add_triangle(SurfaceMesh& mesh, const glm::dvec3& a, const glm::dvec3& b,
                  const glm::dvec3& c) {
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    mesh.positions.insert(mesh.positions.end(), {a, b, c});
    mesh.triangles.push_back({{first, first + 1, first + 2}, {}, 0, 0, 0});
}

void add_quad(SurfaceMesh& mesh, const std::array<glm::dvec3, 4>& p) {
    add_triangle(mesh, p[0], p[1], p[2]);
    add_triangle(mesh, p[0], p[2], p[3]);
}

SurfaceMesh unit_cube() {
    SurfaceMesh mesh;
    for (int axis = 0; axis < 3; ++axis)
        for (int side = 0; side < 2; ++side) {
            std::array<glm::dvec3, 4> p;
            for (int i = 0; i < 4; ++i) {
                p[i][axis] = side;
                p[i][(axis + 1) % 3] = i == 1 || i == 2;
                p[i][(axis + 2) % 3] = i >= 2;
            }
            add_quad(mesh, p);
        }
    return mesh;
}

glm::dvec3 random_point(Random& random) {
    const double x = random.next(), y = random.next();
    return {x, y, random.next()};
}

TEST(RayTracer, NamesTriangleSideAndBarycentrics) {
    SurfaceMesh mesh;
    add_triangle(mesh, {5, 5, 5}, {6, 5, 5}, {5, 6, 5});
    add_triangle(mesh, {0, 0, 0}, {4, 0, 0}, {0, 4, 0});
    const RayTracer rays(mesh);
    const Hit front = rays.intersect({{1, 2, 3}, {0, 0, -1}});
    ASSERT_TRUE(front);
    EXPECT_EQ(front.root, 1u);
    EXPECT_FALSE(front.back);
    EXPECT_FLOAT_EQ(front.b1, 0.25f);
    EXPECT_FLOAT_EQ(front.b2, 0.5f);
    EXPECT_FLOAT_EQ(front.distance, 3.0f);
    EXPECT_TRUE(rays.intersect({{1, 2, -3}, {0, 0, 1}}).back);
    EXPECT_FALSE(rays.intersect({{3, 3, 3}, {0, 0, -1}}));
    EXPECT_FALSE(rays.intersect({{1, 2, 3}, {0, 0, -1}, 0.0f, 2.0f}));
}

TEST(RayTracer, NothingIsHitWithoutTriangles) {
    const RayTracer rays(SurfaceMesh{});
    EXPECT_FALSE(rays.intersect({{0, 0, 0}, {0, 0, 1}}));
    EXPECT_FALSE(rays.occluded({0, 0, 0}, {0, 0, 1}, {0, 0, 1}, {0, 0, -1}));
}

TEST(RayTracer, NoRayLeavesAClosedCube) {
    const RayTracer rays(unit_cube());
    Random random(1, 0);
    for (int i = 0; i < 20000; ++i) {
        const glm::dvec3 origin = 0.1 + 0.8 * random_point(random);
        glm::dvec3 target = random_point(random);
        // Two of three aim at an edge or a corner.
        for (int axis = 0; axis <= i % 3; ++axis) target[axis] = random.next() < 0.5 ? 0.0 : 1.0;
        ASSERT_TRUE(rays.intersect({origin, glm::normalize(target - origin)})) << i;
    }
}

struct LampRoom {
    double size, gap;
    glm::dvec3 origin;
};

class LampUnderCeiling : public ::testing::TestWithParam<LampRoom> {};

TEST_P(LampUnderCeiling, LightsTheRoomAndNothingAbove) {
    const auto [size, gap, origin] = GetParam();
    const auto at = [&](double x, double y, double z) { return origin + glm::dvec3(x, y, z); };
    const double s = size, z = size - gap;
    SurfaceMesh mesh;
    add_quad(mesh, {at(0, 0, 0), at(s, 0, 0), at(s, s, 0), at(0, s, 0)});
    add_quad(mesh, {at(0, 0, s), at(0, s, s), at(s, s, s), at(s, 0, s)});
    add_quad(mesh, {at(.4 * s, .4 * s, z), at(.4 * s, .6 * s, z), at(.6 * s, .6 * s, z),
                    at(.6 * s, .4 * s, z)});
    const RayTracer rays(mesh);
    const glm::dvec3 up(0, 0, 1);
    Random random(2, 0);
    for (int i = 0; i < 20000; ++i) {
        const glm::dvec3 u = random_point(random), v = random_point(random);
        const glm::dvec3 lamp = at((.4 + .2 * u.x) * s, (.4 + .2 * u.y) * s, z);
        ASSERT_FALSE(rays.occluded(at(v.x * s, v.y * s, 0), up, lamp, -up)) << i;
        ASSERT_TRUE(rays.occluded(at(v.x * s, v.y * s, 1.5 * s), up, lamp, -up))
            << "through the ceiling";
        ASSERT_TRUE(rays.occluded(at(v.x * s, v.y * s, -s), up, lamp, -up)) << "through the floor";
        const glm::dvec3 on_ceiling = at((.4 + .2 * v.x) * s, (.4 + .2 * v.y) * s, s);
        ASSERT_FALSE(rays.occluded(on_ceiling, -up, lamp, up)) << "in the gap";
    }
}

INSTANTIATE_TEST_SUITE_P(Sizes, LampUnderCeiling,
                         ::testing::Values(LampRoom{550.0, 0.5, {0, 0, 0}},
                                           LampRoom{6.0, 0.0008, {0, 0, 0}},
                                           LampRoom{550.0, 0.5, {3e8, -2e8, 1e8}},
                                           LampRoom{6e-3, 8e-7, {1, 1, 1}}));

TEST(RayTracer, SurfacesDoNotShadowThemselves) {
    Random random(3, 0);
    for (int i = 0; i < 3000; ++i) {
        SurfaceMesh mesh;
        const glm::dvec3 a = random_point(random), b = random_point(random),
                         c = random_point(random);
        add_triangle(mesh, a, b, c);
        // Extends the scene, as other objects would.
        add_triangle(mesh, {9, 9, 9}, {10, 9, 9}, {9, 10, 9});
        const glm::dvec3 normal = glm::normalize(glm::cross(b - a, c - a));
        const RayTracer rays(mesh);
        for (int k = 0; k < 20; ++k) {
            const double s = std::sqrt(random.next()), t = random.next();
            const glm::dvec3 from = (1 - s) * a + s * (1 - t) * b + s * t * c;
            const glm::dvec3 to = from + (random_point(random) - 0.5);
            ASSERT_FALSE(rays.occluded(from, normal, to, glm::dvec3(0.0))) << i;
            ASSERT_FALSE(rays.occluded(to, glm::dvec3(0.0), from, normal)) << i;
        }
    }
}

TEST(RayTracer, ClearanceFollowsTheScenesSize) {
    SurfaceMesh cube = unit_cube();
    const RayTracer small(cube);
    for (glm::dvec3& p : cube.positions) p *= 1024.0;
    const RayTracer large(cube);
    const glm::dvec3 point(0.25, 0.5, 1.0);
    EXPECT_GT(small.clearance(point), 0.0);
    EXPECT_DOUBLE_EQ(large.clearance(1024.0 * point), 1024.0 * small.clearance(point));
    EXPECT_GT(small.clearance({100, 0, 0}), 10.0 * small.clearance(point));
}

}  // namespace
}  // namespace transillum
