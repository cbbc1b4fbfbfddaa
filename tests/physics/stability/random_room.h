/// Closed rooms of random shape, colours and contents.
#pragma once

#include "physics/stability/rooms.h"

namespace transillum::stability {

/// Solids and sheets that stand, hang, lie flush on the floor and run through each other, each with
/// an albedo of its own in every channel, up to largest_random_albedo.
[[nodiscard]] Scene random_room(std::uint64_t number, Lit lit);
inline constexpr double largest_random_albedo = 0.9;

}  // namespace transillum::stability
