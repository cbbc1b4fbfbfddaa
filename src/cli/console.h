/// Progress and messages on stderr, and in a log file; the wish to stop from SIGINT.
#pragma once

#include "cli/command.h"
#include "cli/progress_meter.h"

#include <transillum/base/monitor.h>

#include <chrono>
#include <optional>
#include <string>

namespace transillum::cli {

/// Takes over SIGINT: the first asks to stop, a second ends the program at once.
class Console : public Monitor {
public:
    explicit Console(const Common& common);
    ~Console() override;
    void progress(const Progress& p) override;
    void warn(const std::string& message) override;
    void note(const std::string& message) override;
    [[nodiscard]] bool stop_requested() const override;
    /// Ends a line of progress that is still open.
    void end_progress();

private:
    using Clock = std::chrono::steady_clock;

    void show(const ProgressReading& reading);
    /// Says how long the phase took: from the last report of the one before to its own.
    void conclude_phase();
    void say(const char* event, const std::string& message);

    const Common& common_;
    ProgressStyle style_;
    ProgressMeter meter_;
    std::optional<ProgressReading> last_;  ///< of the phase at hand
    Clock::time_point start_ = Clock::now(), last_shown_{}, last_logged_{};
    Clock::time_point phase_start_ = start_, last_call_ = start_;
    bool line_open_ = false;
};

}  // namespace transillum::cli
