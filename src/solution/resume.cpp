#include <transillum/base/error.h>
#include <transillum/solution/resume.h>
#include <transillum/transport/plain_sums.h>

#include "solution/baker.h"
#include "solution/energy.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <utility>

namespace transillum {

namespace {

constexpr std::uint64_t most_directions = std::numeric_limits<std::uint32_t>::max();

std::uint64_t directions_in_all(const Solution& s, const ResumeOptions& options) {
    const bool stops_otherwise = options.target_error > 0.0 || options.seconds > 0.0;
    std::uint64_t more = options.iterations;
    if (more == 0)
        more = stops_otherwise ? most_directions : std::max<std::uint64_t>(s.iterations, 1);
    if (s.iterations >= most_directions)
        throw UsageError(fmt::format("{} iterations are done; accepted: below 2^32", s.iterations));
    return std::min(most_directions, s.iterations + more);
}

void put_setting(Solution& s, const std::string& name, const std::string& value) {
    for (auto& [known, of_known] : s.settings)
        if (known == name) of_known = value;
}

bool has_setting(const Solution& s, const std::string& name, const std::string& value) {
    return std::ranges::find(s.settings, std::pair(name, value)) != s.settings.end();
}

/// As one bake would have been told.
void record_settings(Solution& s, const IterationOptions& iteration) {
    put_setting(s, "iterations", fmt::format("{}", iteration.iterations));
    put_setting(s, "target-error", fmt::format("{}", iteration.target_error));
    put_setting(s, "time", fmt::format("{}", iteration.seconds));
}

}  // namespace

void resume(Solution& s, const ResumeOptions& options, const Workers& workers, Monitor& monitor,
            RunRecord* run) {
    if (!s.continuation)
        throw UsageError("a solution without sums to go on from; accepted: one that kept them");
    StopWatch watch(run);
    const auto kept = std::exchange(s.continuation, nullptr);
    BakeOptions bake;
    bake.iteration = options_to_go_on(kept->sums);
    bake.iteration.iterations = directions_in_all(s, options);
    bake.iteration.target_error = options.target_error;
    bake.iteration.seconds = options.seconds;
    bake.iteration.keep_sums = options.keep_sums;
    bake.seed = s.seed;
    if (has_setting(s, "dark-rooms", "keep")) bake.dark_rooms = DarkRooms::keep;
    bake.memory = options.memory;

    Baker baker(bake, workers, monitor, watch);
    baker.goes_on_from = kept.get();
    baker.require_room(s, {});
    s.interrupted = false;
    const auto sums = baker.transport(s, bake.iteration.iterations, kept->sums, options.keep_sums);
    if (sums) s.continuation = std::make_shared<Continuation>(Continuation{sums, kept->first_shot});
    record_settings(s, bake.iteration);
    warn_of_sharp_lobes(s, monitor);
    if (run) run->threads = workers.count();
}

}  // namespace transillum
