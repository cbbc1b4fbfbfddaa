/// Rooms with something in them, lit in two ways that tell what light there must be.
#pragma once

#include "physics/stability/condition.h"
#include "support/scene_builder.h"

#include <functional>

namespace transillum::stability {

/// Materials of what stands in a room; see Lit.
struct RoomMaterials {
    std::uint32_t sheet = 0;  ///< both sides
    std::uint32_t solid = 0;  ///< with a black back, which only the inside of a solid may have
};
using Filling = std::function<void(testing_support::SceneBuilder& builder,
                                   const RoomMaterials& materials, std::uint64_t seed)>;

enum class Lit {
    evenly,        ///< what reflects emits 1 - albedo: every radiance is 1 (validation A1)
    from_floor,    ///< the floor emits 1: energy is all there is to tell
    from_filling,  ///< the same of what stands in the room, on both sides
};
[[nodiscard]] std::string name_of(Lit lit);

/// The inside of the unit cube, black from outside. \param filling may be empty
[[nodiscard]] Scene room(float albedo, Lit lit, const Filling& filling = {},
                         std::uint64_t seed = 1);

/// Deviation from an even radiance of what emits, mean over all that was seen.
[[nodiscard]] ClosedForm even_radiance(double radiance = 1.0);

}  // namespace transillum::stability
