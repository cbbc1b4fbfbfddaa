/// Variants of the method: plain ray-bundle iteration and what the paper adds to it, one part after
/// the other.
#pragma once

#include <transillum/render/image.h>
#include <transillum/render/render_solution.h>
#include <transillum/solution/bake.h>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace transillum::benchmarks {

struct Variant {
    const char* name;
    FirstShot first_shot;
    Averaging averaging;
    MonteCarlo carried;
    MonteCarloShading shown;
    int refinement;
    DirectShading direct = DirectShading::traced;
};

[[nodiscard]] const std::vector<Variant>& all_variants();

/// A bake of so many directions. \param common what does not depend on the variant
[[nodiscard]] Solution bake_variant(const Variant& variant, std::uint64_t directions,
                                    const Scene& scene, const BakeOptions& common,
                                    const Workers& workers);

struct View {
    std::string camera;          ///< empty: the scene's first
    std::optional<Camera> free;  ///< instead of one of the scene's
    int width = 100, height = 100;
};
/// \throws what choose_camera() does
[[nodiscard]] Camera camera_of(const View& view, const std::vector<Camera>& cameras,
                               const SurfaceMesh& surface);
/// \param directions of the bake: as many bundles again, where the variant's pictures take any
[[nodiscard]] Image render_variant(const Variant& variant, std::uint64_t directions,
                                   const Solution& solution, const View& view,
                                   const Workers& workers);

}  // namespace transillum::benchmarks
