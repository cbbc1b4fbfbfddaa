/// Light vectors of luminaires, summed up sample by sample (paper §4).
#pragma once

#include <transillum/base/parallel.h>
#include <transillum/first_shot/direct_light.h>
#include <transillum/geometry/patch_hierarchy.h>
#include <transillum/geometry/surface_mesh.h>
#include <transillum/visibility/hemicube.h>

#include <glm/vec3.hpp>

#include <cstdint>
#include <vector>

namespace transillum {

class LightVectorSums {
    struct Sum {
        glm::dvec3 vector{0.0};
        double share = 0.0;
    };

public:
    static constexpr std::uint64_t bytes_a_patch = sizeof(Sum);

    /// Keeps references; fills light.vectors. \pre light.samples and light.first_samples are there
    LightVectorSums(const SurfaceMesh& mesh, const PatchHierarchy& patches, DirectLight& light);

    /// The samples of a luminaire come one after the other; after its last, its vectors are there.
    /// \param scale of the views' kernels
    void add(std::size_t sample, const std::vector<PatchView>& views, double scale,
             const Workers& workers);
    /// No more samples come: makes do with those that the last luminaire got.
    void close(const Workers& workers);

private:
    void add(const LightSample& sample, std::uint32_t patch, double share);
    void write(std::uint32_t patch);

    const SurfaceMesh& mesh_;
    const PatchHierarchy& patches_;
    DirectLight& light_;
    std::vector<Sum> sums_;      ///< of the luminaire at hand, one a patch
    std::size_t luminaire_ = 0;  ///< that one
    bool is_open_ = false;       ///< some of its samples came
};

}  // namespace transillum
