#include "render/path_tracer.h"

#include "render/surface_at.h"

#include <algorithm>
#include <cmath>

namespace transillum {

namespace {

constexpr int first_roulette_bounce = 3;
constexpr float roulette_weight = 0.25f;   // measured: playing earlier doubles the variance
constexpr float highest_survival = 0.97f;  // keeps paths finite between white walls

float power_heuristic(double chosen, double other) {
    if (!(other > 0.0)) return 1.0f;
    return static_cast<float>(chosen * chosen / (chosen * chosen + other * other));
}

/// Russian roulette, by what the path carries on.
bool survives(Spectrum& weight, float strength, int bounce, PixelSampler& random) {
    if (!(strength > 0.0f)) return false;
    if (bounce < first_roulette_bounce) return true;
    const float chance = std::min(strength / roulette_weight, highest_survival);
    if (random.next() >= chance) return false;
    weight /= chance;
    return true;
}

/// Value times cosine.
Reflected reflect(const PathVertex& v, const glm::vec3& in) {
    const float cosine = std::max(0.0f, in.z);
    return {evaluate_diffuse(v.brdf, in, v.out) * cosine,
            evaluate_lobe(v.brdf, in, v.out) * cosine};
}

bool is_black(const Reflected& r) {
    return !(max_channel(r.both()) > 0.0f);
}

Spectrum ratio(const Spectrum& part, const Spectrum& whole) {
    Spectrum r(0.0f);
    for (int c = 0; c < channel_count; ++c)
        if (whole[c] > 0.0f) r[c] = part[c] / whole[c];
    return r;
}

}  // namespace

PathVertex::PathVertex(const glm::dvec3& point, const glm::dvec3& normal, const Brdf& brdf,
                       const glm::dvec3& out)
    : point(point), normal(normal), frame(frame_about(normal)), brdf(brdf), out(local(out)) {}

glm::vec3 PathVertex::local(const glm::dvec3& direction) const {
    return glm::vec3(direction) * frame;
}

PathTracer::PathTracer(const SurfaceMesh& mesh, const Lighting& lighting, int max_bounces)
    : mesh_(mesh),
      lighting_(lighting),
      facets_(facets_of(mesh)),
      emitters_(mesh, facets_),
      environment_(lighting.environment),
      rays_(mesh),
      max_bounces_(max_bounces) {}

bool PathTracer::dark() const {
    return emitters_.empty() && lighting_.lights.empty() && !lighting_.environment.shines();
}

EyePath PathTracer::start(const Ray& ray, PixelSampler& random) const {
    EyePath path;
    const Hit hit = rays_.intersect(ray);
    if (!hit) {
        path.emitted = lighting_.environment.radiance(ray.direction);
        return path;
    }
    path.emitted = emission(hit);
    path.first = vertex_at(hit, ray.direction);
    path.reflects = max_channel(directional_albedo(path.first.brdf, path.first.out.z)) > 0.0f;
    if (!path.reflects) return path;
    const Step first = step(path.first, random);
    path.direct = first.light.both();
    if (!first.on.next || max_bounces_ == 1) return path;
    path.second = vertex_at(first.on.next, first.on.direction);
    const Reflected second = reflected(path.second, 1, random);
    path.from_lobe = first.on.weight.both() * second.lobe;
    path.from_second = second.diffuse;
    return path;
}

Reflected PathTracer::reflected(const PathVertex& v, int bounces, PixelSampler& random) const {
    const Step here = step(v, random);
    Reflected sum = here.light;
    if (here.on.next && bounces + 1 != max_bounces_) {
        const Spectrum weight = here.on.weight.both();
        const Spectrum further =
            follow(vertex_at(here.on.next, here.on.direction), weight, bounces + 1, random);
        sum += {further * ratio(here.on.weight.diffuse, weight),
                further * ratio(here.on.weight.lobe, weight)};
    }
    // The coupling to where it goes is the viewer's.
    const float coupling = diffuse_coupling(v.brdf, v.out.z);
    sum.diffuse = coupling > 0.0f ? sum.diffuse / coupling : Spectrum(0.0f);
    return sum;
}

/// Radiance that a vertex reflects, times the weight with which it is seen.
Spectrum PathTracer::follow(PathVertex v, Spectrum weight, int bounces,
                            PixelSampler& random) const {
    Spectrum sum(0.0f);
    for (int bounce = bounces;; ++bounce) {
        const float strength = max_channel(weight * directional_albedo(v.brdf, v.out.z));
        if (!survives(weight, strength, bounce, random)) return sum;
        const Step here = step(v, random);
        sum += weight * here.light.both();
        if (!here.on.next || bounce + 1 == max_bounces_) return sum;
        weight *= here.on.weight.both();
        v = vertex_at(here.on.next, here.on.direction);
    }
}

const Material& PathTracer::material(const Hit& hit) const {
    return mesh_.materials[mesh_.triangles[hit.root].material];
}

Spectrum PathTracer::emission(const Hit& hit) const {
    const Material& m = material(hit);
    if (!m.emits() || (hit.back && !m.back_emits)) return Spectrum(0.0f);
    return emission_at(mesh_, hit.root, hit.b1, hit.b2);
}

PathVertex PathTracer::vertex_at(const Hit& hit, const glm::dvec3& direction) const {
    const Facet& f = facets_[hit.root];
    const bool black = hit.back && !material(hit).back_reflects;
    return {f.point(hit.b1, hit.b2), f.side_normal(hit.back),
            black ? Brdf{} : brdf_at(mesh_, hit.root, hit.b1, hit.b2), -direction};
}

Ray PathTracer::ray_from(const PathVertex& v, const glm::dvec3& direction) const {
    return {v.point + rays_.clearance(v.point) * v.normal, direction};
}

bool PathTracer::escapes(const PathVertex& v, const glm::dvec3& direction) const {
    return !rays_.intersect(ray_from(v, direction));
}

/// Light sampling's share.
Reflected PathTracer::from_emitter(const PathVertex& v, glm::vec2 u) const {
    const EmitterPoint light = emitters_.sample(u);
    const glm::dvec3 way = light.position - v.point;
    const double distance2 = glm::dot(way, way);
    const glm::dvec3 direction = way / std::sqrt(distance2);
    const double cos_there = -glm::dot(light.normal, direction);
    if (!(cos_there > 0.0 && glm::dot(v.normal, direction) > 0.0)) return {};
    const glm::vec3 in = v.local(direction);
    const Reflected value = reflect(v, in);
    if (is_black(value) || rays_.occluded(v.point, v.normal, light.position, light.normal))
        return {};
    const double density = light.density * distance2 / cos_there;
    const float share = power_heuristic(density, direction_density(v.brdf, in, v.out));
    return value * (light.radiance * (share / static_cast<float>(density)));
}

Reflected PathTracer::from_environment(const PathVertex& v, glm::vec2 u) const {
    const glm::dvec3 direction = environment_.sample(u);
    if (!(glm::dot(v.normal, direction) > 0.0)) return {};
    const glm::vec3 in = v.local(direction);
    const Reflected value = reflect(v, in);
    if (is_black(value) || !escapes(v, direction)) return {};
    const double density = environment_.density(direction);
    if (!(density > 0.0)) return {};
    const float share = power_heuristic(density, direction_density(v.brdf, in, v.out));
    return value *
           (lighting_.environment.radiance(direction) * (share / static_cast<float>(density)));
}

Reflected PathTracer::unoccluded(const PathVertex& v, const PunctualLight& light) const {
    if (light.kind == PunctualLight::Kind::directional)
        return reflect(v, v.local(-light.direction)) * light.intensity;
    const glm::dvec3 way = light.position - v.point;
    const double distance2 = glm::dot(way, way);
    if (!(distance2 > 0.0)) return {};
    const glm::dvec3 direction = way / std::sqrt(distance2);
    return reflect(v, v.local(direction)) *
           (light.intensity_towards(-direction) / static_cast<float>(distance2));
}

bool PathTracer::reaches(const PunctualLight& light, const PathVertex& v) const {
    if (light.kind == PunctualLight::Kind::directional) return escapes(v, -light.direction);
    return !rays_.occluded(v.point, v.normal, light.position, glm::dvec3(0.0));
}

/// One of the lights, picked while they are gone through, with a chance in proportion to what it
/// adds.
Reflected PathTracer::from_lights(const PathVertex& v, float u) const {
    double total = 0.0, rest = u, chosen_strength = 0.0;
    const PunctualLight* chosen = nullptr;
    Reflected value;
    for (const PunctualLight& light : lighting_.lights) {
        const Reflected here = unoccluded(v, light);
        const double strength = mean_channel(here.both());
        if (!(strength > 0.0)) continue;
        total += strength;
        const double chance = strength / total;
        if (rest < chance) {
            rest /= chance;
            chosen = &light;
            chosen_strength = strength;
            value = here;
        } else {
            rest = (rest - chance) / (1.0 - chance);
        }
    }
    if (!chosen || !reaches(*chosen, v)) return {};
    return value * Spectrum(static_cast<float>(total / chosen_strength));
}

PathTracer::Scattered PathTracer::scatter(const PathVertex& v, PixelSampler& random) const {
    Scattered s;
    const glm::vec2 u = random.next_pair();
    const float choice = v.brdf.lobe == Lobe::none ? 0.0f : random.next();
    const glm::vec3 in = sample_direction(v.brdf, v.out, choice, u);
    const float density = direction_density(v.brdf, in, v.out);
    if (!(density > 0.0f)) return s;
    s.density = density;
    s.weight = reflect(v, in) * Spectrum(1.0f / density);
    s.direction = glm::normalize(glm::dvec3(v.frame * in));
    s.next = rays_.intersect(ray_from(v, s.direction));
    return s;
}

/// Direction sampling's share of the light along a direction.
Spectrum PathTracer::met_by(const Scattered& on) const {
    if (!on.next) {
        if (!(on.density > 0.0) || !lighting_.environment.shines()) return Spectrum(0.0f);
        return lighting_.environment.radiance(on.direction) *
               power_heuristic(on.density, environment_.density(on.direction));
    }
    const Spectrum emitted = emission(on.next);
    if (!(max_channel(emitted) > 0.0f)) return Spectrum(0.0f);
    const double cos_there = std::abs(glm::dot(facets_[on.next.root].normal, on.direction));
    const double distance2 = static_cast<double>(on.next.distance) * on.next.distance;
    return emitted * power_heuristic(on.density * cos_there,
                                     emitters_.density(on.next.root, on.next.back) * distance2);
}

PathTracer::Step PathTracer::step(const PathVertex& v, PixelSampler& random) const {
    Step step;
    if (!emitters_.empty()) step.light += from_emitter(v, random.next_pair());
    if (!environment_.empty()) step.light += from_environment(v, random.next_pair());
    if (!lighting_.lights.empty()) step.light += from_lights(v, random.next());
    step.on = scatter(v, random);
    step.light += step.on.weight * met_by(step.on);
    return step;
}

}  // namespace transillum
