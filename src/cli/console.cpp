#include "cli/console.h"

#include "cli/log_file.h"

#include <fmt/format.h>

#include <sys/ioctl.h>
#include <unistd.h>
#include <atomic>
#include <csignal>
#include <cstdio>

namespace transillum::cli {

namespace {

constexpr int usual_width = 80;
constexpr std::chrono::milliseconds between_bars{100};
constexpr std::chrono::seconds between_lines{5}, between_objects{1};

std::atomic<bool> stop{false};

void on_interrupt(int) {
    stop = true;
    std::signal(SIGINT, SIG_DFL);
}

int terminal_width() {
    winsize size{};
    const bool known = ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 1;
    return known ? size.ws_col : usual_width;
}

ProgressStyle style_of(const Common& common) {
    if (common.quiet && common.progress != ProgressStyle::json) return ProgressStyle::none;
    if (common.progress != ProgressStyle::automatic) return common.progress;
    return isatty(STDERR_FILENO) ? ProgressStyle::bar : ProgressStyle::plain;
}

void print(const std::string& line) {
    fmt::print(stderr, "{}\n", line);
    std::fflush(stderr);
}

}  // namespace

Console::Console(const Common& common) : common_(common), style_(style_of(common)) {
    std::signal(SIGINT, on_interrupt);
    if (common.verbose) say("detail", "transillum " TRANSILLUM_VERSION ": " + common.command_line);
}

Console::~Console() {
    end_progress();
    conclude_phase();
    const std::chrono::duration<double> all = Clock::now() - start_;
    const std::string took = fmt::format("{:.2f} s in all", all.count());
    log("end", took);
    if (common_.verbose) say("detail", took);
}

void Console::progress(const Progress& p) {
    const auto now = Clock::now();
    if (last_ && last_->phase != p.phase) {
        end_progress();
        conclude_phase();
    }
    last_call_ = now;
    last_ = meter_.read(p, std::chrono::duration<double>(now - start_).count());
    if (last_->ends || now - last_logged_ >= between_lines) {
        last_logged_ = now;
        log("progress", plain_line(*last_));
    }
    if (style_ == ProgressStyle::none) return;
    const Clock::duration pause = style_ == ProgressStyle::bar    ? Clock::duration(between_bars)
                                  : style_ == ProgressStyle::json ? Clock::duration(between_objects)
                                                                  : Clock::duration(between_lines);
    if (!last_->ends && now - last_shown_ < pause) return;
    last_shown_ = now;
    show(*last_);
}

void Console::show(const ProgressReading& reading) {
    if (style_ == ProgressStyle::json) return print(json_line(reading));
    if (style_ == ProgressStyle::plain) return print(plain_line(reading));
    // The last column stays free: a terminal may begin a new line after it.
    const int width = terminal_width() - 1;
    fmt::print(stderr, "\r{:<{}}", bar_line(reading, width), width);
    line_open_ = !reading.ends;
    if (reading.ends) fmt::print(stderr, "\n");
    std::fflush(stderr);
}

void Console::say(const char* event, const std::string& message) {
    end_progress();
    if (style_ == ProgressStyle::json) return print(json_message(event, message));
    const std::string kind(event);
    print(kind == "detail" ? message : kind + ": " + message);
}

void Console::warn(const std::string& message) {
    log("warning", message);
    say("warning", message);
}

void Console::note(const std::string& message) {
    log("note", message);
    if (!common_.quiet) say("note", message);
}

bool Console::stop_requested() const {
    return stop;
}

void Console::end_progress() {
    if (line_open_) fmt::print(stderr, "\n");
    line_open_ = false;
}

void Console::conclude_phase() {
    if (!last_) return;
    const std::chrono::duration<double> seconds = last_call_ - phase_start_;
    const std::string took = fmt::format("{}: {:.2f} s", last_->phase, seconds.count());
    last_.reset();
    phase_start_ = last_call_;
    last_shown_ = last_logged_ = {};
    log("detail", took);
    if (common_.verbose) say("detail", took);
}

}  // namespace transillum::cli
