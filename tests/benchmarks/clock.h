#pragma once

#include <chrono>

namespace transillum::benchmarks {

/// Wall time since it was made.
class Clock {
public:
    [[nodiscard]] double seconds() const {
        return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
    }

private:
    std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

}  // namespace transillum::benchmarks
