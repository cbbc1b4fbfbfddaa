/// Bakes a condition, and judges what comes out.
#pragma once

#include "physics/stability/condition.h"

#include <transillum/base/parallel.h>

#include <limits>
#include <string>
#include <vector>

namespace transillum::stability {

/// A mean over seeds that should be 0.
struct Deviation {
    double mean = 0.0;
    double allowed = 0.0;  ///< largest size of the mean that rounding and sampling explain
};

struct Row {
    std::string name;
    std::uint64_t directions = 0;
    int seeds = 0;  ///< more than asked for where these left it open whether energy is balanced
    std::uint32_t leaves = 0;
    /// Flux that is missing or too much, over what there is, of the worst channel (validation A4).
    Deviation energy;
    bool is_balanced = true;  ///< else energy had too few directions to settle, and is not judged
    bool has_closed_form = false;
    Deviation closed_form;
    double least = std::numeric_limits<double>::infinity();  ///< radiance
    /// Over the largest source divided by 1 - albedo, which no radiance exceeds.
    double most_over_bound = 0.0;
    double unseen = 0.0;       ///< largest share of the area that no direction met
    double cpu_seconds = 0.0;  ///< of all threads and seeds
    std::vector<std::string> faults;

    [[nodiscard]] bool passed() const { return faults.empty(); }
};

[[nodiscard]] Row measure(const Condition& condition, const Effort& effort, const Workers& workers);

}  // namespace transillum::stability
