/// From a surface and its patches to radiance: the first shot and the iteration.
#pragma once

#include "solution/stop_watch.h"

#include <transillum/solution/bake.h>

#include <memory>
#include <span>

namespace transillum {

class Baker {
public:
    /// Keeps references.
    Baker(const BakeOptions& options, const Workers& workers, Monitor& monitor, StopWatch& watch)
        : options_(options), workers_(workers), monitor_(monitor), watch_(watch) {}

    /// Of a solution that has its surface, patches and lighting. Its decisions are begun anew.
    /// \param bin_levels one a root side \param iterations in all, those of `start` among them
    /// \returns what was summed up, for the next run to start from
    std::shared_ptr<const IterationSums> run(
        Solution& solution, std::span<const std::int8_t> bin_levels, std::uint64_t iterations,
        std::shared_ptr<const IterationSums> start = nullptr) const;

private:
    void shoot(Solution& solution) const;
    std::shared_ptr<const IterationSums> iterate_on(
        Solution& solution, std::uint64_t iterations,
        std::shared_ptr<const IterationSums> start) const;

    const BakeOptions& options_;
    const Workers& workers_;
    Monitor& monitor_;
    StopWatch& watch_;
};

}  // namespace transillum
