#include "render/path_tracer.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace transillum {

namespace {

constexpr int first_roulette_bounce = 3;
constexpr float roulette_weight = 0.25f;   // measured: playing earlier doubles the variance
constexpr float highest_survival = 0.97f;  // keeps paths finite between white walls

float power_heuristic(double chosen, double other) {
    return static_cast<float>(chosen * chosen / (chosen * chosen + other * other));
}

/// Directions with density cos / pi, which cancels cosine and Lambert's 1 / pi.
glm::dvec3 sample_direction(const PathVertex& v, glm::vec2 u) {
    return glm::normalize(frame_about(v.normal) * cosine_direction(u.x, u.y));
}

/// Russian roulette.
bool survives(Spectrum& weight, int bounce, PixelSampler& random) {
    const float strength = max_channel(weight);
    if (!(strength > 0.0f)) return false;
    if (bounce < first_roulette_bounce) return true;
    const float chance = std::min(strength / roulette_weight, highest_survival);
    if (random.next() >= chance) return false;
    weight /= chance;
    return true;
}

}  // namespace

double coupling(const PathVertex& a, const PathVertex& b) {
    const glm::dvec3 way = b.point - a.point;
    const double cos_a = glm::dot(a.normal, way), cos_b = -glm::dot(b.normal, way);
    if (!(cos_a > 0.0 && cos_b > 0.0)) return 0.0;
    const double distance2 = glm::dot(way, way);
    return cos_a * cos_b / (distance2 * distance2);
}

PathTracer::PathTracer(const SurfaceMesh& mesh, int max_bounces)
    : mesh_(mesh),
      facets_(facets_of(mesh)),
      emitters_(mesh, facets_),
      rays_(mesh),
      max_bounces_(max_bounces) {}

EyePath PathTracer::start(const Ray& ray, PixelSampler& random) const {
    EyePath path;
    const Hit hit = rays_.intersect(ray);
    if (!hit) return path;
    path.emitted = emission_of(material(hit), hit.back);
    path.albedo = albedo_at(hit);
    if (!(max_channel(path.albedo) > 0.0f)) return path;
    path.first = vertex_at(hit);
    Hit next;
    path.direct = path.albedo * direct_light(path.first, random, next);
    if (!next || max_bounces_ == 1) return path;
    const Spectrum albedo = albedo_at(next);
    if (!(max_channel(albedo) > 0.0f)) return path;
    path.second = vertex_at(next);
    path.from_second = reflected(path.second, albedo, 1, random);
    return path;
}

Spectrum PathTracer::reflected(PathVertex v, Spectrum weight, int bounces,
                               PixelSampler& random) const {
    Spectrum sum(0.0f);
    for (int bounce = bounces + 1;; ++bounce) {
        Hit next;
        sum += weight * direct_light(v, random, next);
        if (!next || bounce == max_bounces_) return sum;
        weight *= albedo_at(next);
        if (!survives(weight, bounce, random)) return sum;
        v = vertex_at(next);
    }
}

const Material& PathTracer::material(const Hit& hit) const {
    return mesh_.materials[mesh_.triangles[hit.root].material];
}

Spectrum PathTracer::albedo_at(const Hit& hit) const {
    return albedo_of(material(hit), hit.back);
}

PathVertex PathTracer::vertex_at(const Hit& hit) const {
    const Facet& f = facets_[hit.root];
    return {f.point(hit.b1, hit.b2), f.side_normal(hit.back)};
}

Hit PathTracer::follow(const PathVertex& v, const glm::dvec3& direction) const {
    return rays_.intersect({v.point + rays_.clearance(v.point) * v.normal, direction});
}

/// Light sampling's share, per unit of albedo.
Spectrum PathTracer::from_emitter_sample(const PathVertex& v, glm::vec2 u) const {
    const EmitterPoint light = emitters_.sample(u);
    // Lambert's density of that direction, per area of the emitter.
    const PathVertex there{light.position, light.normal};
    const double by_direction = std::numbers::inv_pi * coupling(v, there);
    if (!(by_direction > 0.0) || !sees(v, there)) return Spectrum(0.0f);
    const float share = power_heuristic(light.density, by_direction);
    return light.radiance * (share * static_cast<float>(by_direction / light.density));
}

/// Direction sampling's share of what the surface met emits.
Spectrum PathTracer::emitted_along(const PathVertex& v, const glm::dvec3& direction,
                                   const Hit& hit) const {
    const Spectrum emission = emission_of(material(hit), hit.back);
    if (!(max_channel(emission) > 0.0f)) return emission;
    const double cos_there = std::abs(glm::dot(facets_[hit.root].normal, direction));
    const double distance2 = static_cast<double>(hit.distance) * hit.distance;
    const double by_direction =
        std::numbers::inv_pi * glm::dot(v.normal, direction) * cos_there / distance2;
    return emission * power_heuristic(by_direction, emitters_.density(emission));
}

/// Emitters' light that a white vertex reflects; finds the surface the path goes on to.
Spectrum PathTracer::direct_light(const PathVertex& v, PixelSampler& random, Hit& next) const {
    const Spectrum sampled = from_emitter_sample(v, random.next_pair());
    const glm::dvec3 direction = sample_direction(v, random.next_pair());
    next = follow(v, direction);
    return next ? sampled + emitted_along(v, direction, next) : sampled;
}

}  // namespace transillum
