// Shapes that are hard to project, to sort, to repair or to meet.
#include "physics/stability/rooms.h"

#include <transillum/base/sampling.h>
#include <transillum/visibility/transillumination_buffer.h>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include <numbers>

namespace transillum::stability {

using namespace testing_support;

namespace {

constexpr float albedo = 0.8f;

glm::dvec3 random_point(Random& random, double margin) {
    const auto coordinate = [&] { return margin + (1.0 - 2.0 * margin) * random.next(); };
    const double x = coordinate(), y = coordinate();
    return {x, y, coordinate()};
}

glm::dmat3 random_frame(Random& random) {
    const double u = random.next();
    return frame_about(uniform_direction(u, random.next()));
}

/// A strip of needles beside each other, 0.6 long, and as many on their own in all directions.
void needles(SceneBuilder& b, const RoomMaterials& m, std::uint64_t seed) {
    constexpr int count = 50;
    constexpr double length = 0.6, width = length * 1e-6;
    for (int i = 0; i < count; ++i) {
        const double x0 = 0.3 + i * width, x1 = 0.3 + (i + 1) * width;
        b.polygon({{x0, 0.2, 0.5}, {x1, 0.2, 0.5}, {x1, 0.2 + length, 0.5}}, m.sheet);
        b.polygon({{x0, 0.2, 0.5}, {x1, 0.2 + length, 0.5}, {x0, 0.2 + length, 0.5}}, m.sheet);
    }
    Random random(seed, 1);
    for (int i = 0; i < count; ++i) {
        const glm::dvec3 at = random_point(random, 0.35);
        const glm::dmat3 f = random_frame(random);
        b.polygon({at - 0.5 * length * f[2], at + 0.5 * length * f[2], at + width * f[0]}, m.sheet);
    }
}

void slivers(SceneBuilder& b, const RoomMaterials& m, std::uint64_t seed) {
    Random random(seed, 2);
    for (int i = 0; i < 100; ++i) {
        const glm::dvec3 at = random_point(random, 0.2);
        const glm::dmat3 f = random_frame(random);
        b.polygon({at - 0.15 * f[2], at + 0.15 * f[2], at + 1e-3 * f[0]}, m.sheet);
    }
}

/// Squares that contain the first directions of the iteration: seen edge-on, nothing is to be seen.
void edge_on_squares(SceneBuilder& b, const RoomMaterials& m, std::uint64_t seed) {
    Random random(seed, 3);
    for (std::uint32_t i = 0; i < 64; ++i) {
        const glm::dvec3 at = random_point(random, 0.25);
        const glm::dmat3 f = sample_bundle(i, seed).frame;
        const glm::dvec3 u = 0.1 * f[2], v = 0.05 * f[i % 2];
        b.polygon({at - u - v, at + u - v, at + u + v, at - u + v}, m.sheet);
    }
}

constexpr int stacked = 100;

void equal_stack(SceneBuilder& b, const RoomMaterials& m, std::uint64_t) {
    for (int i = 0; i < stacked; ++i)
        b.polygon({{0.2, 0.3, 0.4}, {0.8, 0.3, 0.4}, {0.8, 0.7, 0.5}, {0.2, 0.7, 0.5}}, m.sheet);
}

/// Each a little smaller than the one before.
void nested_stack(SceneBuilder& b, const RoomMaterials& m, std::uint64_t) {
    for (int i = 0; i < stacked; ++i) {
        const double r = 0.3 * (stacked - i) / stacked;
        b.polygon({{0.5 - r, 0.5 - r, 0.4},
                   {0.5 + r, 0.5 - r, 0.4},
                   {0.5 + r, 0.5 + r, 0.4},
                   {0.5 - r, 0.5 + r, 0.4}},
                  m.sheet);
    }
}

/// Each turned against the one before.
void turned_stack(SceneBuilder& b, const RoomMaterials& m, std::uint64_t) {
    for (int i = 0; i < stacked; ++i) {
        const double turn = 0.5 * std::numbers::pi * i / stacked;
        const glm::dvec3 u(0.3 * std::cos(turn), 0.3 * std::sin(turn), 0.0), v(-u.y, u.x, 0.0),
            at(0.5, 0.5, 0.4);
        b.polygon({at - u, at - v, at + u, at + v}, m.sheet);
    }
}

/// Closed spheres, each inside the one before.
constexpr double shell_radius = 0.4, shell_gap = 1e-5 * 2.0 * shell_radius;
void shells(SceneBuilder& b, const RoomMaterials& m, std::uint64_t) {
    for (int i = 0; i < 5; ++i)
        b.sphere({0.5, 0.5, 0.5}, shell_radius - i * shell_gap, 24, Facing::outwards, m.sheet);
}

/// What is inside the outermost shell, and how bright: no light gets there.
ClosedForm dark_inside_shells() {
    return {[](const Solution& s) {
        float most = 0.0f;
        for (std::uint32_t p = 0; p < s.patches.patch_count(); ++p) {
            const std::uint32_t leaf = s.patches.leaf_of_patch(p);
            const glm::dvec3 to =
                s.surface.positions[s.surface.triangles[s.patches.root_of_leaf[leaf]].vertices[0]] -
                0.5;
            const double r = glm::length(to);
            if (r > shell_radius + 0.5 * shell_gap) continue;
            if (r > shell_radius - 0.5 * shell_gap && !s.patches.is_back(p)) continue;
            most = std::max(most, max_channel(s.indirect_irradiance[p] + s.direct_irradiance[p]));
        }
        return double{most};
    }};
}

void tiny_sphere(SceneBuilder& b, const RoomMaterials& m, int meridians) {
    b.sphere({0.4, 0.5, 0.6}, 5e-4, meridians, Facing::outwards, m.solid);
}

/// The floor in pieces that meet its neighbours, and each other, in parts of edges.
Scene t_junctioned(Lit lit) {
    SceneBuilder b;
    b.scene = room(albedo, lit);
    const std::uint32_t floor = b.scene.polygons[0].material;
    b.scene.polygons.erase(b.scene.polygons.begin());
    b.polygon({{0, 0, 0}, {0.4, 0, 0}, {0.4, 1, 0}, {0, 1, 0}}, floor);
    b.polygon({{0.4, 0, 0}, {1, 0, 0}, {1, 0.7, 0}, {0.4, 0.7, 0}}, floor);
    b.polygon({{0.4, 0.7, 0}, {1, 0.7, 0}, {1, 1, 0}, {0.4, 1, 0}}, floor);
    return b.scene;
}

/// A room of four triangles.
Scene tetrahedron(Lit lit) {
    SceneBuilder b;
    const bool evenly = lit == Lit::evenly;
    const std::uint32_t wall =
        b.material(Spectrum(albedo), Spectrum(evenly ? 1.0f - albedo : 0.0f));
    const std::uint32_t floor =
        b.material(Spectrum(albedo), Spectrum(evenly ? 1.0f - albedo : 1.0f));
    for (const std::uint32_t m : {wall, floor}) b.scene.materials[m].back_reflects = false;
    const glm::dvec3 o(0, 0, 0), x(1, 0, 0), y(0, 1, 0), z(0, 0, 1);
    b.polygon({o, x, y}, floor);
    b.polygon({o, z, x}, wall);
    b.polygon({o, y, z}, wall);
    b.polygon({x, z, y}, wall);
    return b.scene;
}

/// A room on a triangle that is a hundred times as wide, both lit evenly; that one by a sky.
Scene on_a_large_ground() {
    SceneBuilder b;
    b.scene = room(albedo, Lit::evenly);
    b.polygon({{-100, -100, -0.01}, {100, -100, -0.01}, {0, 100, -0.01}},
              b.material(Spectrum(albedo)));
    b.scene.lighting.environment.kind = Environment::Kind::uniform;
    return b.scene;
}

Scene alone(float emission, float sky) {
    SceneBuilder b;
    b.polygon({{0, 0, 0}, {1, 0.1, 0}, {0.3, 1, 0.7}},
              b.material(Spectrum(albedo), Spectrum(emission)));
    if (sky > 0.0f) {
        b.scene.lighting.environment.kind = Environment::Kind::uniform;
        b.scene.lighting.environment.radiance_scale = Spectrum(sky);
    }
    return b.scene;
}

/// Of what nothing else is seen from.
ClosedForm irradiance(double radiance_of_sky) {
    return {[=](const Solution& s) {
        double furthest = 0.0;
        for (std::uint32_t p = 0; p < s.patches.patch_count(); ++p)
            if (s.coverage[p] > 0.0f && s.reflects(p))
                furthest = std::max(
                    furthest,
                    std::abs(s.indirect_irradiance[p].x * std::numbers::inv_pi - radiance_of_sky));
        return furthest;
    }};
}

/// Emits on its outside, and sees nothing but a sky.
Scene convex(float sky) {
    SceneBuilder b;
    b.sphere({0, 0, 0}, 1.0, 16, Facing::outwards, b.material(Spectrum(albedo), Spectrum(1.0f)));
    b.scene.materials[1].back_reflects = false;
    if (sky > 0.0f) {
        b.scene.lighting.environment.kind = Environment::Kind::uniform;
        b.scene.lighting.environment.radiance_scale = Spectrum(sky);
    }
    return b.scene;
}

class Shapes {
public:
    void in_both_lights(const std::string& name, const Filling& filling) {
        for (const Lit lit : {Lit::evenly, Lit::from_floor})
            add(name, lit, [=](std::uint64_t seed) { return room(albedo, lit, filling, seed); });
    }
    /// By a first shot, for each is small.
    void lit_by_itself(const std::string& name, const Filling& filling) {
        add("first shot of " + name,
            [=](std::uint64_t seed) { return room(albedo, Lit::from_filling, filling, seed); });
    }
    void add(const std::string& name, Lit lit, std::function<Scene(std::uint64_t)> scene) {
        Condition& c = add(name + ", " + name_of(lit), std::move(scene));
        if (lit != Lit::evenly) return;
        c.closed_form = even_radiance();
        c.options.light.first_shot = FirstShot::off;
    }
    Condition& add(const std::string& name, std::function<Scene(std::uint64_t)> scene) {
        all.push_back({.name = name,
                       .scene = std::move(scene),
                       .options = few_patches(),
                       .albedo = double{albedo}});
        return all.back();
    }
    /// The last ones again, as they come.
    void also_without_repair(std::size_t count) {
        for (std::size_t i = all.size() - count, end = all.size(); i < end; ++i) {
            Condition c = all[i];
            c.name += ", no repair";
            c.options.repair.level = RepairLevel::off;
            all.push_back(c);
        }
    }
    /// \param directions where as many as the effort says would take too long; else 0
    void make_long(std::size_t count, std::uint64_t directions = 0) {
        for (std::size_t i = all.size() - count; i < all.size(); ++i) {
            all[i].is_long = true;
            all[i].directions = directions;
        }
    }
    std::vector<Condition> all;
};

void add_stacks(Shapes& s) {
    s.in_both_lights("stack of 100 equal faces", equal_stack);
    s.also_without_repair(2);
    s.in_both_lights("stack of 100 nested faces", nested_stack);
    s.also_without_repair(2);
    s.make_long(2, 128);
    s.in_both_lights("stack of 100 turned faces", turned_stack);
    s.make_long(2);
}

void add_tiny(Shapes& s) {
    for (const int meridians : {100, 1000})
        s.in_both_lights(
            fmt::format("{} triangles in a pixel", 2 * meridians * (meridians / 2 - 1)),
            [=](SceneBuilder& b, const RoomMaterials& m, std::uint64_t) {
                tiny_sphere(b, m, meridians);
            });
    s.make_long(2, 128);
}

void add_large(Shapes& s) {
    for (const Lit lit : {Lit::evenly, Lit::from_floor})
        s.add("a room of four triangles", lit, [=](std::uint64_t) { return tetrahedron(lit); });
    s.add("a triangle that fills the scene", [](std::uint64_t) { return on_a_large_ground(); });
}

void add_open(Shapes& s) {
    for (const float sky : {0.0f, 1.0f}) {
        const std::string where = sky > 0.0f ? " in the sky" : "";
        s.add("a triangle alone" + where, [=](std::uint64_t) {
             return alone(1.0f - sky, sky);
         }).closed_form = irradiance(double{sky});
        s.add("fully open" + where, [=](std::uint64_t) { return convex(sky); }).closed_form =
            irradiance(double{sky});
    }
}

}  // namespace

std::vector<Condition> shape_conditions() {
    Shapes s;
    s.in_both_lights("needles of aspect 1e6", needles);
    s.also_without_repair(2);
    s.in_both_lights("slivers at every angle", slivers);
    s.in_both_lights("faces edge-on to directions", edge_on_squares);
    s.lit_by_itself("slivers", slivers);
    s.lit_by_itself("crossing squares", edge_on_squares);
    add_stacks(s);
    s.in_both_lights("shells 1e-5 apart", shells);
    s.all.back().closed_form = dark_inside_shells();
    s.also_without_repair(2);
    for (const Lit lit : {Lit::evenly, Lit::from_floor})
        s.add("T-junctions", lit, [=](std::uint64_t) { return t_junctioned(lit); });
    add_tiny(s);
    add_large(s);
    add_open(s);
    return s.all;
}

}  // namespace transillum::stability
