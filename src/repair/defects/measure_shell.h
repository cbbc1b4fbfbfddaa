/// What CGAL's polygon mesh processing says of a sheet's surface.
#pragma once

#include "repair/defects/shells.h"

#include <cstdint>
#include <vector>

namespace transillum {

/// Every edge has two faces?
[[nodiscard]] bool is_closed(const Shell& shell);

/// Negative when inside out. \pre closed
[[nodiscard]] double enclosed_volume(const Shell& shell);

/// The edges (3 * triangle + corner) of each loop of border edges, in their order around it.
[[nodiscard]] std::vector<std::vector<std::uint32_t>> border_loops(const Shell& shell);

}  // namespace transillum
