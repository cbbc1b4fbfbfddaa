/// How far a phase has come, how long it took and how long the rest will take; and the lines that
/// say so.
#pragma once

#include <transillum/base/monitor.h>

#include <cstdint>
#include <limits>
#include <optional>
#include <string>

namespace transillum::cli {

struct ProgressReading {
    std::string phase;
    std::uint64_t done = 0, total = 0;                        ///< total 0: not known
    bool at_most = false;                                     ///< it may end before `total`
    bool ends = false;                                        ///< nothing of the phase is left
    double error = std::numeric_limits<double>::quiet_NaN();  ///< NaN: not known
    double elapsed = 0.0;                                     ///< [s]
    std::optional<double> remaining;  ///< [s], where it can be told: as fast as so far

    /// Rounded down: 100 when all is done, and not before. \pre total > 0
    [[nodiscard]] int percent() const;
};

class ProgressMeter {
public:
    /// \param now [s], of any clock
    [[nodiscard]] ProgressReading read(const Progress& progress, double now);

private:
    std::string phase_;
    double start_ = 0.0;
    std::uint64_t done_before_ = 0;  ///< by earlier runs, which this one goes on from
};

/// "transport  144 of 256  56 %  error 3.20 %  elapsed 0:03  remaining 0:02"
[[nodiscard]] std::string plain_line(const ProgressReading& reading);
/// The same after a bar, no wider than `width`; the bar is left out where there is no room or no
/// total.
[[nodiscard]] std::string bar_line(const ProgressReading& reading, int width);
/// An object with the members of a reading, those that are not known left out.
[[nodiscard]] std::string json_line(const ProgressReading& reading);
/// {"event": "note", "message": ...}
[[nodiscard]] std::string json_message(const std::string& event, const std::string& message);

/// 0:05, 1:00:00
[[nodiscard]] std::string format_duration(double seconds);

}  // namespace transillum::cli
