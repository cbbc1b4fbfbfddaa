/// What an eye ray sees of a solution (paper §2.1, eq. 3): emission + direct + finite-element +
/// Monte-Carlo radiance.
///
/// The Monte-Carlo component is estimated by bundles (bundle_gather.h) or, at glossy points, by
/// rays: a direction of the lobe is followed to the next surface, and what comes from there, less
/// what the finite elements hold for that direction, is added to what the lobe makes of them: they
/// are the control variate. What comes from there is corrected likewise, by Russian roulette.
/// Lobes sharper than any direction bin are followed by rays instead (paper §7), through one such
/// surface after the other.
#pragma once

#include "render/direct_shader.h"
#include "render/facets.h"
#include "render/glossy_field.h"
#include "render/lambert_field.h"
#include "render/pixel_sampler.h"
#include "render/vertex_grid.h"

#include <transillum/render/render_solution.h>
#include <transillum/visibility/ray_tracer.h>

#include <optional>

namespace transillum {

struct Sight {
    Spectrum steady{0.0f};     ///< what needs no chance
    Spectrum by_chance{0.0f};  ///< one estimate of the rest
    bool has_chance = false;   ///< there is a rest
    bool emits = false;        ///< an emitter or the environment is seen
};

/// What of a sight is worked out; the rest is left black.
struct Wanted {
    bool steady = true, by_chance = true;
};

class SolutionShader {
public:
    /// Keeps a reference to the solution. \pre options.monte_carlo is decided
    SolutionShader(const Solution& solution, const RenderOptions& options, const Workers& workers);
    [[nodiscard]] Sight look(const Ray& ray, Wanted wanted, PixelSampler& random) const;

    struct Seen {
        Hit hit;
        SurfacePoint point;
    };
    /// The surface that a ray meets, without what it shows.
    [[nodiscard]] std::optional<Seen> meet(const Ray& ray) const;
    /// \param direction that it is seen along
    [[nodiscard]] SurfacePoint point_at(const Hit& hit, const glm::dvec3& direction) const;
    [[nodiscard]] const std::vector<Facet>& facets() const { return facets_; }
    /// Null where nothing is interpolated.
    [[nodiscard]] const VertexGrid* grid() const {
        return grid_.leaf_vertices.empty() ? nullptr : &grid_;
    }
    [[nodiscard]] const DirectShader& direct() const { return direct_; }
    /// \pre the solution has glossy sides
    [[nodiscard]] const GlossyField& glossy() const { return glossy_; }

private:
    /// One of the two ways that surfaces are shown.
    struct Manner {
        bool emission, direct, finite_element, monte_carlo;
        DirectShading shading;
        const LambertField* lambert;
    };
    struct Scattered {
        Spectrum weight{0.0f};  ///< black where the path ends
        Ray ray;
    };

    [[nodiscard]] Spectrum emission(const Hit& hit) const;
    [[nodiscard]] bool is_shot(const Hit& hit) const;
    [[nodiscard]] Spectrum shade(const SurfacePoint& p, const Manner& manner) const;
    [[nodiscard]] Spectrum direct(const SurfacePoint& p, const Manner& manner) const;
    [[nodiscard]] Scattered scatter(const SurfacePoint& p, PixelSampler& random) const;
    /// What sharp lobes show.
    [[nodiscard]] Spectrum mirrored(SurfacePoint p, const Manner& manner,
                                    PixelSampler& random) const;
    [[nodiscard]] Spectrum difference(const SurfacePoint& p, PixelSampler& random) const;
    [[nodiscard]] Spectrum arriving(const Ray& ray, PixelSampler& random) const;

    const Solution& solution_;
    std::vector<Facet> facets_;
    RayTracer rays_;
    VertexGrid grid_;
    GlossyField glossy_;
    DirectShader direct_;
    LambertField shown_lambert_, whole_lambert_;
    Manner shown_;                ///< to the eye, as the options say
    Manner whole_;                ///< to other surfaces: all that the solution stores
    bool rays_from_eye_ = false;  ///< where lobes are seen, too, not only through mirrors
};

}  // namespace transillum
