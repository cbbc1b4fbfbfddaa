/// What bake and resume have in common: the memory they may take, and what they print at the end.
#pragma once

#include <transillum/solution/solution.h>

#include <cstdint>
#include <string>

namespace transillum::cli {

/// [bytes]; of 0, nine tenths of the machine's.
[[nodiscard]] std::uint64_t allowed_memory(double gibibytes);

void print_summary(const Solution& solution, const std::string& path);

}  // namespace transillum::cli
