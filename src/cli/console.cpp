#include "cli/console.h"

#include <fmt/format.h>
#include <spdlog/sinks/stdout_sinks.h>
#include <spdlog/spdlog.h>

#include <unistd.h>
#include <atomic>
#include <cmath>
#include <csignal>

namespace transillum::cli {

namespace {

std::atomic<bool> stop{false};

void on_interrupt(int) {
    stop = true;
    std::signal(SIGINT, SIG_DFL);
}

std::string duration(double seconds) {
    const auto s = static_cast<long>(std::lround(seconds));
    return s < 3600 ? fmt::format("{}:{:02}", s / 60, s % 60)
                    : fmt::format("{}:{:02}:{:02}", s / 3600, s / 60 % 60, s % 60);
}

std::shared_ptr<spdlog::logger> logger() {
    auto log = spdlog::get("transillum");
    if (!log) {
        log = spdlog::stderr_logger_st("transillum");
        log->set_pattern("%v");
    }
    return log;
}

}  // namespace

Console::Console(bool quiet) : quiet_(quiet), terminal_(isatty(STDERR_FILENO) != 0) {
    std::signal(SIGINT, on_interrupt);
}

Console::~Console() {
    end_progress();
}

void Console::progress(const Progress& p) {
    if (quiet_) return;
    const auto now = Clock::now();
    if (p.phase != phase_) {
        end_progress();
        phase_ = p.phase;
        phase_start_ = now;
        done_before_ = p.done > 0 ? p.done - 1 : 0;
        last_shown_ = {};
    }
    const bool last = p.total > 0 && p.done >= p.total;
    const auto pause = terminal_ ? std::chrono::milliseconds(100) : std::chrono::seconds(5);
    if (!last && now - last_shown_ < pause) return;
    last_shown_ = now;
    const double elapsed = std::chrono::duration<double>(now - phase_start_).count();
    std::string line = fmt::format("{:<11} {:>6}", p.phase, p.done);
    if (p.total > 0) line += fmt::format(" of {}", p.total);
    if (std::isfinite(p.error)) line += fmt::format("  error {:.2f} %", 100.0 * p.error);
    line += fmt::format("  elapsed {}", duration(elapsed));
    if (p.total > p.done && p.done > done_before_)
        line +=
            fmt::format("  remaining {}", duration(elapsed * static_cast<double>(p.total - p.done) /
                                                   static_cast<double>(p.done - done_before_)));
    fmt::print(stderr, "{}{:<78}{}", terminal_ ? "\r" : "", line, terminal_ && !last ? "" : "\n");
    std::fflush(stderr);
    line_open_ = terminal_ && !last;
}

void Console::warn(const std::string& message) {
    end_progress();
    logger()->warn("warning: {}", message);
}

void Console::note(const std::string& message) {
    if (quiet_) return;
    end_progress();
    logger()->info("note: {}", message);
}

bool Console::stop_requested() const {
    return stop;
}

void Console::end_progress() {
    if (line_open_) fmt::print(stderr, "\n");
    line_open_ = false;
}

}  // namespace transillum::cli
