/// What an infinitely distant point sees: a parallel projection, by the transillumination buffer.
#pragma once

#include <transillum/base/parallel.h>
#include <transillum/visibility/hemicube.h>
#include <transillum/visibility/ray_tracer.h>
#include <transillum/visibility/transillumination_buffer.h>

#include <atomic>
#include <memory>
#include <vector>

namespace transillum {

/// Its memory is reused from view to view; uses all workers itself.
class ParallelView {
public:
    /// Keeps references. \param resolution pixels across the scene [16, 8192], about.
    /// \throws UsageError otherwise.
    ParallelView(const SurfaceMesh& mesh, const PatchHierarchy& patches, int resolution);

    /// The view along the direction of a bundle. One entry a patch: `mean_kernel` is cos', 0 where
    /// it faces away; `visibility` is the share of its pixels where it is first in the list. A
    /// patch between pixel centres is seen where a ray from its centre meets nothing. Does not
    /// depend on the number of workers.
    const std::vector<PatchView>& look(const Bundle& bundle, const Workers& workers);

private:
    struct Pixels {
        std::atomic<std::uint32_t> all = 0, first = 0;
    };
    [[nodiscard]] bool is_open(std::uint32_t patch, const glm::dvec3& direction);

    const SurfaceMesh& mesh_;
    const PatchHierarchy& patches_;
    TransilluminationBuffer buffer_;
    std::vector<Pixels> pixels_;       ///< one a patch
    std::unique_ptr<RayTracer> rays_;  ///< made for the first patch between pixels
    std::vector<PatchView> views_;
};

}  // namespace transillum
