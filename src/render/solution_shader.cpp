#include "render/solution_shader.h"

#include <numbers>

namespace transillum {

namespace {

constexpr float inv_pi = std::numbers::inv_pi_v<float>;

std::vector<float> patch_areas(const Solution& solution) {
    std::vector<float> areas(solution.patches.patch_count());
    for (std::uint32_t patch = 0; patch < areas.size(); ++patch) {
        const std::uint32_t leaf = solution.patches.leaf_of_patch(patch);
        areas[patch] = static_cast<float>(area_of_leaf(solution.surface, solution.patches, leaf));
    }
    return areas;
}

/// Barycentric coordinates within a leaf from those within its root.
glm::vec3 within_leaf(const PatchHierarchy& patches, std::uint32_t leaf, const Hit& hit) {
    const auto [corners, level] = leaf_corners(patches, leaf);
    const auto n = static_cast<float>(1 << level);
    const glm::vec2 p = glm::vec2(hit.b1, hit.b2) * n - glm::vec2(corners[0]);
    const glm::vec2 u(corners[1] - corners[0]), v(corners[2] - corners[0]);
    const float whole = u.x * v.y - u.y * v.x;
    const float b1 = (p.x * v.y - p.y * v.x) / whole, b2 = (u.x * p.y - u.y * p.x) / whole;
    return {1.0f - b1 - b2, b1, b2};
}

}  // namespace

SolutionShader::SolutionShader(const Solution& solution, const RenderOptions& options,
                               const Workers& workers)
    : solution_(solution),
      options_(options),
      facets_(facets_of(solution.surface)),
      rays_(solution.surface) {
    if (!options.interpolate) return;
    grid_ = build_vertex_grid(solution.surface, solution.patches);
    if (options.components.finite_element)
        indirect_ = interpolated(solution.indirect_irradiance, solution.coverage, workers);
    if (options.components.direct && options.direct == DirectShading::stored)
        direct_ = interpolated(solution.direct_irradiance, patch_areas(solution), workers);
}

SolutionShader::VertexField SolutionShader::interpolated(const std::vector<Spectrum>& of_patches,
                                                         const std::vector<float>& weights,
                                                         const Workers& workers) const {
    const std::size_t leaves = solution_.patches.leaf_count;
    const std::span<const Spectrum> values(of_patches);
    const std::span<const float> w(weights);
    return {vertex_values(grid_, values.first(leaves), w.first(leaves), workers),
            vertex_values(grid_, values.last(leaves), w.last(leaves), workers)};
}

Sight SolutionShader::look(const Ray& ray) const {
    const Hit hit = rays_.intersect(ray);
    if (!hit) return {};
    const SurfaceMesh& surface = solution_.surface;
    const Material& material = surface.materials[surface.triangles[hit.root].material];
    const Spectrum emission = emission_of(material, hit.back),
                   albedo = albedo_of(material, hit.back);

    Sight sight{Spectrum(0.0f), max_channel(emission) > 0.0f};
    if (options_.components.emission) sight.radiance += emission;
    if (!(max_channel(albedo) > 0.0f)) return sight;
    Spectrum received(0.0f);
    if (options_.components.direct)
        received += options_.direct == DirectShading::traced
                        ? traced_irradiance(hit)
                        : irradiance(solution_.direct_irradiance, direct_, hit);
    if (options_.components.finite_element)
        received += irradiance(solution_.indirect_irradiance, indirect_, hit);
    sight.radiance += albedo * inv_pi * received;
    return sight;
}

Spectrum SolutionShader::irradiance(const std::vector<Spectrum>& of_patches,
                                    const VertexField& of_vertices, const Hit& hit) const {
    const PatchHierarchy& patches = solution_.patches;
    const std::uint32_t leaf = patches.leaf_at(hit.root, hit.b1, hit.b2);
    if (!options_.interpolate) return of_patches[hit.back ? patches.leaf_count + leaf : leaf];
    const std::vector<Spectrum>& values = of_vertices[hit.back ? 1 : 0];
    const auto& vertices = grid_.leaf_vertices[leaf];
    const glm::vec3 b = within_leaf(patches, leaf, hit);
    const Spectrum mixed =
        b.x * values[vertices[0]] + b.y * values[vertices[1]] + b.z * values[vertices[2]];
    // A hit may lie a rounding error outside its leaf.
    return glm::max(mixed, Spectrum(0.0f));
}

Spectrum SolutionShader::traced_irradiance(const Hit& hit) const {
    const glm::dvec3 point = facets_[hit.root].point(hit.b1, hit.b2);
    const glm::dvec3 normal = facets_[hit.root].side_normal(hit.back);
    Spectrum sum(0.0f);
    for (const LightSample& light : solution_.direct.samples) {
        const glm::dvec3 way = light.position - point;
        const double cos_here = glm::dot(normal, way), cos_there = -glm::dot(light.normal, way);
        if (!(cos_here > 0.0 && cos_there > 0.0)) continue;
        if (rays_.occluded(point, normal, light.position, light.normal)) continue;
        const double distance2 = glm::dot(way, way);
        sum += light.emitted *
               static_cast<float>(light.area * cos_here * cos_there / (distance2 * distance2));
    }
    return sum;
}

}  // namespace transillum
