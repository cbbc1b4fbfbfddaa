/// The first shot's light at a patch, as directions and irradiances (paper §4).
#pragma once

#include <transillum/solution/solution.h>
#include <transillum/transport/iterate.h>

#include <vector>

namespace transillum {

/// Appends an entry for every light sample, or light vector, that reaches the patch, as seen from
/// its centre.
void append_incoming_light(const Solution& solution, std::uint32_t patch,
                           std::vector<IncomingLight>& incoming);

}  // namespace transillum
