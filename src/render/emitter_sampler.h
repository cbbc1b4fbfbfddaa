/// Points on the emitters, in proportion to the flux that leaves them.
#pragma once

#include "render/facets.h"

#include <glm/vec2.hpp>

#include <cstdint>
#include <vector>

namespace transillum {

struct EmitterPoint {
    glm::dvec3 position;
    glm::dvec3 normal;  ///< of the side that emits
    Spectrum radiance;
    double density;  ///< per area
};

class EmitterSampler {
public:
    EmitterSampler(const SurfaceMesh& mesh, const std::vector<Facet>& facets);

    [[nodiscard]] bool empty() const { return sides_.empty(); }
    /// \pre not empty
    [[nodiscard]] EmitterPoint sample(glm::vec2 u) const;
    /// Density per area of a point on a side; 0 where it is never sampled.
    [[nodiscard]] double density(std::uint32_t root, bool back) const {
        return densities_.empty() ? 0.0 : densities_[2 * static_cast<std::size_t>(root) + back];
    }

private:
    struct Side {
        std::uint32_t root;
        bool back;
    };
    const std::vector<Facet>& facets_;
    const SurfaceMesh& mesh_;
    std::vector<Side> sides_;
    std::vector<double> cumulative_;  ///< radiance * area up to and with each side
    std::vector<double> densities_;   ///< front and back of every root; empty without emitters
    double total_ = 0.0;
};

}  // namespace transillum
