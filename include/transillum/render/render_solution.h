/// Measurement of a solution by a camera (paper §2.2, operator M): eye rays to the first surface,
/// and there emission + direct + finite-element + Monte-Carlo radiance (paper §2.1, eq. 3). Rays
/// that leave see the environment, those that meet sharp lobes what these mirror (paper §7).
#pragma once

#include <transillum/base/monitor.h>
#include <transillum/base/parallel.h>
#include <transillum/render/image.h>
#include <transillum/solution/solution.h>

#include <memory>

namespace transillum {

enum class DirectShading {
    stored,  ///< the patches' stored incoming radiance, interpolated like the finite elements
    /// Shadow rays to the light samples where a patch and those about it don't agree that they are
    /// seen, or hidden; everywhere, where light vectors are stored.
    traced,
    traced_everywhere  ///< shadow rays to all of them from every point
};

/// How the Monte-Carlo component, what finite elements leave out of the reflection, is estimated.
enum class MonteCarloShading {
    automatic,  ///< rays where a surface is glossy, else off: least error in the same time
    off,
    rays,  ///< along glossy lobes of points that are seen, as noise; Lambert surfaces get none
    /// Bundles transferred anew, what they bring constant on the quarters of patches (§3.1.2).
    /// Carried from picture to picture (§5).
    subpatch,
    wavefront  ///< the same as deep buffers know them, point by point (§3.1.1)
};

/// What of the radiance is shown. Through mirrors these are the components of what is mirrored.
struct Components {
    bool emission = true, direct = true, finite_element = true, monte_carlo = true;
};

struct RenderOptions {
    int width = 500, height = 500;
    int samples = 16;  ///< most rays a pixel [1, 4096]; flat pixels get fewer
    /// Most samples a pixel of what is left to chance [1, 4096]: the Monte-Carlo component and what
    /// sharp lobes show; calm pixels get fewer. And bundles a picture.
    int iterations = 64;
    MonteCarloShading monte_carlo = MonteCarloShading::automatic;
    DirectShading direct = DirectShading::traced;
    bool interpolate = true;  ///< Gouraud within shading fans; else one radiance a patch
    Components components;
    std::uint64_t seed = 1;
};

class BundleGather;
class SolutionShader;

/// A solution made ready to be looked at, for one camera after the other.
class SolutionRenderer {
public:
    /// Keeps references to the solution and the workers. Notes what it decided. \throws UsageError
    /// for a count out of range.
    SolutionRenderer(const Solution& solution, const RenderOptions& options, const Workers& workers,
                     Monitor& monitor);
    ~SolutionRenderer();
    SolutionRenderer(SolutionRenderer&&) noexcept;
    SolutionRenderer& operator=(SolutionRenderer&&) noexcept;

    /// Of the next pictures: their size [pixels], and the seed of the positions in a pixel.
    /// \throws UsageError for a size below 1
    void set_picture(int width, int height, std::uint64_t seed);

    /// Pixels are means over their squares. The image does not depend on the number of threads, but
    /// with sub-patches on those before.
    /// \throws UsageError for a size or a camera it cannot use.
    [[nodiscard]] Image render(const Camera& camera, const Workers& workers, Monitor& monitor);

private:
    RenderOptions options_;
    std::unique_ptr<SolutionShader> shader_;
    std::unique_ptr<BundleGather> gather_;  ///< null without bundles
};

/// One picture of a SolutionRenderer.
[[nodiscard]] Image render_solution(const Solution& solution, const Camera& camera,
                                    const RenderOptions& options, const Workers& workers,
                                    Monitor& monitor);

/// The camera of that name, or its first where the name is empty, or, where it has none, a
/// view that frames the whole surface. \throws UsageError listing the names there are.
[[nodiscard]] Camera choose_camera(const std::vector<Camera>& cameras, const SurfaceMesh& surface,
                                   const std::string& name);

}  // namespace transillum
