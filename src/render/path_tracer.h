/// Light paths between surfaces (Kajiya 1986). At every vertex the light is sampled both over the
/// emitters and the environment and over directions of the BRDF; these are combined by the power
/// heuristic (Veach 1997, section 9.2). Of the lights without extent one is picked, by what it
/// would add if nothing stood between.
#pragma once

#include "render/emitter_sampler.h"
#include "render/environment_sampler.h"
#include "render/facets.h"
#include "render/pixel_sampler.h"

#include <transillum/scene/brdf.h>
#include <transillum/scene/lighting.h>
#include <transillum/visibility/ray_tracer.h>

#include <glm/mat3x3.hpp>

#include <vector>

namespace transillum {

/// A lit point of a surface, and where its light goes.
struct PathVertex {
    /// \param normal of the side that is lit; \param out unit, away from the surface
    PathVertex(const glm::dvec3& point, const glm::dvec3& normal, const Brdf& brdf,
               const glm::dvec3& out);
    PathVertex() = default;

    /// In the frame that BRDFs are stated in.
    [[nodiscard]] glm::vec3 local(const glm::dvec3& direction) const;

    glm::dvec3 point{0.0}, normal{0.0};
    glm::mat3 frame{1.0f};
    Brdf brdf;
    glm::vec3 out{0.0f, 0.0f, 1.0f};  ///< local
};

/// Reflected light or weight, by the parts of the BRDF.
struct Reflected {
    Spectrum diffuse{0.0f}, lobe{0.0f};

    [[nodiscard]] Spectrum both() const { return diffuse + lobe; }
    Reflected& operator+=(const Reflected& other) {
        diffuse += other.diffuse;
        lobe += other.lobe;
        return *this;
    }
    [[nodiscard]] Reflected operator*(const Spectrum& s) const { return {diffuse * s, lobe * s}; }
};

/// A path from the eye, cut after the second surface so that its end can be shared.
struct EyePath {
    Spectrum emitted{0.0f};    ///< by the first surface, or the environment
    Spectrum direct{0.0f};     ///< light that it reflects of emitters, lights and environment
    Spectrum from_lobe{0.0f};  ///< light that it reflects of the second surface's lobe
    bool reflects = false;     ///< there is a first surface that reflects
    PathVertex first;
    /// Light that the second surface's diffuse part reflects, before the coupling to where it goes:
    /// the same for all who see it. Black where there is none.
    Spectrum from_second{0.0f};
    PathVertex second;
};

class PathTracer {
public:
    /// Keeps references. \param max_bounces reflections, 0 for no limit
    PathTracer(const SurfaceMesh& mesh, const Lighting& lighting, int max_bounces);

    /// Nothing shines.
    [[nodiscard]] bool dark() const;
    [[nodiscard]] EyePath start(const Ray& ray, PixelSampler& random) const;
    /// Radiance that a vertex reflects after `bounces` reflections before it, by parts.
    [[nodiscard]] Reflected reflected(const PathVertex& v, int bounces, PixelSampler& random) const;
    [[nodiscard]] bool sees(const PathVertex& a, const PathVertex& b) const {
        return !rays_.occluded(a.point, a.normal, b.point, b.normal);
    }

private:
    /// A direction of the BRDF: its value times the cosine over its density, and what it meets.
    struct Scattered {
        glm::dvec3 direction{0.0};
        Reflected weight;
        double density = 0.0;  ///< per solid angle; 0 where the path ends
        Hit next;
    };
    struct Step {
        Reflected light;  ///< of emitters, lights and environment
        Scattered on;
    };

    [[nodiscard]] const Material& material(const Hit& hit) const;
    [[nodiscard]] Spectrum emission(const Hit& hit) const;
    [[nodiscard]] PathVertex vertex_at(const Hit& hit, const glm::dvec3& direction) const;
    [[nodiscard]] bool escapes(const PathVertex& v, const glm::dvec3& direction) const;
    [[nodiscard]] Ray ray_from(const PathVertex& v, const glm::dvec3& direction) const;
    [[nodiscard]] Reflected from_emitter(const PathVertex& v, glm::vec2 u) const;
    [[nodiscard]] Reflected from_environment(const PathVertex& v, glm::vec2 u) const;
    [[nodiscard]] Reflected from_lights(const PathVertex& v, float u) const;
    [[nodiscard]] Reflected unoccluded(const PathVertex& v, const PunctualLight& light) const;
    [[nodiscard]] bool reaches(const PunctualLight& light, const PathVertex& v) const;
    [[nodiscard]] Scattered scatter(const PathVertex& v, PixelSampler& random) const;
    [[nodiscard]] Spectrum met_by(const Scattered& on) const;
    [[nodiscard]] Step step(const PathVertex& v, PixelSampler& random) const;
    [[nodiscard]] Spectrum follow(PathVertex v, Spectrum weight, int bounces,
                                  PixelSampler& random) const;

    const SurfaceMesh& mesh_;
    const Lighting& lighting_;
    std::vector<Facet> facets_;
    EmitterSampler emitters_;
    EnvironmentSampler environment_;
    RayTracer rays_;
    int max_bounces_;
};

}  // namespace transillum
