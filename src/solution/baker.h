/// From a surface and its patches to radiance: the first shot and the iteration.
#pragma once

#include "solution/stop_watch.h"

#include <transillum/solution/bake.h>

namespace transillum {

class Baker {
public:
    /// Keeps references.
    Baker(const BakeOptions& options, const Workers& workers, Monitor& monitor, StopWatch& watch)
        : options_(options), workers_(workers), monitor_(monitor), watch_(watch) {}

    /// Of a solution that has its surface, patches and lighting. Its decisions are begun anew.
    void run(Solution& solution, std::uint64_t iterations) const;

    // Its two halves. The second may be repeated with other colours.
    void prepare(Solution& solution) const;
    void transport(Solution& solution, std::uint64_t iterations) const;

    std::uint64_t band_groups = 0;  ///< whose results are to be kept, for the estimate of memory

private:
    void shoot(Solution& solution) const;
    void iterate_on(Solution& solution, std::uint64_t iterations) const;

    const BakeOptions& options_;
    const Workers& workers_;
    Monitor& monitor_;
    StopWatch& watch_;
};

/// What comes before the Baker's last run: a solution with surface and patches, refined where
/// options say so; of that, `refined` tells.
[[nodiscard]] Solution lay_out_solution(const Scene& scene, const BakeOptions& options,
                                        const Baker& baker, StopWatch& watch, Monitor& monitor,
                                        std::vector<Decision>& refined);

}  // namespace transillum
