#include "solution/memory_estimate.h"

#include <transillum/base/error.h>

#include <fmt/format.h>

namespace transillum {

namespace {

/// Sums, those set aside by a restart, radiance and results of a patch; and what each thread keeps.
constexpr std::uint64_t bytes_a_patch = 400, bytes_a_patch_and_thread = 32;
/// Sums, those set aside, incoming radiance and result of an element.
constexpr std::uint64_t bytes_an_element = 60;

double gibibytes(std::uint64_t bytes) {
    return static_cast<double>(bytes) * 0x1p-30;
}

}  // namespace

MemoryEstimate estimate_memory(const Solution& solution, const Luminaires& luminaires,
                               int threads) {
    const std::uint64_t patches = solution.patches.patch_count();
    return {patches * (bytes_a_patch + bytes_a_patch_and_thread * static_cast<unsigned>(threads)),
            first_shot_bytes(luminaires, patches),
            solution.glossy.element_count * bytes_an_element};
}

void require_memory(const MemoryEstimate& e, std::uint64_t limit) {
    if (limit == 0 || e.total() <= limit) return;
    throw UsageError(fmt::format(
        "memory: {:.2f} GiB for patches, {:.2f} for light samples, {:.2f} for direction bins; "
        "accepted: {:.2f} in all. Fewer leaves, light samples or direction bins need less",
        gibibytes(e.patches), gibibytes(e.first_shot), gibibytes(e.direction_bins),
        gibibytes(limit)));
}

}  // namespace transillum
