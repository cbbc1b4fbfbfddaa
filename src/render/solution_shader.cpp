#include "render/solution_shader.h"

#include "render/surface_at.h"

#include <algorithm>

namespace transillum {

namespace {

constexpr int most_mirrors = 16, last_sure_mirror = 4;
constexpr float highest_survival = 0.95f;

bool survives(Spectrum& weight, int mirrors, PixelSampler& random) {
    if (mirrors <= last_sure_mirror) return true;
    const float chance = std::min(max_channel(weight), highest_survival);
    if (random.next() >= chance) return false;
    weight /= chance;
    return true;
}

}  // namespace

SolutionShader::SolutionShader(const Solution& solution, const RenderOptions& options,
                               const Workers& workers)
    : solution_(solution),
      facets_(facets_of(solution.surface)),
      rays_(solution.surface),
      direct_(solution, rays_) {
    const Components& c = options.components;
    const VertexGrid* const grid = options.interpolate ? &grid_ : nullptr;
    if (grid) grid_ = build_vertex_grid(solution.surface, solution.patches);
    const bool has_glossy = !solution.glossy.empty();
    const bool monte_carlo = has_glossy && options.monte_carlo != MonteCarloShading::off;
    rays_from_eye_ = options.monte_carlo == MonteCarloShading::rays;
    if (has_glossy) {
        using enum GlossyField::Interpolation;
        glossy_ = GlossyField(solution, grid, monte_carlo ? planar : smooth);
    }
    const bool stored_direct = c.direct && options.direct == DirectShading::stored;
    if (has_glossy && (stored_direct || monte_carlo))
        direct_.prepare_stored(grid, &glossy_.stencils(), workers);
    if (c.direct && options.direct == DirectShading::traced) {
        if (grid)
            direct_.find_shadow_edges(*grid, workers);
        else
            direct_.find_shadow_edges(build_vertex_grid(solution.surface, solution.patches),
                                      workers);
    }
    shown_lambert_ = LambertField(solution, grid, {stored_direct, c.finite_element}, workers);
    shown_ = {c.emission, c.direct, c.finite_element, monte_carlo, options.direct, &shown_lambert_};
    if (monte_carlo) whole_lambert_ = LambertField(solution, grid, {}, workers);
    whole_ = {true, true, true, true, DirectShading::stored, &whole_lambert_};
}

Sight SolutionShader::look(const Ray& ray, Wanted wanted, PixelSampler& random) const {
    Sight sight;
    const Hit hit = rays_.intersect(ray);
    if (!hit) {
        const Spectrum background = solution_.lighting.environment.radiance(ray.direction);
        sight.emits = max_channel(background) > 0.0f;
        if (shown_.emission) sight.steady = background;
        return sight;
    }
    const Spectrum emitted = emission(hit);
    sight.emits = max_channel(emitted) > 0.0f;
    const SurfacePoint p = point_at(hit, ray.direction);
    sight.has_chance = p.is_sharp || (rays_from_eye_ && p.side && p.has_lobe());
    if (wanted.steady) sight.steady = shade(p, shown_) + (shown_.emission ? emitted : Spectrum(0));
    if (wanted.by_chance && sight.has_chance)
        sight.by_chance = p.is_sharp ? mirrored(p, shown_, random) : difference(p, random);
    return sight;
}

std::optional<SolutionShader::Seen> SolutionShader::meet(const Ray& ray) const {
    const Hit hit = rays_.intersect(ray);
    if (!hit) return std::nullopt;
    return Seen{hit, point_at(hit, ray.direction)};
}

SurfacePoint SolutionShader::point_at(const Hit& hit, const glm::dvec3& direction) const {
    const SurfaceMesh& mesh = solution_.surface;
    const PatchHierarchy& patches = solution_.patches;
    SurfacePoint p;
    p.leaf = patches.leaf_at(hit.root, hit.b1, hit.b2);
    p.patch = hit.back ? patches.leaf_count + p.leaf : p.leaf;
    const Facet& facet = facets_[hit.root];
    p.position = facet.point(hit.b1, hit.b2);
    p.normal = facet.side_normal(hit.back);
    const Material& material = mesh.materials[mesh.triangles[hit.root].material];
    if (hit.back && !material.back_reflects) return p;
    p.within = within_leaf(patches, p.leaf, hit);
    p.brdf = brdf_at(mesh, hit.root, hit.b1, hit.b2);
    if (!solution_.glossy.empty()) p.side = solution_.glossy.find(hit.root, hit.back);
    if (!p.has_lobe()) {
        p.world_from_local[2] = p.normal;
        return p;
    }
    p.is_sharp = is_sharper_than_bins(p.brdf);
    p.world_from_local =
        p.side ? glossy_.world_from_local(*p.side) : glm::mat3(bin_frame(p.normal));
    p.out = p.local(-direction);
    return p;
}

Spectrum SolutionShader::emission(const Hit& hit) const {
    const SurfaceMesh& mesh = solution_.surface;
    const Material& m = mesh.materials[mesh.triangles[hit.root].material];
    if (!m.emits() || (hit.back && !m.back_emits)) return Spectrum(0.0f);
    return emission_at(mesh, hit.root, hit.b1, hit.b2);
}

bool SolutionShader::is_shot(const Hit& hit) const {
    const std::vector<std::uint8_t>& shot = solution_.direct.shot_sides;
    return !shot.empty() && shot[2 * hit.root + (hit.back ? 1 : 0)] != 0;
}

Spectrum SolutionShader::shade(const SurfacePoint& p, const Manner& manner) const {
    Spectrum sum(0.0f);
    if (max_channel(p.brdf.diffuse) > 0.0f)
        sum += p.brdf.diffuse * diffuse_coupling(p.brdf, p.out.z) * manner.lambert->at(p);
    if (manner.direct) sum += direct(p, manner);
    if (manner.finite_element && p.side && p.has_lobe() && !p.is_sharp) sum += glossy_.reflected(p);
    return sum;
}

/// But for what the Lambert field holds of it.
Spectrum SolutionShader::direct(const SurfacePoint& p, const Manner& manner) const {
    if (manner.shading == DirectShading::stored) return p.side ? direct_.stored(p) : Spectrum(0.0f);
    if (!p.has_lobe() && !(max_channel(p.brdf.diffuse) > 0.0f)) return Spectrum(0.0f);
    return direct_.traced(p);
}

SolutionShader::Scattered SolutionShader::scatter(const SurfacePoint& p,
                                                  PixelSampler& random) const {
    const Brdf lobe = p.lobe();
    const glm::vec3 in = sample_direction(lobe, p.out, 0.0f, random.next_pair());
    const float density = direction_density(lobe, in, p.out);
    if (!(density > 0.0f)) return {};
    return {evaluate_lobe(lobe, in, p.out) * (in.z / density),
            {p.position + rays_.clearance(p.position) * p.normal, p.world(in)}};
}

Spectrum SolutionShader::mirrored(SurfacePoint p, const Manner& manner,
                                  PixelSampler& random) const {
    Spectrum sum(0.0f), weight(1.0f);
    for (int mirrors = 1; mirrors <= most_mirrors; ++mirrors) {
        const Scattered on = scatter(p, random);
        weight *= on.weight;
        if (!(max_channel(weight) > 0.0f) || !survives(weight, mirrors, random)) break;
        const Hit hit = rays_.intersect(on.ray);
        if (!hit) {
            if (manner.emission)
                sum += weight * solution_.lighting.environment.radiance(on.ray.direction);
            break;
        }
        if (manner.emission) sum += weight * emission(hit);
        p = point_at(hit, on.ray.direction);
        sum += weight * shade(p, manner);
        if (!p.is_sharp) {
            if (manner.monte_carlo && p.side && p.has_lobe()) sum += weight * difference(p, random);
            break;
        }
    }
    return sum;
}

Spectrum SolutionShader::difference(const SurfacePoint& p, PixelSampler& random) const {
    const Scattered on = scatter(p, random);
    if (!(max_channel(on.weight) > 0.0f)) return Spectrum(0.0f);
    return on.weight * (arriving(on.ray, random) - glossy_.incoming(p, on.ray.direction));
}

/// Light that the iteration would bring along a ray: the first shot brings the rest.
Spectrum SolutionShader::arriving(const Ray& ray, PixelSampler& random) const {
    const Hit hit = rays_.intersect(ray);
    if (!hit) return solution_.lighting.environment.radiance(ray.direction);
    const SurfacePoint p = point_at(hit, ray.direction);
    Spectrum sum = is_shot(hit) ? Spectrum(0.0f) : emission(hit);
    sum += shade(p, whole_);
    if (p.is_sharp) return sum + mirrored(p, whole_, random);
    if (!p.side || !p.has_lobe()) return sum;
    // The finite elements there are as wrong as here.
    const float chance = std::min(max_channel(lobe_albedo(p.brdf, p.out.z)), highest_survival);
    if (random.next() < chance) sum += difference(p, random) / chance;
    return sum;
}

}  // namespace transillum
