/// Scenes that don't need a part of the method, each with what forces a bake to take it all the
/// same: the answer must be the same.
#pragma once

#include <transillum/solution/bake.h>

#include <cstdint>
#include <string>
#include <vector>

namespace transillum::testing_support {

struct DecisionCase {
    std::string name;
    const char* told = "";  ///< in what a bake says that decides: of a Decision, or why
    Scene scene, forced_scene;
    BakeOptions options, forced_options;
    /// Only means can be compared: the forced bake has other patches, or other shapes of light.
    bool means_alone = false;
    /// Of what arrives, relative, beside the errors that both bakes estimate of themselves.
    double tolerance = 0.0;
};

struct DecisionSize {
    std::uint32_t leaves = 2000;
    std::uint64_t directions = 128;
    int spheres = 1;     ///< along each edge of the grid in a room
    int meridians = 12;  ///< of a sphere
    int many_pixels = 700;
};

[[nodiscard]] std::vector<DecisionCase> decision_cases(const DecisionSize& size);

[[nodiscard]] bool tells(const Solution& solution, const std::string& text);

/// What arrives at the fronts, luminance, direct and indirect, and how much each weighs.
struct FrontField {
    std::vector<double> values, areas;
    double relative_error = 0.0;  ///< as estimated
    [[nodiscard]] double mean() const;
};
[[nodiscard]] FrontField fronts_of(const Solution& solution);
/// Root mean square difference over b's mean.
/// \pre of the same patches
[[nodiscard]] double relative_rms(const FrontField& a, const FrontField& b);

}  // namespace transillum::testing_support
