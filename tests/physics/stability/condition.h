/// Conditions that light must be found under, whatever they are: extremes of light, of coordinates
/// and of shapes.
#pragma once

#include <transillum/solution/bake.h>

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace transillum::stability {

/// How often every condition is baked, each time from another seed, and along how many directions.
struct Effort {
    std::uint64_t directions = 256;
    int seeds = 4;
};

/// What a condition has a closed form of.
struct ClosedForm {
    /// Relative error of a solution; 0 where it is met to the last bit.
    std::function<double(const Solution&)> error;
    /// Whether directions that are samples may make it differ: then its mean over the seeds is to
    /// be 0, within the spread; else it is met but for the rounding of floats.
    bool is_sampled = false;
};

struct Condition {
    std::string name;  ///< "what, how much, where"
    /// \param seed that is going to be baked with
    std::function<Scene(std::uint64_t seed)> scene;
    BakeOptions options;
    ClosedForm closed_form = {};
    /// Albedo that the rounding of floats is repeated by: each reflection rounds again.
    double albedo = 0.9;
    std::uint64_t directions = 0;  ///< 0: as many as the effort says
    int seeds = 0;                 ///< likewise
    bool is_balanced = true;       ///< else too few directions for energy to have settled
    bool is_long = false;          ///< left out of the short matrix
};

/// Few patches and pixels, the rest as `transillum bake` has it.
[[nodiscard]] BakeOptions few_patches();

// Each file of the same name has its own.
[[nodiscard]] std::vector<Condition> light_conditions();
[[nodiscard]] std::vector<Condition> place_conditions();
[[nodiscard]] std::vector<Condition> shape_conditions();
[[nodiscard]] std::vector<Condition> effort_conditions();
[[nodiscard]] std::vector<Condition> random_conditions();

[[nodiscard]] std::vector<Condition> all_conditions();

}  // namespace transillum::stability
