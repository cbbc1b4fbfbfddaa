/// Light paths between Lambert surfaces (Kajiya 1986). At every vertex the light is sampled both
/// over the emitters and over directions; the two are combined by the power heuristic (Veach 1997,
/// section 9.2).
#pragma once

#include "render/emitter_sampler.h"
#include "render/facets.h"
#include "render/pixel_sampler.h"

#include <transillum/visibility/ray_tracer.h>

#include <vector>

namespace transillum {

struct PathVertex {
    glm::dvec3 point, normal;  ///< of the side that is lit
};

/// cos * cos' / distance^2 as if nothing were between; zero where one faces away.
[[nodiscard]] double coupling(const PathVertex& a, const PathVertex& b);

/// A path from the eye, cut after the second surface so that its end can be shared.
struct EyePath {
    Spectrum emitted{0.0f};  ///< by the first surface
    Spectrum direct{0.0f};   ///< the emitters' light that it reflects
    Spectrum albedo{0.0f};   ///< of the first surface; black where the path ends there
    PathVertex first;
    Spectrum from_second{0.0f};  ///< reflected by the second surface; black where there is none
    PathVertex second;
};

class PathTracer {
public:
    /// Keeps a reference to the mesh. \param max_bounces reflections, 0 for no limit
    PathTracer(const SurfaceMesh& mesh, int max_bounces);

    /// Nothing emits.
    [[nodiscard]] bool dark() const { return emitters_.empty(); }
    [[nodiscard]] EyePath start(const Ray& ray, PixelSampler& random) const;
    /// Radiance that a vertex reflects, times the weight (its albedo, after `bounces` reflections
    /// before).
    [[nodiscard]] Spectrum reflected(PathVertex v, Spectrum weight, int bounces,
                                     PixelSampler& random) const;
    [[nodiscard]] bool sees(const PathVertex& a, const PathVertex& b) const {
        return !rays_.occluded(a.point, a.normal, b.point, b.normal);
    }

private:
    [[nodiscard]] const Material& material(const Hit& hit) const;
    [[nodiscard]] Spectrum albedo_at(const Hit& hit) const;
    [[nodiscard]] PathVertex vertex_at(const Hit& hit) const;
    [[nodiscard]] Hit follow(const PathVertex& v, const glm::dvec3& direction) const;
    [[nodiscard]] Spectrum from_emitter_sample(const PathVertex& v, glm::vec2 u) const;
    [[nodiscard]] Spectrum emitted_along(const PathVertex& v, const glm::dvec3& direction,
                                         const Hit& hit) const;
    [[nodiscard]] Spectrum direct_light(const PathVertex& v, PixelSampler& random, Hit& next) const;

    const SurfaceMesh& mesh_;
    std::vector<Facet> facets_;
    EmitterSampler emitters_;
    RayTracer rays_;
    int max_bounces_;
};

}  // namespace transillum
