/// The projected BRDF of a lobe (paper §2.1):
///     f~_j(w') = 1 / Omega*_j  integral over bin j of f_r(w', w) cos theta dw
/// tabulated over incoming directions w', and the lobe's albedo in each bin.
#pragma once

#include <transillum/base/spectrum.h>
#include <transillum/scene/brdf.h>
#include <transillum/transport/direction_bins.h>

#include <span>
#include <vector>

namespace transillum {

class ProjectedBrdf {
public:
    ProjectedBrdf(const Brdf& brdf, int bin_level);

    [[nodiscard]] int level() const { return level_; }
    /// Mean over the channels of the projected lobe, one a bin [1 / sr]; `in` lies above the side.
    void lobe_into_bins(const glm::vec3& in, std::span<float> bins) const;
    /// Cosine-weighted mean over the bin's outgoing directions of the lobe's directional albedo
    /// [1].
    [[nodiscard]] const Spectrum& lobe_albedo(int bin) const { return albedo_[bin]; }

private:
    int level_;
    std::vector<float> table_;  ///< cell of the incoming square, then bin
    std::vector<Spectrum> albedo_;
};

}  // namespace transillum
