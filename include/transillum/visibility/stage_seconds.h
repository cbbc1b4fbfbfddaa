/// Where the time of the transillumination buffer goes.
#pragma once

#include <chrono>

namespace transillum {

/// Seconds of all threads together.
struct StageSeconds {
    double project = 0.0;    ///< vertices into the window
    double bin = 0.0;        ///< triangles into tiles
    double rasterize = 0.0;  ///< triangles into fragments
    double sort = 0.0;       ///< fragments by pixel and depth
    double visit = 0.0;      ///< what becomes of the lists: their exchange

    StageSeconds& operator+=(const StageSeconds& other) {
        project += other.project;
        bin += other.bin;
        rasterize += other.rasterize;
        sort += other.sort;
        visit += other.visit;
        return *this;
    }
};

/// Of one thread. Reading it takes some 25 ns: once a tile and stage, not once a triangle.
class StageClock {
public:
    /// Adds the time since the last lap.
    void lap(double& seconds) {
        const Clock::time_point now = Clock::now();
        seconds += std::chrono::duration<double>(now - last_).count();
        last_ = now;
    }

private:
    using Clock = std::chrono::steady_clock;
    Clock::time_point last_ = Clock::now();
};

}  // namespace transillum
