// How many directions, and how many patches.
#include "physics/stability/rooms.h"

#include <fmt/format.h>

namespace transillum::stability {

using namespace testing_support;

namespace {

/// Sums, and what is fed back, must not drift.
void add_drift(std::vector<Condition>& to) {
    for (const std::uint64_t directions : {std::uint64_t{1} << 14, std::uint64_t{1'000'000}})
        for (const Lit lit : {Lit::evenly, Lit::from_floor}) {
            Condition c{.name = fmt::format("{} directions, {}", directions, name_of(lit)),
                        .scene = [=](std::uint64_t) { return room(0.9f, lit); },
                        .options = few_patches(),
                        .directions = directions,
                        .seeds = 3,
                        .is_long = directions > 100'000};
            c.options.subdivision.leaf_target = 50;
            c.options.resolution = 32;
            if (lit == Lit::evenly) c.closed_form = even_radiance();
            to.push_back(c);
        }
}

/// Few directions leave every estimate noisy.
void add_noise(std::vector<Condition>& to) {
    for (const std::uint64_t directions : {1, 7, 8, 9, 15, 16, 33, 64, 65})
        for (const Lit lit : {Lit::evenly, Lit::from_floor}) {
            Condition c{.name = fmt::format("{} directions, {}", directions, name_of(lit)),
                        .scene = [=](std::uint64_t) { return room(0.9f, lit); },
                        .options = few_patches(),
                        .directions = directions,
                        .is_balanced = directions >= 8};
            if (lit == Lit::evenly && directions >= 8) c.closed_form = even_radiance();
            to.push_back(c);
        }
}

Scene one_triangle_in_the_sky() {
    SceneBuilder b;
    b.polygon({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, b.material(Spectrum(0.5f), Spectrum(0.5f)));
    b.scene.materials[1].back_emits = true;
    b.scene.lighting.environment.kind = Environment::Kind::uniform;
    return b.scene;
}

void add_depth(std::vector<Condition>& to) {
    for (const int level : {8, max_subdivision_level}) {
        Condition c{.name = fmt::format("a triangle of level {}", level),
                    .scene = [](std::uint64_t) { return one_triangle_in_the_sky(); },
                    .options = few_patches(),
                    .closed_form = even_radiance(),
                    .albedo = 0.5,
                    .directions = 16,
                    .seeds = 2,
                    .is_long = level > 8};
        c.options.subdivision.patch_size = 1.5 / (1 << level);
        c.options.subdivision.max_level = level;
        c.options.resolution = 0;
        c.options.iteration.monte_carlo = MonteCarlo::off;
        to.push_back(c);
    }
}

/// A small lamp over an edge.
void sheet_under_lamp(SceneBuilder& b, const RoomMaterials& m, std::uint64_t) {
    b.polygon({{0.2, 0.3, 0.5}, {0.7, 0.3, 0.5}, {0.6, 0.8, 0.5}}, m.sheet);
}

void add_refinement(std::vector<Condition>& to) {
    for (const int phases : {3, 7}) {
        Condition c{.name = fmt::format("{} phases of refinement", phases),
                    .scene =
                        [](std::uint64_t seed) {
                            Scene scene = room(0.5f, Lit::from_floor, sheet_under_lamp, seed);
                            scene.materials[scene.polygons[0].material].emission = Spectrum(0.0f);
                            PunctualLight lamp;
                            lamp.position = {0.45, 0.5, 0.9};
                            scene.lighting.lights.push_back(lamp);
                            return scene;
                        },
                    .options = few_patches(),
                    .albedo = 0.5,
                    .directions = phases > 3 ? 256u : 0u,
                    .seeds = phases > 3 ? 3 : 0,
                    .is_long = phases > 3};
        c.options.subdivision.leaf_target = 50;
        c.options.subdivision.max_level = max_subdivision_level - 1;
        c.options.refinement.phases = phases;
        c.options.refinement.tolerance = 0.02;
        c.options.refinement.max_leaves = phases > 3 ? 1u << 20 : 1u << 11;
        c.options.resolution = phases > 3 ? 0 : 128;
        to.push_back(c);
    }
}

}  // namespace

std::vector<Condition> effort_conditions() {
    std::vector<Condition> all;
    add_noise(all);
    add_drift(all);
    add_depth(all);
    add_refinement(all);
    return all;
}

}  // namespace transillum::stability
