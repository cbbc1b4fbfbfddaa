/// From a surface and its patches to radiance: the first shot and the iteration.
#pragma once

#include "solution/stop_watch.h"

#include <transillum/solution/bake.h>

#include <memory>
#include <span>

namespace transillum {

/// What phases of refinement have come to, beside the patches.
struct Refined {
    std::vector<std::int8_t> bin_levels;        ///< one a root side
    std::shared_ptr<const IterationSums> sums;  ///< null before the first
    std::uint64_t directions = 0;
};

class Baker {
public:
    /// Keeps references.
    Baker(const BakeOptions& options, const Workers& workers, Monitor& monitor, StopWatch& watch)
        : options_(options), workers_(workers), monitor_(monitor), watch_(watch) {}

    /// Of a solution that has its surface, patches and lighting. Its decisions are begun anew.
    /// \param iterations in all, those that `refined` has sums of among them
    /// \returns what was summed up, for the next run to go on from, where that is to be kept
    std::shared_ptr<const IterationSums> run(Solution& solution, const Refined& refined,
                                             std::uint64_t iterations,
                                             bool keep_sums = false) const;

    // Its two halves. The second may be repeated with other colours.
    void prepare(Solution& solution, std::span<const std::int8_t> bin_levels) const;
    std::shared_ptr<const IterationSums> transport(
        Solution& solution, std::uint64_t iterations,
        std::shared_ptr<const IterationSums> start = nullptr, bool keep_sums = false) const;

    /// Says that what the iteration is going to need is there. \param luminaires that are to be
    /// shot
    void require_room(const Solution& solution, const Luminaires& luminaires) const;

    std::uint64_t band_groups = 0;  ///< whose results are to be kept, for the estimate of memory
    /// Of an earlier bake of the same solution; null otherwise.
    const Continuation* goes_on_from = nullptr;

private:
    [[nodiscard]] double pixel_size(const Solution& solution) const;
    void shoot(Solution& solution) const;
    std::shared_ptr<const IterationSums> iterate_on(Solution& solution, std::uint64_t iterations,
                                                    std::shared_ptr<const IterationSums> start,
                                                    bool keep_sums) const;

    const BakeOptions& options_;
    const Workers& workers_;
    Monitor& monitor_;
    StopWatch& watch_;
};

/// Repairs a scene as the options ask for it, on the grid that patches need; warns of what is left.
[[nodiscard]] RepairedScene make_sound(const Scene& scene, RepairOptions options,
                                       const Workers& workers, Monitor& monitor);

/// What comes before the Baker's last run: a solution with surface and patches, refined where
/// options say so; of that, the decisions tell.
struct Layout {
    Solution solution;
    Refined refined;
    std::vector<Decision> decisions;
};
[[nodiscard]] Layout lay_out_solution(RepairedScene sound, const BakeOptions& options,
                                      const Baker& baker, StopWatch& watch, Monitor& monitor);

}  // namespace transillum
