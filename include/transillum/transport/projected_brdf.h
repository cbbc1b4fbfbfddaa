/// The projected BRDF (paper §2.1) of a lobe: its mean over a direction bin,
///     f~_k(w) = 1 / Omega*  integral over bin k of f_r(w', w) cos theta' dw',   Omega* = pi /
///     bins.
///
/// The paper projects the outgoing radiance. Here bins hold the incoming radiance X_k, and the lobe
/// reflects sum_k Omega* f~_k(w) X_k; by reciprocity the table is the same one. So the radiance
/// varies smoothly with w, uniform light is reflected exactly in every direction, a direction of
/// light touches one bin instead of all, and a fixed table cannot create energy.
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
    /// Shares of the bins in what the lobe reflects towards `out`: Omega* f~_k(out) over the lobe's
    /// albedo, channel mean; they sum to 1. \pre shares.size() is the number of bins
    void shares(const glm::vec3& out, std::span<float> shares) const;
    /// Cosine-weighted means over a bin: of the lobe's directional albedo, and of diffuse_coupling.
    [[nodiscard]] const Spectrum& lobe_albedo(int bin) const { return lobe_albedo_[bin]; }
    [[nodiscard]] float coupling(int bin) const { return coupling_[bin]; }

private:
    int level_;
    std::vector<float> table_;  ///< cell of the outgoing square, then bin
    std::vector<Spectrum> lobe_albedo_;
    std::vector<float> coupling_;
};

}  // namespace transillum
