/// Rooms that no light reaches (design 4.9): roots that the transport may leave out.
///
/// Light is followed along a few bundles by yes or no, root side by root side: what emits, reflects
/// the first shot or is outside under an environment shines; what a side that shines faces is
/// reached, and shines from the next bundle on unless it is black. That is so quick to fill a lit
/// room that a scene without dark ones costs some bundles out of hundreds.
///
/// Without the roots of which neither side is reached, nothing new is exchanged by those that are
/// left: what lies beyond them sends nothing towards them.
#pragma once

#include <transillum/transport/iterate.h>

#include <cstdint>
#include <vector>

namespace transillum {

struct DarkRoots {
    std::vector<std::uint8_t> is_dark;  ///< one a root; empty where none is
    std::uint32_t count = 0;
    double surface = 0.0;          ///< their share of the scene's surface [0, 1]
    std::uint64_t directions = 0;  ///< that light was followed along

    [[nodiscard]] bool empty() const { return count == 0; }
};

/// None where they are less than 5 % of the surface, or where a light was not met within 128
/// directions: too little is known then. Of what is dark, no fragment met light along 64
/// directions, both ways: what comes through a crack that can be looked through from fewer is
/// missed. Does not depend on the number of workers. \param options the iteration's; of its time,
/// if that is limited, the search takes an eighth at most
[[nodiscard]] DarkRoots find_dark_roots(const SurfaceMesh& mesh, const PatchHierarchy& patches,
                                        const PatchSources& sources,
                                        const IterationOptions& options, const Workers& workers,
                                        Monitor& monitor);

}  // namespace transillum
