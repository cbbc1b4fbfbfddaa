#include "cli/progress_meter.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>

namespace transillum::cli {

namespace {

using Json = nlohmann::ordered_json;
/// Below, a bar tells less than it takes; above, it is only longer.
constexpr int least_bar = 8, most_bar = 24;

std::string dump(const Json& json) {
    // Names of files may be in another encoding than UTF-8.
    return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

/// All but the phase.
std::string figures(const ProgressReading& r) {
    std::string line = fmt::format("{}", r.done);
    if (r.total > 0) line += fmt::format(" of {}  {} %", r.total, r.percent());
    if (std::isfinite(r.error)) line += fmt::format("  error {:.2f} %", 100.0 * r.error);
    line += "  elapsed " + format_duration(r.elapsed);
    if (r.remaining)
        line += fmt::format("  remaining {}{}", r.at_most ? "at most " : "",
                            format_duration(*r.remaining));
    return line;
}

}  // namespace

int ProgressReading::percent() const {
    return static_cast<int>(100.0 * static_cast<double>(std::min(done, total)) /
                            static_cast<double>(total));
}

ProgressReading ProgressMeter::read(const Progress& p, double now) {
    if (p.phase != phase_) {
        phase_ = p.phase;
        start_ = now;
        done_before_ = p.done > 0 ? p.done - 1 : 0;
    }
    ProgressReading r{phase_, p.done, p.total, p.may_end_sooner, false, p.error, now - start_, {}};
    r.ends = p.total > 0 && p.done >= p.total;
    // The first call of a phase comes after some of it was done, and starts the clock.
    const double since_start = static_cast<double>(p.done) - static_cast<double>(done_before_ + 1);
    if (p.total > p.done && since_start > 0.0)
        r.remaining = r.elapsed * static_cast<double>(p.total - p.done) / since_start;
    return r;
}

std::string format_duration(double seconds) {
    const auto s = static_cast<long>(std::lround(seconds));
    return s < 3600 ? fmt::format("{}:{:02}", s / 60, s % 60)
                    : fmt::format("{}:{:02}:{:02}", s / 3600, s / 60 % 60, s % 60);
}

std::string plain_line(const ProgressReading& r) {
    return fmt::format("{:<11} {}", r.phase, figures(r));
}

std::string bar_line(const ProgressReading& r, int width) {
    const std::string text = figures(r);
    const int around = static_cast<int>(std::max<std::size_t>(r.phase.size(), 11) + text.size());
    const int length = std::min(most_bar, width - around - 5);
    std::string line = plain_line(r);
    if (r.total > 0 && length >= least_bar) {
        const int filled = length * r.percent() / 100;
        line = fmt::format("{:<11} [{:=<{}}{: <{}}]  {}", r.phase, "", filled, "", length - filled,
                           text);
    }
    return line.substr(0, static_cast<std::size_t>(std::max(width, 1)));
}

std::string json_line(const ProgressReading& r) {
    Json json{{"event", "progress"}, {"phase", r.phase}, {"done", r.done}};
    if (r.total > 0) {
        json["total"] = r.total;
        json["percent"] = r.percent();
        if (r.at_most) json["may_end_sooner"] = true;
    }
    if (std::isfinite(r.error)) json["error"] = r.error;
    json["elapsed"] = r.elapsed;
    if (r.remaining) json["remaining"] = *r.remaining;
    return dump(json);
}

std::string json_message(const std::string& event, const std::string& message) {
    return dump({{"event", event}, {"message", message}});
}

}  // namespace transillum::cli
