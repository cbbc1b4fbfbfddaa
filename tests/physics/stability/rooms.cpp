#include "physics/stability/rooms.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace transillum::stability {

using namespace testing_support;

BakeOptions few_patches() {
    BakeOptions options;
    options.subdivision.leaf_target = 1000;
    options.resolution = 200;
    options.hemicube_resolution = 128;
    options.iteration.monte_carlo = MonteCarlo::off;
    return options;
}

std::vector<Condition> all_conditions() {
    std::vector<Condition> all;
    for (const auto& part :
         {light_conditions, place_conditions, shape_conditions, effort_conditions})
        std::ranges::move(part(), std::back_inserter(all));
    return all;
}

Scene room(float albedo, Lit lit, const Filling& filling, std::uint64_t seed) {
    SceneBuilder b;
    const bool evenly = lit == Lit::evenly;
    const Spectrum emission(evenly ? 1.0f - albedo : 0.0f);
    const std::uint32_t solid = b.material(Spectrum(albedo), emission);
    const std::uint32_t sheet = b.material(Spectrum(albedo), emission);
    const std::uint32_t floor = b.material(Spectrum(albedo), evenly ? emission : Spectrum(1.0f));
    for (const std::uint32_t m : {solid, floor}) b.scene.materials[m].back_reflects = false;
    b.scene.materials[sheet].back_emits = true;
    b.box({0, 0, 0}, {1, 1, 1}, Facing::inwards, solid);
    b.scene.polygons[0].material = floor;
    if (filling) filling(b, {sheet, solid}, seed);
    return b.scene;
}

bool is_seen(const Solution& s, std::uint32_t patch) {
    return s.coverage[patch] > 0.0f;
}

ClosedForm even_radiance(double radiance) {
    return {[radiance](const Solution& s) {
        double furthest = 0.0;
        for (std::uint32_t p = 0; p < s.patches.patch_count(); ++p) {
            if (!s.emits(p) || !is_seen(s, p)) continue;
            const SpectrumSum there(s.emission(p) + s.direct_radiance(p) +
                                    s.finite_element_radiance(p));
            for (int c = 0; c < channel_count; ++c)
                furthest = std::max(furthest, std::abs(there[c] / radiance - 1.0));
        }
        return furthest;
    }};
}

}  // namespace transillum::stability
