// Light in scenes that are only closed, or only conforming, once they are repaired.
#include "support/scene_builder.h"

#include <transillum/solution/bake.h>

#include <gtest/gtest.h>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace {

using namespace transillum;
using namespace transillum::testing_support;

/// A room, moved into its place by a rotation, and what is known of light in it.
struct Room {
    SceneBuilder builder;
    glm::dvec3 low{0.0}, high{1.0};  ///< its inner sides, before it was turned
    glm::dmat3 turn{1.0};

    /// Turned such that no coordinate is dyadic any more.
    void put_askew() {
        turn = glm::dmat3(glm::rotate(glm::dmat4(1.0), 0.7, glm::normalize(glm::dvec3(1, 2, 3))));
        for (glm::dvec3& p : builder.scene.positions) p = turn * p;
    }

    /// Does this side of a leaf look into the room? Where the leaf is longer than the room, no.
    [[nodiscard]] bool holds(const Solution& s, std::uint32_t patch) const {
        const std::uint32_t leaf = s.patches.leaf_of_patch(patch);
        const std::uint32_t root = s.patches.root_of_leaf[leaf];
        const glm::dvec3 n = normal_of(s.surface, root) * (s.patches.is_back(patch) ? -1.0 : 1.0);
        // Further than any vertex moves, and much less than the width of any slit.
        constexpr double above = 2e-6;
        const glm::dvec3 p = (leaf_centre(s.surface, s.patches, leaf) + above * n) * turn;
        return glm::all(glm::greaterThan(p, low)) && glm::all(glm::lessThan(p, high));
    }
};

Solution bake_room(const Scene& scene, RepairLevel level, std::uint64_t directions) {
    BakeOptions options;
    options.repair.level = level;
    options.subdivision.leaf_target = 2000;
    options.light.first_shot = FirstShot::off;
    options.resolution = 300;
    options.iteration.iterations = directions;
    options.iteration.monte_carlo = MonteCarlo::off;
    Monitor silent;
    return bake(scene, options, Workers(2), silent);
}

double radiance(const Solution& s, std::uint32_t patch) {
    return s.emission(patch).x +
           s.diffuse(patch).x * s.indirect_irradiance[patch].x / std::numbers::pi;
}

struct Deviation {
    double largest = 0.0;
    std::uint32_t patches = 0, off = 0;
};

/// From a radiance of 1, of what looks into the room and was met by light.
Deviation deviation_from_one(const Room& room, const Solution& s) {
    Deviation d;
    for (std::uint32_t p = 0; p < s.patches.patch_count(); ++p) {
        if (!room.holds(s, p) || s.coverage[p] == 0.0f) continue;
        const double off = std::abs(radiance(s, p) - 1.0);
        d.largest = std::max(d.largest, off);
        ++d.patches;
        if (off > 1e-4) ++d.off;
    }
    return d;
}

/// Emits on both sides what it absorbs, so that all radiance is 1 in whatever is closed.
std::uint32_t glowing(SceneBuilder& b, float albedo) {
    const std::uint32_t m = b.material(Spectrum(albedo), Spectrum(1.0f - albedo));
    b.scene.materials[m].back_emits = true;
    return m;
}

/// A side of the unit cube in n x m rectangles, whose inner corners are off the edges they lie on.
void subdivided_side(SceneBuilder& b, int side, int n, int m, double off, std::uint32_t material) {
    const int axis = side / 2, u = (axis + 1) % 3, v = (axis + 2) % 3;
    const auto at = [&](int i, int j) {
        glm::dvec3 p(0.0);
        p[axis] = side % 2;
        p[u] = static_cast<double>(i) / n;
        p[v] = static_cast<double>(j) / m;
        const bool on_u_edge = (j == 0 || j == m) && i > 0 && i < n;
        const bool on_v_edge = (i == 0 || i == n) && j > 0 && j < m;
        if (on_u_edge) p[v] += off * (j == 0 ? 1.0 : -1.0);
        if (on_v_edge) p[u] += off * (i == 0 ? 1.0 : -1.0);
        return p;
    };
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < m; ++j) {
            Outline o{at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)};
            if (side % 2 == 1) std::reverse(o.begin(), o.end());
            b.polygon(o, material);
        }
}

Room t_junctioned_room(double off) {
    Room room;
    const int n[] = {1, 3, 7, 2, 5, 4}, m[] = {4, 1, 3, 5, 2, 7};
    for (int side = 0; side < 6; ++side)
        subdivided_side(room.builder, side, n[side], m[side], off,
                        glowing(room.builder, 0.15f * static_cast<float>(side + 1)));
    return room;
}

Room duplicated_room() {
    Room room;
    SceneBuilder& b = room.builder;
    const std::uint32_t grey = glowing(b, 0.8f);
    b.box({0, 0, 0}, {1, 1, 1}, Facing::inwards, grey);
    b.box({0, 0, 0}, {1, 1, 1}, Facing::inwards, grey);
    b.box({0, 0, 0}, {1, 1, 1}, Facing::outwards, grey);
    return room;
}

void turned_box(SceneBuilder& b, glm::dvec3 centre, glm::dvec3 half, double angle,
                std::uint32_t material) {
    const std::size_t first = b.scene.positions.size();
    b.box(-half, half, Facing::outwards, material);
    const glm::dmat3 turn(
        glm::rotate(glm::dmat4(1.0), angle, glm::normalize(glm::dvec3(3, 1, 2))));
    for (std::size_t i = first; i < b.scene.positions.size(); ++i)
        b.scene.positions[i] = centre + turn * b.scene.positions[i];
}

Room interpenetrating_room() {
    Room room;
    SceneBuilder& b = room.builder;
    b.box({0, 0, 0}, {1, 1, 1}, Facing::inwards, glowing(b, 0.6f));
    b.box({0.7, 0.3, 0.13}, {1.2, 0.55, 0.37}, Facing::outwards, glowing(b, 0.9f));
    b.box({-0.21, 0.41, 0.27}, {1.13, 0.61, 0.31}, Facing::outwards, glowing(b, 0.3f));
    b.box({0.83, 0.1, -0.3}, {0.97, 0.9, 0.81}, Facing::outwards, glowing(b, 0.5f));
    turned_box(b, {0.31, 0.29, 0.03}, {0.11, 0.23, 0.17}, 0.6, glowing(b, 0.7f));
    turned_box(b, {0.4, 0.5, 0.9}, {0.21, 0.13, 0.19}, 1.1, glowing(b, 0.2f));
    return room;
}

/// Walls in pieces that overlap each other in their planes, and end where others don't.
Room overlapping_room() {
    Room room;
    SceneBuilder& b = room.builder;
    b.box({0, 0, 0}, {1, 1, 1}, Facing::inwards, glowing(b, 0.4f), 0);
    const auto floor = [&](double x0, double y0, double x1, double y1, float albedo) {
        b.polygon({{x0, y0, 0}, {x1, y0, 0}, {x1, y1, 0}, {x0, y1, 0}}, glowing(b, albedo));
    };
    floor(-0.1, -0.2, 0.43, 1.1, 0.9f);
    floor(0.37, 0.0, 1.0, 0.71, 0.6f);
    floor(0.29, 0.63, 1.3, 1.0, 0.1f);
    floor(0.11, 0.17, 0.77, 0.89, 0.8f);
    b.polygon({{0.1, 0.2, 1}, {0.5, 0.9, 1}, {0.9, 0.3, 1}}, glowing(b, 0.7f));
    return room;
}

void tell(const char* what, const Room& room, std::uint64_t directions) {
    for (const RepairLevel level : {RepairLevel::off, RepairLevel::full}) {
        const Solution s = bake_room(room.builder.scene, level, directions);
        const Deviation d = deviation_from_one(room, s);
        std::printf("A1 %s %s: largest %.2e off %u of %u  tri %zu escaped %.2e\n", what,
                    level == RepairLevel::off ? "off " : "full", d.largest, d.off, d.patches,
                    s.surface.triangles.size(), s.balance.escaped.x);
        for (const Decision& x : s.decisions)
            if (x.what.find("repaired") != std::string::npos)
                std::printf("     %s\n", x.why.c_str());
    }
}

TEST(Explore, A1) {
    for (const bool askew : {false, true}) {
        const auto go = [&](const char* what, Room room) {
            if (askew) room.put_askew();
            tell(what, room, 256);
        };
        go("tjunction exact", t_junctioned_room(0.0));
        go("tjunction 1e-7", t_junctioned_room(1e-7));
        go("tjunction -1e-7", t_junctioned_room(-1e-7));
        go("duplicated", duplicated_room());
        go("interpenetrating", interpenetrating_room());
        go("overlapping", overlapping_room());
    }
}

enum class Joints { overlapping, butt, edges };

/// Six slabs around the unit cube.
Room slab_room(double t, Joints joints) {
    Room room;
    SceneBuilder& b = room.builder;
    const std::uint32_t grey = b.material(Spectrum(0.8f));
    for (int axis = 0; axis < 3; ++axis)
        for (int end = 0; end < 2; ++end) {
            glm::dvec3 low(0.0), high(1.0);
            for (int other = 0; other < 3; ++other) {
                const bool beyond =
                    joints == Joints::overlapping || (joints == Joints::butt && other > axis);
                if (beyond) low[other] = -t, high[other] = 1.0 + t;
            }
            low[axis] = end ? 1.0 : -t;
            high[axis] = end ? 1.0 + t : 0.0;
            b.box(low, high, Facing::outwards, grey);
        }
    return room;
}

void tell_leak(const char* what, Room room) {
    room.builder.scene.lighting.environment.kind = Environment::Kind::uniform;
    room.builder.scene.lighting.environment.radiance_scale = Spectrum(1.0f);
    for (const RepairLevel level : {RepairLevel::off, RepairLevel::full}) {
        const Solution s = bake_room(room.builder.scene, level, 256);
        double largest = 0.0;
        std::uint32_t lit = 0, all = 0;
        for (std::uint32_t p = 0; p < s.patches.patch_count(); ++p) {
            if (!room.holds(s, p)) continue;
            ++all;
            const double e = s.indirect_irradiance[p].x;
            largest = std::max(largest, e);
            if (e > 0.0) ++lit;
        }
        std::printf("A5 %s %s: largest %.2e lit %u of %u  tri %zu\n", what,
                    level == RepairLevel::off ? "off " : "full", largest, lit, all,
                    s.surface.triangles.size());
        for (const Decision& x : s.decisions)
            if (x.what.find("repaired") != std::string::npos)
                std::printf("     %s\n", x.why.c_str());
    }
}

TEST(Explore, A5) {
    for (const bool askew : {false, true}) {
        const auto go = [&](const std::string& what, Room room) {
            if (askew) room.put_askew();
            tell_leak((what + (askew ? " askew" : "")).c_str(), room);
        };
        for (const double t : {0.1, 1e-3, 1e-5}) {
            go("overlapping " + std::to_string(t), slab_room(t, Joints::overlapping));
            go("butt " + std::to_string(t), slab_room(t, Joints::butt));
            go("edges " + std::to_string(t), slab_room(t, Joints::edges));
        }
        for (const double off : {0.0, 1e-7, -1e-7}) {
            Room room = t_junctioned_room(off);
            for (Material& m : room.builder.scene.materials) m.emission = Spectrum(0.0f);
            go("tjunction " + std::to_string(off * 1e7), room);
        }
    }
}

}  // namespace
