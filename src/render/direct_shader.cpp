#include "render/direct_shader.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

namespace transillum {

namespace {

constexpr std::uint32_t no_row = 0xffffffffu;

double diameter_of(const SurfaceMesh& mesh) {
    if (mesh.positions.empty()) return 0.0;
    glm::dvec3 low = mesh.positions.front(), high = low;
    for (const glm::dvec3& p : mesh.positions) {
        low = glm::min(low, p);
        high = glm::max(high, p);
    }
    return glm::length(high - low);
}

/// BRDF times cosine. The light of surfaces is met by the rays that follow a sharp lobe.
Spectrum reflected_share(const SurfacePoint& p, const LightSample& light,
                         const glm::dvec3& direction, double cosine) {
    if (!p.has_lobe())
        return evaluate_diffuse(p.brdf, {0, 0, 1}, {0, 0, 1}) * static_cast<float>(cosine);
    const glm::vec3 in = p.local(direction);
    if (!(in.z > 0.0f)) return Spectrum(0.0f);
    const bool diffuse_only = p.is_sharp && light.kind == LightSample::Kind::area;
    return in.z *
           (diffuse_only ? evaluate_diffuse(p.brdf, in, p.out) : evaluate(p.brdf, in, p.out));
}

}  // namespace

DirectShader::DirectShader(const Solution& solution, const RayTracer& rays)
    : solution_(solution), rays_(rays), beyond_(1.01 * diameter_of(solution.surface)) {}

bool DirectShader::sees(const SurfacePoint& p, const LightSample& light) const {
    switch (light.kind) {
        case LightSample::Kind::area:
            return !rays_.occluded(p.position, p.normal, light.position, light.normal);
        case LightSample::Kind::point:
            return !rays_.occluded(p.position, p.normal, light.position, glm::dvec3(0.0));
        case LightSample::Kind::directional:
            return !rays_.occluded(p.position, p.normal, p.position - beyond_ * light.normal,
                                   glm::dvec3(0.0));
    }
    return false;
}

/// \param seen next(i): number of the first sample from i on that may arrive; share(i) of it that
/// does
template <class Seen>
Spectrum DirectShader::sum_over_samples(const SurfacePoint& p, Seen seen) const {
    Spectrum sum(0.0f);
    const std::size_t n = solution_.direct.samples.size();
    for (std::size_t i = seen.next(0); i < n; i = seen.next(i + 1)) {
        const LightSample& light = solution_.direct.samples[i];
        const Incident arriving = incident_light(light, solution_.lighting, p.position);
        const double cosine = glm::dot(p.normal, arriving.direction);
        if (!(cosine > 0.0 && max_channel(arriving.irradiance) > 0.0f)) continue;
        const Spectrum reflected = reflected_share(p, light, arriving.direction, cosine);
        if (max_channel(reflected) > 0.0f) sum += seen.share(i) * reflected * arriving.irradiance;
    }
    return sum;
}

Spectrum DirectShader::traced(const SurfacePoint& p) const {
    struct Traced {
        const DirectShader& shader;
        const SurfacePoint& p;
        static std::size_t next(std::size_t i) { return i; }
        [[nodiscard]] float share(std::size_t i) const {
            return shader.sees(p, shader.solution_.direct.samples[i]) ? 1.0f : 0.0f;
        }
    };
    return sum_over_samples(p, Traced{*this, p});
}

void DirectShader::prepare_stored(const VertexGrid* grid, const VertexStencils* stencils,
                                  const Workers& workers) {
    const DirectLight& light = solution_.direct;
    const std::size_t n = light.samples.size();
    if (!grid || !stencils || n == 0) return;
    grid_ = grid;
    std::uint32_t rows = 0;
    first_row_.assign(2 * grid->vertex_count(), no_row);
    for (std::uint32_t i = 0; i < first_row_.size(); ++i)
        if (!stencils->at(i / 2, i % 2 != 0).empty()) first_row_[i] = rows++;
    vertex_visibility_.resize(rows * n);
    workers.for_ranges(first_row_.size(), 256, [&](std::size_t from, std::size_t to, int) {
        std::vector<float> seen(n), faced(n);
        for (std::size_t v = from; v < to; ++v) {
            if (first_row_[v] == no_row) continue;
            seen.assign(n, 0.0f);
            faced.assign(n, 0.0f);
            for (const VertexStencils::Entry& e :
                 stencils->at(static_cast<std::uint32_t>(v / 2), v % 2 != 0))
                for (std::size_t i = 0; i < n; ++i) {
                    if (!(light.geometry_factor[e.patch * n + i] > 0.0f)) continue;
                    seen[i] += e.weight * light.visibility[e.patch * n + i];
                    faced[i] += e.weight;
                }
            for (std::size_t i = 0; i < n; ++i)
                vertex_visibility_[first_row_[v] * n + i] = static_cast<std::uint8_t>(
                    faced[i] > 0.0f ? std::lround(255.0f * std::min(1.0f, seen[i] / faced[i])) : 0);
        }
    });
}

Spectrum DirectShader::stored(const SurfacePoint& p) const {
    const std::size_t n = solution_.direct.samples.size();
    if (n == 0) return Spectrum(0.0f);
    struct Patch {
        const float* visibility;
        static std::size_t next(std::size_t i) { return i; }
        [[nodiscard]] float share(std::size_t i) const { return visibility[i]; }
    };
    if (!grid_) return sum_over_samples(p, Patch{&solution_.direct.visibility[p.patch * n]});
    struct Interpolated {
        std::array<const std::uint8_t*, 3> rows;
        glm::vec3 weights;
        std::size_t count;
        /// Most samples are seen from nowhere near: they are passed over eight at a time.
        [[nodiscard]] std::size_t next(std::size_t i) const {
            for (; i + 8 <= count; i += 8) {
                std::array<std::uint64_t, 3> eight;
                for (int c = 0; c < 3; ++c) std::memcpy(&eight[c], rows[c] + i, 8);
                if ((eight[0] | eight[1] | eight[2]) != 0) break;
            }
            while (i < count && (rows[0][i] | rows[1][i] | rows[2][i]) == 0) ++i;
            return i;
        }
        [[nodiscard]] float share(std::size_t i) const {
            return std::max(0.0f, weights.x * static_cast<float>(rows[0][i]) +
                                      weights.y * static_cast<float>(rows[1][i]) +
                                      weights.z * static_cast<float>(rows[2][i]));
        }
    };
    Interpolated seen{{}, p.within / 255.0f, n};
    for (int c = 0; c < 3; ++c) {
        const std::uint32_t vertex = grid_->leaf_vertices[p.leaf][c];
        seen.rows[c] =
            &vertex_visibility_[first_row_[2 * vertex + (p.patch == p.leaf ? 0 : 1)] * n];
    }
    return sum_over_samples(p, seen);
}

}  // namespace transillum
