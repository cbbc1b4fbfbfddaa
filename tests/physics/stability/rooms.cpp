#include "physics/stability/rooms.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace transillum::stability {

using namespace testing_support;

BakeOptions few_patches() {
    BakeOptions options;
    options.subdivision.leaf_target = 300;
    options.resolution = 128;
    options.hemicube_resolution = 64;
    options.iteration.monte_carlo = MonteCarlo::automatic;
    return options;
}

std::vector<Condition> all_conditions() {
    std::vector<Condition> all;
    for (const auto& part : {light_conditions, place_conditions, shape_conditions,
                             effort_conditions, random_conditions})
        std::ranges::move(part(), std::back_inserter(all));
    return all;
}

std::string name_of(Lit lit) {
    const char* const names[] = {"lit evenly", "lit from the floor", "lit from what is in it"};
    return names[static_cast<int>(lit)];
}

Scene room(float albedo, Lit lit, const Filling& filling, std::uint64_t seed) {
    SceneBuilder b;
    const auto material = [&](Lit where) {
        const float emission = lit == Lit::evenly ? 1.0f - albedo : lit == where ? 1.0f : 0.0f;
        return b.material(Spectrum(albedo), Spectrum(emission));
    };
    const std::uint32_t solid = material(Lit::evenly), floor = material(Lit::from_floor);
    const std::uint32_t sheet = material(Lit::from_filling);
    for (const std::uint32_t m : {solid, floor}) b.scene.materials[m].back_reflects = false;
    b.scene.materials[sheet].back_emits = true;
    b.box({0, 0, 0}, {1, 1, 1}, Facing::inwards, solid);
    b.scene.polygons[0].material = floor;
    if (filling) filling(b, {sheet, solid}, seed);
    return b.scene;
}

ClosedForm even_radiance(double radiance) {
    return {[radiance](const Solution& s) {
        double sum = 0.0, fragments = 0.0;
        for (std::uint32_t p = 0; p < s.patches.patch_count(); ++p) {
            if (!s.emits(p) || s.coverage[p] == 0.0f) continue;
            const SpectrumSum there(s.emission(p) + s.direct_radiance(p) +
                                    s.finite_element_radiance(p));
            sum += s.coverage[p] * max_channel(glm::abs(there / radiance - 1.0));
            fragments += s.coverage[p];
        }
        return sum / fragments;
    }};
}

}  // namespace transillum::stability
