#include "first_shot/light_vectors.h"

#include <transillum/base/error.h>
#include <transillum/base/sampling.h>
#include <transillum/first_shot/light_samples.h>
#include <transillum/geometry/leaf_means.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <map>
#include <numeric>
#include <string>

namespace transillum {

namespace {

struct EmittingSide {
    std::uint32_t root;
    bool back;
    double area;
};
using Luminaire = std::vector<EmittingSide>;

std::vector<EmittingSide> emitting_sides(const SurfaceMesh& mesh) {
    std::vector<EmittingSide> sides;
    for (std::uint32_t r = 0; r < mesh.triangles.size(); ++r) {
        const Material& m = mesh.materials[mesh.triangles[r].material];
        if (!m.emits()) continue;
        sides.push_back({r, false, area_of(mesh, r)});
        if (m.back_emits) sides.push_back({r, true, sides.back().area});
    }
    return sides;
}

/// Connects sides that share a vertex, a material and a face direction.
std::vector<Luminaire> find_luminaires(const SurfaceMesh& mesh) {
    const std::vector<EmittingSide> sides = emitting_sides(mesh);
    std::vector<std::uint32_t> parent(sides.size());
    std::iota(parent.begin(), parent.end(), 0u);
    const auto find = [&](std::uint32_t i) {
        while (parent[i] != i) i = parent[i] = parent[parent[i]];
        return i;
    };
    std::map<std::array<std::uint32_t, 3>, std::uint32_t> first_at;
    for (std::uint32_t i = 0; i < sides.size(); ++i) {
        const RootTriangle& t = mesh.triangles[sides[i].root];
        for (const std::uint32_t v : t.vertices) {
            const auto [at, is_new] =
                first_at.try_emplace({v, t.material, sides[i].back ? 1u : 0u}, i);
            if (is_new) continue;
            const std::uint32_t a = find(i), b = find(at->second);
            parent[std::max(a, b)] = std::min(a, b);
        }
    }
    std::map<std::uint32_t, Luminaire> groups;
    for (std::uint32_t i = 0; i < sides.size(); ++i) groups[find(i)].push_back(sides[i]);
    std::vector<Luminaire> luminaires;
    for (auto& [root, members] : groups) luminaires.push_back(std::move(members));
    return luminaires;
}

double area_of(const Luminaire& luminaire) {
    double area = 0.0;
    for (const EmittingSide& s : luminaire) area += s.area;
    return area;
}

/// Uniform in a triangle: the square folded along its diagonal keeps points that were even, even.
glm::dvec3 point_in(const SurfaceMesh& mesh, std::uint32_t root, double u, double v) {
    double b1 = u / 2.0, b2 = v - b1;
    if (v <= u) {
        b2 = v / 2.0;
        b1 = u - b2;
    }
    const auto& t = mesh.triangles[root].vertices;
    return (1.0 - b1 - b2) * mesh.positions[t[0]] + b1 * mesh.positions[t[1]] +
           b2 * mesh.positions[t[2]];
}

/// Of a textured root its mean, so that its flux is right.
Spectrum emission_of(const SurfaceMesh& mesh, std::uint32_t root) {
    const Material& m = mesh.materials[mesh.triangles[root].material];
    if (m.textures.emission < 0) return m.emission;
    const Texture& texture = *mesh.textures[static_cast<std::size_t>(m.textures.emission)];
    return texture.mean_over(
        {uv_at(mesh, root, 0, 0), uv_at(mesh, root, 1, 0), uv_at(mesh, root, 0, 1)});
}

void add_samples(const SurfaceMesh& mesh, const Luminaire& luminaire, int count, std::uint64_t seed,
                 std::vector<LightSample>& samples) {
    const double piece = area_of(luminaire) / count;
    auto side = luminaire.begin();
    double before = 0.0;  // area of the sides already passed
    for (int i = 0; i < count; ++i) {
        const double along = (i + 0.5) * piece;
        while (side + 1 != luminaire.end() && before + side->area < along) before += (side++)->area;
        const auto index = static_cast<std::uint32_t>(i);
        LightSample s;
        s.position =
            point_in(mesh, side->root, sobol_owen(index, 0, seed), sobol_owen(index, 1, seed));
        s.normal = normal_of(mesh, side->root) * (side->back ? -1.0 : 1.0);
        s.area = piece;
        s.emitted = emission_of(mesh, side->root);
        s.root = side->root;
        s.back = side->back;
        samples.push_back(s);
    }
}

void add_runs(const std::vector<LightSample>& samples, std::size_t begin,
              std::vector<std::uint32_t>& first_samples) {
    for (std::size_t i = begin; i < samples.size(); ++i)
        if (i == begin || samples[i].emitted != samples[i - 1].emitted)
            first_samples.push_back(static_cast<std::uint32_t>(i));
}

LightSample sample_of(const PunctualLight& light, std::uint32_t number) {
    LightSample s;
    s.position = light.position;
    s.normal = light.direction;
    s.emitted = light.intensity;
    s.kind = light.kind == PunctualLight::Kind::directional ? LightSample::Kind::directional
                                                            : LightSample::Kind::point;
    s.light = number;
    return s;
}

/// About 128 in all, up to 256 for the sake of 8 each, and between 4 and 64 each; a power of two:
/// the sequence fills strata then.
int samples_for(std::size_t luminaires) {
    const std::size_t count = std::max<std::size_t>(luminaires, 1);
    const std::size_t each = std::max(128 / count, std::min<std::size_t>(256 / count, 8));
    return static_cast<int>(std::bit_floor(std::clamp<std::size_t>(each, 4, 64)));
}

}  // namespace

Luminaires sample_luminaires(const SurfaceMesh& mesh, const LightSampleOptions& options,
                             const std::vector<PunctualLight>& lights) {
    if (options.samples < 0 || options.samples > 4096)
        throw UsageError("light samples " + std::to_string(options.samples) +
                         "; accepted: 0 (automatic) to 4096 a luminaire");
    Luminaires result;
    result.lights = lights;
    result.seed = options.seed;
    result.shot_sides.resize(2 * mesh.triangles.size());
    const std::vector<Luminaire> luminaires = find_luminaires(mesh);
    result.count = static_cast<std::uint32_t>(luminaires.size());
    double surface = 0.0;
    for (std::uint32_t r = 0; r < mesh.triangles.size(); ++r)
        surface += transillum::area_of(mesh, r);
    const bool vectors = options.first_shot == FirstShot::vectors;
    const int count = options.samples > 0 ? options.samples : samples_for(luminaires.size());
    for (std::size_t i = 0; i < luminaires.size(); ++i) {
        const double share = area_of(luminaires[i]) / surface;
        if (options.first_shot == FirstShot::off ||
            (options.first_shot == FirstShot::automatic && share >= options.large_emitter)) {
            result.largest_share = std::max(result.largest_share, share);
            continue;
        }
        ++result.shot;
        const std::size_t begin = result.samples.size();
        add_samples(mesh, luminaires[i], count, hash_bits(options.seed) + i, result.samples);
        if (vectors) add_runs(result.samples, begin, result.first_samples);
        for (const EmittingSide& s : luminaires[i])
            result.shot_sides[2 * s.root + (s.back ? 1 : 0)] = 1;
    }
    for (std::uint32_t i = 0; i < lights.size(); ++i) {
        result.samples.push_back(sample_of(lights[i], i));
        if (vectors) add_runs(result.samples, result.samples.size() - 1, result.first_samples);
    }
    return result;
}

void relight_samples(const SurfaceMesh& mesh, const std::vector<PunctualLight>& lights,
                     std::vector<LightSample>& samples) {
    for (LightSample& s : samples)
        s.emitted = s.kind == LightSample::Kind::area ? emission_of(mesh, s.root)
                                                      : lights[s.light].intensity;
}

std::uint64_t sample_table_bytes(std::size_t samples, std::uint64_t patches) {
    return samples * patches * (sizeof(float) + sizeof(float));
}

std::uint64_t light_vector_bytes(std::size_t vectors, std::uint64_t patches) {
    return vectors * patches * sizeof(glm::vec3);
}

std::uint64_t first_shot_bytes(const Luminaires& luminaires, std::uint64_t patches) {
    if (luminaires.first_samples.empty())
        return sample_table_bytes(luminaires.samples.size(), patches);
    return light_vector_bytes(luminaires.first_samples.size(), patches) +
           patches * LightVectorSums::bytes_a_patch;
}

}  // namespace transillum
