/// Bundles over finished elements, and what elements would hold of them (bundle_gather.h).
#pragma once

#include "render/bundle_gather.h"

#include <transillum/transport/bundle_light.h>

#include <vector>

namespace transillum {

/// How the Lambert part of a side weighs what one bundle brings: gain * L - control * X_bin. The
/// control is 0 but for GGX, whose coupling varies within a bin.
struct LambertGain {
    float gain = 0.0f, control = 0.0f;
    const Spectrum* elements = nullptr;  ///< X_bin, one a leaf of the side

    [[nodiscard]] Spectrum weigh(const Spectrum& incoming, std::uint32_t leaf_of_root) const {
        Spectrum sum = gain * incoming;
        if (control != 0.0f) sum -= control * elements[leaf_of_root];
        return sum;
    }
};

class BundleSums {
public:
    BundleSums(const Solution& solution, const SolutionShader& shader, MonteCarlo representation,
               std::uint64_t seed, const Workers& workers);

    /// Calls body() after each of so many bundles; forgets those before.
    template <class Body>
    void transfer(int bundles, Monitor& monitor, Body body) {
        forget();
        if (!shines_) return;
        for (int i = 0; i < bundles && !monitor.stop_requested(); ++i) {
            next();
            body();
            monitor.progress({"bundles", static_cast<std::uint64_t>(i) + 1,
                              static_cast<std::uint64_t>(bundles)});
        }
    }

    // Of the last bundle.
    [[nodiscard]] const BundleLight& light() const { return light_; }
    [[nodiscard]] const LambertGain& lambert_gain(std::uint32_t root, bool back) const {
        return gains_[2 * std::size_t{root} + (back ? 1 : 0)];
    }
    /// 2 pi cos theta f_r (L - X): a term of a lobe's sum.
    [[nodiscard]] Spectrum lobe_term(const SurfacePoint& p, const Spectrum& incoming) const;

    // Of the bundles since transfer() began.
    [[nodiscard]] int count() const { return count_; }
    [[nodiscard]] BundleLight::Projected projected() const { return light_.projected(); }
    /// P_k - n_k X_k.
    [[nodiscard]] GlossyField excess(const BundleLight::Projected& projected) const;

    [[nodiscard]] bool has_glossy() const { return !solution_.glossy.empty(); }

private:
    void forget();
    void next();
    void prepare_side(std::uint32_t root, bool back);

    const Solution& solution_;
    const SolutionShader& shader_;
    const Workers& workers_;
    PatchSources sources_;
    BundleLight light_;
    bool shines_;
    std::vector<LambertGain> gains_;           ///< 2 * root + back
    std::vector<std::uint64_t> first_weight_;  ///< of the glossy sides
    std::vector<float> weights_;               ///< sums of n_k, bin by bin of the sides
    int count_ = 0;
};

[[nodiscard]] inline Ray eye_ray(const PictureView& view, int x, int y, int sample) {
    PixelSampler random(view.seed, static_cast<std::uint64_t>(y) * view.width + x,
                        static_cast<std::uint32_t>(sample));
    const glm::dvec2 u(random.next_pair());
    return {view.rays.eye(), view.rays.direction(x + u.x, y + u.y)};
}

/// The Lambert part's residual times this is radiance.
[[nodiscard]] inline Spectrum lambert_share(const SurfacePoint& p) {
    return p.brdf.diffuse * diffuse_coupling(p.brdf, p.out.z);
}
/// Its lobe is one that elements and bundles reflect; rays follow the others.
[[nodiscard]] inline bool has_gathered_lobe(const SurfacePoint& p) {
    return p.side && p.has_lobe() && !p.is_sharp;
}

}  // namespace transillum
