/// What an iteration has summed up, in plain numbers: for files, and for those that read them.
#pragma once

#include <transillum/transport/iterate.h>

#include <string>
#include <vector>

namespace transillum {

/// Rows of `components` numbers each.
template <class Number>
struct NumberTable {
    std::string name;
    int components = 1;
    std::vector<Number> values;

    bool operator==(const NumberTable&) const = default;
};

struct PlainSums {
    std::vector<NumberTable<double>> doubles;
    std::vector<NumberTable<float>> floats;
    std::vector<NumberTable<std::uint64_t>> counts;
};

[[nodiscard]] PlainSums plain_sums(const IterationSums& sums);

/// The sums again, of these patches and sides. \throws UsageError naming the table that is missing,
/// not of the size that they ask for, or out of range.
[[nodiscard]] std::shared_ptr<const IterationSums> sums_of(const PlainSums& plain,
                                                           const PatchHierarchy& patches,
                                                           const GlossySides& glossy);

/// What another iteration needs that goes on from sums on the same elements: itself, and how they
/// were made. Seed and what stops it are left to the caller.
[[nodiscard]] IterationOptions options_to_go_on(std::shared_ptr<const IterationSums> sums);

}  // namespace transillum
