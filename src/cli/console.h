/// Progress and messages on stderr; the wish to stop from SIGINT.
#pragma once

#include <transillum/base/monitor.h>

#include <chrono>
#include <cstdint>
#include <string>

namespace transillum::cli {

class Console : public Monitor {
public:
    /// Takes over SIGINT: the first asks to stop, a second ends the program at once.
    explicit Console(bool quiet);
    ~Console() override;
    void progress(const Progress& p) override;
    void warn(const std::string& message) override;
    void note(const std::string& message) override;
    [[nodiscard]] bool stop_requested() const override;
    /// Ends a line of progress that is still open.
    void end_progress();

private:
    using Clock = std::chrono::steady_clock;

    bool quiet_;
    bool terminal_;  ///< a line of progress can be rewritten
    bool line_open_ = false;
    std::string phase_;
    Clock::time_point phase_start_ = Clock::now(), last_shown_{};
    std::uint64_t done_before_ = 0;  ///< by earlier runs, which this one goes on from
};

}  // namespace transillum::cli
