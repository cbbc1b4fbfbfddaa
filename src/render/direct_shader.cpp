#include "render/direct_shader.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <numbers>

namespace transillum {

namespace {

constexpr std::uint32_t no_row = 0xffffffffu;
/// A patch that a light reaches may have its centre a little behind the light's horizon.
constexpr float least_cosine = 0.02f;

double diameter_of(const SurfaceMesh& mesh) {
    if (mesh.positions.empty()) return 0.0;
    glm::dvec3 low = mesh.positions.front(), high = low;
    for (const glm::dvec3& p : mesh.positions) {
        low = glm::min(low, p);
        high = glm::max(high, p);
    }
    return glm::length(high - low);
}

bool is_of_surface(const LightSample& light) {
    return light.kind == LightSample::Kind::area;
}

bool reflects(const SurfacePoint& p, const glm::vec3& in, const Spectrum& irradiance,
              bool of_surface) {
    return max_channel(reflected(p, in, irradiance, of_surface)) > 0.0f;
}

auto add_to(ReflectedSum& sum) {
    return [&sum](const glm::vec3& in, const Spectrum& irradiance, bool of_surface) {
        sum.add(in, irradiance, of_surface);
    };
}

glm::vec3 raised(glm::vec3 direction) {
    const float length = glm::length(direction);
    if (!(length > 0.0f)) return {0.0f, 0.0f, 1.0f};
    direction /= length;
    direction.z = std::max(direction.z, least_cosine);
    return glm::normalize(direction);
}

/// Of eight bytes that are not all zero, a bit each at its highest place.
std::uint64_t nonzero_bytes(std::uint64_t eight) {
    constexpr std::uint64_t low = 0x7f7f7f7f7f7f7f7fu;
    return (((eight & low) + low) | eight) & ~low;
}

}  // namespace

DirectShader::DirectShader(const Solution& solution, const RayTracer& rays)
    : solution_(solution),
      rays_(rays),
      beyond_(1.01 * diameter_of(solution.surface)),
      shadow_edges_(solution.direct) {
    for (const LightSample& s : solution.direct.samples)
        emitters_.push_back({s.position, glm::vec3(s.normal),
                             s.emitted * static_cast<float>(s.area),
                             static_cast<float>(s.area * std::numbers::inv_pi)});
}

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

/// Calls use(in, irradiance, of_surface), as reflected wants them, if anything arrives. A result
/// would be passed through memory for every sample.
/// \param share of the sample that is seen
template <class Use>
void DirectShader::use_sample(const SurfacePoint& p, std::size_t sample, float share,
                              Use use) const {
    if (!(share > 0.0f)) return;
    const LightSample& light = solution_.direct.samples[sample];
    if (!is_of_surface(light)) {
        const Incident arriving = incident_light(light, solution_.lighting, p.position);
        const glm::vec3 in = p.local(arriving.direction);
        const Spectrum irradiance = share * in.z * arriving.irradiance;
        if (max_channel(irradiance) > 0.0f) use(in, irradiance, false);
        return;
    }
    // As incident_light, but that nothing after the difference needs double precision.
    const Emitter& emitter = emitters_[sample];
    const glm::vec3 way(emitter.position - p.position);
    const glm::vec3 in = way * p.world_from_local;
    const float cosine = -glm::dot(emitter.normal, way);
    if (!(in.z > 0.0f && cosine > 0.0f)) return;
    const float squared = 1.0f / glm::dot(way, way);
    // Seen from near by, its piece is a disc, not a point.
    const float from_disc = 1.0f / (glm::dot(way, way) + emitter.squared_radius);
    use(std::sqrt(squared) * in, emitter.intensity * (share * cosine * in.z * squared * from_disc),
        true);
}

void DirectShader::find_shadow_edges(const VertexGrid& grid, const Workers& workers) {
    if (!solution_.direct.has_vectors()) shadow_edges_ = ShadowEdges(solution_, grid, workers);
}

Spectrum DirectShader::traced(const SurfacePoint& p) const {
    ReflectedSum sum(p);
    const bool has_diffuse = max_channel(p.brdf.diffuse) > 0.0f;
    for (std::size_t word = 0; word < shadow_edges_.words(); ++word) {
        const ShadowEdges::Word& edges = shadow_edges_.at(p.patch, word);
        for (std::uint64_t left = edges.seen | edges.doubtful; left != 0; left &= left - 1) {
            const bool is_doubtful = ((left & -left) & edges.doubtful) != 0;
            const std::size_t i = word * ShadowEdges::samples_a_word +
                                  static_cast<std::size_t>(std::countr_zero(left));
            use_sample(p, i, 1.0f, [&](const glm::vec3& in, const Spectrum& e, bool of_surface) {
                // No ray for what isn't reflected.
                if (is_doubtful && ((!has_diffuse && !reflects(p, in, e, of_surface)) ||
                                    !sees(p, solution_.direct.samples[i])))
                    return;
                sum.add(in, e, of_surface);
            });
        }
    }
    return sum.total();
}

void DirectShader::prepare_stored(const VertexGrid* grid, const VertexStencils* stencils,
                                  const Workers& workers) {
    const DirectLight& light = solution_.direct;
    if (!grid || !stencils || light.columns() == 0) return;
    grid_ = grid;
    std::uint32_t rows = 0;
    first_row_.assign(2 * grid->vertex_count(), no_row);
    for (std::uint32_t i = 0; i < first_row_.size(); ++i)
        if (!stencils->at(i / 2, i % 2 != 0).empty()) first_row_[i] = rows++;
    if (light.has_vectors()) {
        row_size_ = light.columns();
        vertex_vectors_.resize(rows * row_size_);
        average_vectors(*stencils, workers);
    } else {
        row_size_ = (light.columns() + 7) / 8 * 8;
        vertex_visibility_.resize(rows * row_size_);
        average_visibility(*stencils, workers);
    }
}

void DirectShader::average_visibility(const VertexStencils& stencils, const Workers& workers) {
    const DirectLight& light = solution_.direct;
    const std::size_t n = light.samples.size();
    workers.for_ranges(first_row_.size(), 256, [&](std::size_t from, std::size_t to, int) {
        std::vector<float> seen(n), faced(n);
        for (std::size_t v = from; v < to; ++v) {
            if (first_row_[v] == no_row) continue;
            seen.assign(n, 0.0f);
            faced.assign(n, 0.0f);
            for (const VertexStencils::Entry& e :
                 stencils.at(static_cast<std::uint32_t>(v / 2), v % 2 != 0))
                for (std::size_t i = 0; i < n; ++i) {
                    if (!(light.geometry_factor[e.patch * n + i] > 0.0f)) continue;
                    seen[i] += e.weight * light.visibility[e.patch * n + i];
                    faced[i] += e.weight;
                }
            for (std::size_t i = 0; i < n; ++i)
                vertex_visibility_[first_row_[v] * row_size_ + i] = static_cast<std::uint8_t>(
                    faced[i] > 0.0f ? std::lround(255.0f * std::min(1.0f, seen[i] / faced[i])) : 0);
        }
    });
}

void DirectShader::average_vectors(const VertexStencils& stencils, const Workers& workers) {
    workers.for_ranges(first_row_.size(), 256, [&](std::size_t from, std::size_t to, int) {
        for (std::size_t v = from; v < to; ++v) {
            if (first_row_[v] == no_row) continue;
            const auto entries = stencils.at(static_cast<std::uint32_t>(v / 2), v % 2 != 0);
            for (std::size_t i = 0; i < row_size_; ++i)
                vertex_vectors_[first_row_[v] * row_size_ + i] = average_vector(entries, i);
        }
    });
}

/// Of the patches that touch a vertex and face the light, in its shadow or not.
glm::vec3 DirectShader::average_vector(std::span<const VertexStencils::Entry> entries,
                                       std::size_t column) const {
    const auto vector_at = [&](const VertexStencils::Entry& e) {
        return solution_.direct.vectors[e.patch * row_size_ + column];
    };
    glm::vec3 sum(0.0f);
    for (const VertexStencils::Entry& e : entries) sum += e.weight * vector_at(e);
    const float length = glm::length(sum);
    if (!(length > 0.0f)) return glm::vec3(0.0f);
    // Patches that hardly face it know least of how bright it is, and count least.
    float facing = 0.0f;
    for (const VertexStencils::Entry& e : entries) {
        const GlossySide& side = solution_.glossy.sides[e.side];
        const glm::vec3 normal(normal_of(solution_.surface, side.root) * (side.back ? -1.0 : 1.0));
        const glm::vec3 vector = vector_at(e);
        const float own = glm::length(vector);
        facing += e.weight * (own > 0.0f ? std::max(least_cosine, glm::dot(normal, vector) / own)
                                         : std::max(0.0f, glm::dot(normal, sum) / length));
    }
    return sum / facing;
}

Spectrum DirectShader::stored(const SurfacePoint& p) const {
    if (solution_.direct.columns() == 0) return Spectrum(0.0f);
    ReflectedSum sum(p);
    if (solution_.direct.has_vectors())
        add_vectors(p, sum);
    else if (grid_)
        add_interpolated_samples(p, sum);
    else
        add_samples_of_patch(p, sum);
    return sum.total();
}

/// Where the rows of the leaf's corners begin.
std::array<std::size_t, 3> DirectShader::rows_of(const SurfacePoint& p) const {
    std::array<std::size_t, 3> rows;
    for (int c = 0; c < 3; ++c) {
        const std::size_t vertex = grid_->leaf_vertices[p.leaf][c];
        rows[c] = row_size_ * first_row_[2 * vertex + (p.patch == p.leaf ? 0 : 1)];
    }
    return rows;
}

void DirectShader::add_samples_of_patch(const SurfacePoint& p, ReflectedSum& sum) const {
    const std::size_t n = solution_.direct.samples.size();
    for (std::size_t i = 0; i < n; ++i)
        use_sample(p, i, solution_.direct.visibility[p.patch * n + i], add_to(sum));
}

/// Most samples are seen from nowhere near: they are passed over eight at a time.
void DirectShader::add_interpolated_samples(const SurfacePoint& p, ReflectedSum& sum) const {
    std::array<const std::uint8_t*, 3> rows;
    for (int c = 0; c < 3; ++c) rows[c] = vertex_visibility_.data() + rows_of(p)[c];
    const glm::vec3 weights = p.within / 255.0f;
    for (std::size_t first = 0; first < row_size_; first += 8) {
        std::array<std::uint64_t, 3> eight;
        for (int c = 0; c < 3; ++c) std::memcpy(&eight[c], rows[c] + first, 8);
        for (std::uint64_t seen = nonzero_bytes(eight[0] | eight[1] | eight[2]); seen != 0;
             seen &= seen - 1) {
            const std::size_t i = first + static_cast<std::size_t>(std::countr_zero(seen) / 8);
            const float share = weights.x * static_cast<float>(rows[0][i]) +
                                weights.y * static_cast<float>(rows[1][i]) +
                                weights.z * static_cast<float>(rows[2][i]);
            use_sample(p, i, share, add_to(sum));
        }
    }
}

void DirectShader::add_vectors(const SurfacePoint& p, ReflectedSum& sum) const {
    const DirectLight& light = solution_.direct;
    const std::size_t n = light.columns();
    const auto add = [&](std::size_t i, const glm::vec3& in, float share) {
        const LightSample& first = light.light(i);
        if (share > 0.0f) sum.add(raised(in), first.emitted * share, is_of_surface(first));
    };
    if (!grid_) {
        for (std::size_t i = 0; i < n; ++i) {
            const glm::vec3& vector = light.vectors[p.patch * n + i];
            add(i, vector * p.world_from_local, glm::length(vector));
        }
        return;
    }
    const auto rows = rows_of(p);
    for (std::size_t i = 0; i < n; ++i) {
        const glm::vec3 mixed = p.within.x * vertex_vectors_[rows[0] + i] +
                                p.within.y * vertex_vectors_[rows[1] + i] +
                                p.within.z * vertex_vectors_[rows[2] + i];
        const glm::vec3 in = mixed * p.world_from_local;
        add(i, in, in.z);
    }
}

}  // namespace transillum
