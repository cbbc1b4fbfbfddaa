/// How long-running work speaks to its caller: progress, messages, and the wish to stop.
#pragma once

#include <cstdint>
#include <limits>
#include <string>
#include <string_view>

namespace transillum {

struct Progress {
    std::string_view phase;   ///< "load", "first shot", "transport", "render", ...
    std::uint64_t done = 0;   ///< iterations, samples or rows done
    std::uint64_t total = 0;  ///< 0 where it is not known
    double error = std::numeric_limits<double>::quiet_NaN();  ///< relative error, NaN where unknown
    bool may_end_sooner = false;                              ///< than at `total`
};

/// An argument of every long-running function. The default says nothing and never stops.
/// Calls come from one thread at a time; `stop_requested` may be asked from any.
class Monitor {
public:
    virtual ~Monitor() = default;
    virtual void progress(const Progress&) {}
    /// Something a user must know: data was changed, energy removed, a feature not honoured.
    virtual void warn(const std::string&) {}
    /// A decision taken for the user, with its reason.
    virtual void note(const std::string&) {}
    [[nodiscard]] virtual bool stop_requested() const { return false; }
};

}  // namespace transillum
