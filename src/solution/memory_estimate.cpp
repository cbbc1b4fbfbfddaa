#include "solution/memory_estimate.h"

#include <transillum/base/error.h>

#include <fmt/format.h>

namespace transillum {

namespace {

/// Sums, those set aside by a restart, radiance and results of a patch; and what each thread keeps.
constexpr std::uint64_t bytes_a_patch = 400, bytes_a_patch_and_thread = 32;
/// Sums, those set aside, incoming radiance and result of an element.
constexpr std::uint64_t bytes_an_element = 60;
/// A copy of the sums, and of those set aside where there are.
constexpr std::uint64_t bytes_a_patch_kept = 192, bytes_an_element_kept = 32;
/// Results of a group, and the sums that they are converted in.
constexpr std::uint64_t bytes_a_patch_and_group = 36, bytes_a_patch_converted = 76,
                        bytes_an_element_and_group = 12, bytes_an_element_converted = 24;

double gibibytes(std::uint64_t bytes) {
    return static_cast<double>(bytes) * 0x1p-30;
}

}  // namespace

std::uint64_t kept_sums_bytes(const Solution& solution) {
    return solution.patches.patch_count() * bytes_a_patch_kept +
           solution.glossy.element_count * bytes_an_element_kept;
}

MemoryEstimate estimate_memory(const Solution& solution, const Luminaires& luminaires, int threads,
                               std::uint64_t band_groups) {
    const std::uint64_t patches = solution.patches.patch_count();
    const std::uint64_t elements = solution.glossy.element_count;
    const std::uint64_t converted =
        patches * bytes_a_patch_converted + elements * bytes_an_element_converted;
    return {patches * (bytes_a_patch + bytes_a_patch_and_thread * static_cast<unsigned>(threads)),
            first_shot_bytes(luminaires, patches),
            elements * bytes_an_element,
            0,
            band_groups == 0 ? 0
                             : band_groups * (patches * bytes_a_patch_and_group +
                                              elements * bytes_an_element_and_group) +
                                   converted,
            0};
}

void require_memory(const MemoryEstimate& e, std::uint64_t limit) {
    if (limit == 0 || e.total() <= limit) return;
    throw UsageError(fmt::format(
        "memory: {:.2f} GiB for patches, {:.2f} for light samples, {:.2f} for direction "
        "bins{}{}{}; "
        "accepted: {:.2f} in all. Fewer leaves, light samples or direction bins need less; light "
        "vectors (--first-shot vectors), less than samples",
        gibibytes(e.patches), gibibytes(e.first_shot), gibibytes(e.direction_bins),
        e.monte_carlo == 0
            ? ""
            : fmt::format(", {:.2f} for the Monte-Carlo component", gibibytes(e.monte_carlo)),
        e.band_groups == 0
            ? ""
            : fmt::format(", {:.2f} for bands or emitters", gibibytes(e.band_groups)),
        e.kept_sums == 0 ? ""
                         : fmt::format(", {:.2f} for sums to go on from (--keep-sums off)",
                                       gibibytes(e.kept_sums)),
        gibibytes(limit)));
}

}  // namespace transillum
