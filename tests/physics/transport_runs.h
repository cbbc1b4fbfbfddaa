/// Running the transport on small scenes, and means over what came out.
#pragma once

#include "support/scene_builder.h"

#include <transillum/base/error.h>
#include <transillum/transport/iterate.h>

#include <functional>

namespace transillum::testing_support {

struct RunOptions {
    std::uint64_t directions = 256;
    std::uint32_t leaves = 1500;
    int max_level = 8;
    int resolution = 300;
    std::uint64_t seed = 1;
    int threads = 2;
    Averaging averaging = Averaging::balanced;
    MonteCarlo monte_carlo = MonteCarlo::off;
};

/// A surface with what the iteration made of it. Emission all travels by iteration.
struct TransportRun {
    SurfaceMesh surface;
    PatchHierarchy patches;
    PatchSources sources;
    TransportResult result;

    /// Area-weighted mean of the irradiance over the patches that `chosen` picks, by root and side,
    /// per pi: that is, the mean radiance arriving. First channel.
    [[nodiscard]] double mean_incoming(
        const std::function<bool(std::uint32_t root, bool back)>& chosen) const;
    /// Emission and everything reflected, of one patch. First channel.
    [[nodiscard]] double radiance(std::uint32_t patch) const;
};

/// All but the iteration.
[[nodiscard]] TransportRun prepare_transport(const Scene& scene, const RunOptions& options);
/// With elements of one's own; `options` says nothing of leaves then.
[[nodiscard]] TransportRun prepare_transport(const SurfaceMesh& surface,
                                             const PatchHierarchy& patches);
void iterate_in(TransportRun& run, const RunOptions& options);

[[nodiscard]] TransportRun run_transport(const Scene& scene, const RunOptions& options);
[[nodiscard]] TransportRun run_transport(const SurfaceMesh& surface, const PatchHierarchy& patches,
                                         const RunOptions& options);

inline bool all_fronts(std::uint32_t, bool back) {
    return !back;
}

/// The unit cube, fronts inwards, all of one albedo; its floor (the first two roots) emits a
/// radiance of `floor`, the rest of `others`.
[[nodiscard]] Scene cube_scene(float albedo, float floor, float others);

/// Two unit rooms beside each other along x, joined by a door; the floor of the first emits a
/// radiance of 1.
[[nodiscard]] Scene two_rooms_scene(float albedo);
[[nodiscard]] bool is_in_far_room(const SurfaceMesh& surface, std::uint32_t root);

}  // namespace transillum::testing_support
