/// The Monte-Carlo component as an eye sees it, from bundles that are transferred anew over the
/// finished elements (paper §2.2, C' = M(L^e + L~ + dL); §3.1 for its two representations; §5).
///
/// Along bundles m = 1..N the radiance L_m(x) arrives at a point x from directions d_m. What the
/// point reflects of it beyond the elements is, with 2 pi for the two ways of a bundle,
///     Lambert part  1/N sum_m 2 cos theta_m L_m(x)  -  P(x)            [incoming, weighted]
///     lobe          1/N sum_m 2 pi cos theta_m f_r(d_m, out) (L_m(x) - X(x, d_m))
///                   -  sum_k Omega* f~_k(out) (P_k(x) - n_k X_k(x))
/// X_k(x) are the elements of the solution and P_k(x), P(x) what elements would hold of these very
/// N bundles, both interpolated as in the picture; n_k is what elements would hold of N bundles of
/// unit radiance, 1 in the limit. So all that is smooth over a patch cancels bundle by bundle, that
/// the N directions are no perfect quadrature too, and the picture tends to one exact reflection of
/// what the solution holds: uniform light is shown without any noise. On sub-patches a residual of
/// zero counts for 32 bundles beside them (subpatch_gather.cpp): few bundles show less of it.
#pragma once

#include "render/camera_rays.h"
#include "render/solution_shader.h"

#include <memory>
#include <vector>

namespace transillum {

/// Eye rays through a pixel, of which the residual of a pixel is the mean: it is small, and its
/// edges want no more.
inline constexpr int gather_samples = 4;

struct PictureView {
    CameraRays rays;
    int width, height;
    std::uint64_t seed;  ///< of the positions in a pixel
};

class BundleGather {
public:
    virtual ~BundleGather() = default;

    /// Transfers so many bundles and gathers what they bring to the pixels' surfaces.
    /// \return radiance to be added to each pixel, of either sign
    [[nodiscard]] virtual std::vector<Spectrum> gather(const PictureView& view, int bundles,
                                                       Monitor& monitor) = 0;
};

/// Keeps references. The representation alone decides which: on sub-patches the component goes on
/// from picture to picture.
[[nodiscard]] std::unique_ptr<BundleGather> make_subpatch_gather(const Solution& solution,
                                                                 const SolutionShader& shader,
                                                                 std::uint64_t seed,
                                                                 const Workers& workers);
[[nodiscard]] std::unique_ptr<BundleGather> make_wavefront_gather(const Solution& solution,
                                                                  const SolutionShader& shader,
                                                                  std::uint64_t seed,
                                                                  const Workers& workers);

}  // namespace transillum
