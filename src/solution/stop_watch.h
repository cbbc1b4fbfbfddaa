/// Wall time of the phases of a run.
#pragma once

#include <transillum/solution/save_solution.h>

#include <chrono>

namespace transillum {

/// Adds the time since the last lap to the record.
class StopWatch {
public:
    explicit StopWatch(RunRecord* run) : run_(run) {}
    void lap(const char* phase) {
        const auto now = std::chrono::steady_clock::now();
        const std::chrono::duration<double> elapsed = now - last_;
        last_ = now;
        if (!run_) return;
        for (auto& [name, seconds] : run_->seconds)
            if (name == phase) {
                seconds += elapsed.count();
                return;
            }
        run_->seconds.emplace_back(phase, elapsed.count());
    }

private:
    RunRecord* run_;
    std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

}  // namespace transillum
