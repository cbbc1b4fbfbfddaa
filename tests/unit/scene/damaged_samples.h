/// Small files of every format, for tests to damage.
#pragma once

#include <ostream>
#include <string>
#include <vector>

namespace transillum {

struct Sample {
    std::string name;  ///< for people
    std::string file;  ///< "x.ply"
    std::string bytes;
    std::vector<std::pair<std::string, std::string>> beside{};  ///< files that it names
    /// Which of `beside` is damaged; -1: the file itself.
    int damaged = -1;

    [[nodiscard]] const std::string& target() const {
        return damaged < 0 ? bytes : beside[static_cast<std::size_t>(damaged)].second;
    }
    [[nodiscard]] std::string& target() {
        return damaged < 0 ? bytes : beside[static_cast<std::size_t>(damaged)].second;
    }
};

void PrintTo(const Sample& sample, std::ostream* out);

[[nodiscard]] std::vector<Sample> samples();

/// A container of a JSON text and a binary chunk.
[[nodiscard]] std::string glb_of(std::string json, std::string binary);

}  // namespace transillum
