/// Directions towards the environment, about in proportion to its radiance.
#pragma once

#include <transillum/scene/environment.h>

#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>

#include <vector>

namespace transillum {

class EnvironmentSampler {
public:
    /// Tabulates the radiance. Keeps no reference.
    explicit EnvironmentSampler(const Environment& environment);

    /// Nothing to gain from sampling it: it is black, or the same everywhere.
    [[nodiscard]] bool empty() const { return total_ == 0.0; }
    /// Unit direction away from the scene. \pre not empty
    [[nodiscard]] glm::dvec3 sample(glm::vec2 u) const;
    /// Density [1 / sr]; 0 where empty.
    [[nodiscard]] double density(const glm::dvec3& direction) const;

private:
    [[nodiscard]] glm::dvec3 direction_at(double column, double row) const;
    [[nodiscard]] double weight_of(const Environment& environment, int column, int row) const;
    [[nodiscard]] double cell_size(std::size_t row) const;

    glm::dmat3 frame_{1.0};  ///< z is the zenith
    int columns_ = 0, rows_ = 0, points_ = 2;
    std::vector<double> cells_;  ///< radiance * solid angle up to and with each cell of a row
    std::vector<double> ends_;   ///< of the rows, summed up
    double total_ = 0.0;
};

}  // namespace transillum
