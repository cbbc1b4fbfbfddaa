#include "cli/bake_output.h"

#include <fmt/format.h>

#include <unistd.h>

namespace transillum::cli {

void print_summary(const Solution& s, const std::string& path) {
    fmt::print(
        "{}: {} triangles, {} patches, {} light samples, {} iterations, estimated error {:.2f} "
        "%{}\n",
        path, s.surface.triangles.size(), s.patches.patch_count(), s.direct.samples.size(),
        s.iterations, 100.0 * s.relative_error, s.interrupted ? ", interrupted" : "");
}

std::uint64_t allowed_memory(double gibibytes) {
    if (gibibytes > 0.0) return static_cast<std::uint64_t>(gibibytes * 0x1p30);
    return static_cast<std::uint64_t>(sysconf(_SC_PHYS_PAGES)) *
           static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE)) / 10 * 9;
}

}  // namespace transillum::cli
