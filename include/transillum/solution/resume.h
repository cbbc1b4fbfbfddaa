/// Going on with a bake.
#pragma once

#include <transillum/solution/solution.h>

#include <transillum/base/monitor.h>
#include <transillum/base/parallel.h>
#include <transillum/solution/save_solution.h>

#include <cstdint>

namespace transillum {

struct ResumeOptions {
    /// Most directions more; 0: as many again or, where error or time stop it, until they do.
    std::uint64_t iterations = 0;
    double target_error = 0.0;  ///< stop when the estimated relative error is below; 0: never
    double seconds = 0.0;       ///< stop after that time of transport; 0: never
    bool keep_sums = true;      ///< for going on once more
    std::uint64_t memory = 0;   ///< most that tables may take [bytes]; 0: no limit
};

/// Takes more directions into a solution. The result, settings and all, is to the last bit that of
/// one bake of as many directions; but where the Monte-Carlo component was being carried: it is
/// begun anew, as a decision then says. (Of
/// sides that were still dark, files hold no geometry factors: resumed ones neither; no light was
/// reflected with them.) A bake that ended within a block of directions goes on from
/// where the block began, and takes those once more: a fifth of all at most.
/// \param run adds to its times, where given. \pre the scene's first shot is whole, as
/// `continuation` says. \throws UsageError where the solution has none, has as many directions as
/// there can be, or the tables would need more memory than is allowed.
void resume(Solution& solution, const ResumeOptions& options, const Workers& workers,
            Monitor& monitor, RunRecord* run = nullptr);

}  // namespace transillum
