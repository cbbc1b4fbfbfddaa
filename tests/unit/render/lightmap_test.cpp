// A solution as a lightmap.
#include "unit/render/dark_solution.h"
#include "unit/render/surface_builder.h"

#include <transillum/base/error.h>
#include <transillum/render/make_lightmap.h>

#include <gtest/gtest.h>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <set>

namespace transillum {
namespace {

using testing_support::dark_solution;
using testing_support::SurfaceBuilder;

constexpr float albedo = 0.5f;
constexpr double pi = std::numbers::pi;

glm::dvec3 on_tube(double u, double v) {
    return {std::cos(2.0 * pi * u), std::sin(2.0 * pi * u), 2.0 * v};
}

/// What is to be found in the lightmap: linear, so that patches hold it to the bit.
double expected(const glm::dvec3& p) {
    return albedo * (3.0 + p.x + 0.5 * p.y + p.z) / pi;
}

void light(Solution& s) {
    for (auto* values : {&s.direct_irradiance, &s.indirect_irradiance, &s.standard_error})
        values->assign(s.patches.patch_count(), Spectrum(0.0f));
    s.coverage.assign(s.patches.patch_count(), 1.0f);
    for (std::uint32_t leaf = 0; leaf < s.patches.leaf_count; ++leaf) {
        const double lit = expected(leaf_centre(s.surface, s.patches, leaf)) * pi / albedo;
        s.indirect_irradiance[leaf] = Spectrum(lit, 1.0, 0.0);
    }
}

/// A closed tube, smooth all around, that no chart can hold as a whole; a square beside it.
SpectralSolution lit_tube() {
    constexpr int around = 24, along = 3;
    SurfaceBuilder builder;
    const auto grey = builder.material(Spectrum(albedo));
    for (int i = 0; i < around; ++i)
        for (int j = 0; j < along; ++j) {
            const auto at = [&](int di, int dj) {
                return on_tube(double((i + di) % around) / around, double(j + dj) / along);
            };
            builder.quad({at(0, 0), at(1, 0), at(1, 1), at(0, 1)}, grey, 0);
        }
    builder.quad({glm::dvec3(3, 0, 0), {4, 0, 0}, {4, 1, 0}, {3, 1, 0}}, grey, 1);
    SpectralSolution spectral;
    Solution& s = spectral.rgb;
    s = dark_solution(builder.build(), 0);
    s.surface.objects = {"tube", "square"};
    s.patches = subdivide_to_levels(std::vector<int>(s.surface.triangles.size(), 3));
    light(s);
    return spectral;
}

LightmapOptions sized(int size) {
    LightmapOptions options;
    options.size = size;
    return options;
}

/// As a graphics card filters linearly.
Spectrum sample(const Image& image, const glm::vec2& uv) {
    const glm::dvec2 p = glm::dvec2(uv) * double(image.width) - 0.5;
    const glm::dvec2 low = glm::floor(p), share = p - low;
    glm::dvec3 sum(0.0);
    for (int dy = 0; dy < 2; ++dy)
        for (int dx = 0; dx < 2; ++dx)
            sum += (dx ? share.x : 1.0 - share.x) * (dy ? share.y : 1.0 - share.y) *
                   glm::dvec3(image.at(static_cast<int>(low.x) + dx, static_cast<int>(low.y) + dy));
    return Spectrum(sum);
}

template <class Value>
Value between(const std::vector<Value>& values, const RadianceMesh::Triangle& t, float b1,
              float b2) {
    const Value &a = values[t.vertices[0]], &b = values[t.vertices[1]], &c = values[t.vertices[2]];
    using Scalar = typename Value::value_type;
    return a + Scalar(b1) * (b - a) + Scalar(b2) * (c - a);
}

TEST(Lightmap, ShowsWhatTheSurfaceShinesWith) {
    const Lightmap l = make_lightmap(lit_tube(), sized(128), Workers(2));
    ASSERT_EQ(l.image.width, 128);
    ASSERT_EQ(l.image.height, 128);
    for (const auto& t : l.mesh.triangles)
        for (const auto& [b1, b2] : {std::pair(0.0f, 0.0f), {0.5f, 0.5f}, {0.2f, 0.3f}}) {
            const double red = expected(between(l.mesh.positions, t, b1, b2));
            const Spectrum found = sample(l.image, between(l.mesh.lightmap_uvs, t, b1, b2));
            EXPECT_NEAR(found.x, red, 0.01 * red);
            EXPECT_NEAR(found.y, albedo / pi, 1e-5) << "constant: nothing else may bleed in";
            EXPECT_EQ(found.z, 0.0f);
        }
}

/// Edges of the mesh by their places, with the lightmap's coordinates on either side.
TEST(Lightmap, ShowsNoSeam) {
    for (const int size : {64, 128}) {
        const Lightmap l = make_lightmap(lit_tube(), sized(size), Workers(2));
        ASSERT_GE(l.charts, 5) << "four of the tube, and the square";
        using Place = std::tuple<double, double, double>;
        const auto place = [&](std::uint32_t v) {
            const glm::dvec3& p = l.mesh.positions[v];
            return Place(p.x, p.y, p.z);
        };
        std::map<std::pair<Place, Place>, std::array<std::uint32_t, 2>> ends;
        int seams = 0;
        for (const auto& t : l.mesh.triangles)
            for (std::size_t i = 0; i < 3; ++i) {
                std::array<std::uint32_t, 2> edge{t.vertices[i], t.vertices[(i + 1) % 3]};
                if (place(edge[1]) < place(edge[0])) std::swap(edge[0], edge[1]);
                const auto [other, is_first] =
                    ends.try_emplace({place(edge[0]), place(edge[1])}, edge);
                if (is_first || other->second == edge) continue;
                ++seams;
                for (int k = 0; k <= 10; ++k) {
                    const auto at = [&](const std::array<std::uint32_t, 2>& e) {
                        const float share = 0.1f * static_cast<float>(k);
                        return double{sample(l.image, (1.0f - share) * l.mesh.lightmap_uvs[e[0]] +
                                                          share * l.mesh.lightmap_uvs[e[1]])
                                          .x};
                    };
                    // Half of what eyes tell apart (Weber).
                    EXPECT_NEAR(at(edge), at(other->second), 5e-3 * at(edge));
                }
            }
        EXPECT_GE(seams, 12);
    }
}

TEST(Lightmap, ChartsNeitherOverlapNorTouch) {
    const Lightmap l = make_lightmap(lit_tube(), sized(128), Workers(1));
    // Of each texel, the triangles whose filtered points read it.
    std::map<std::pair<int, int>, std::set<std::size_t>> readers;
    const auto& triangles = l.mesh.triangles;
    constexpr int steps = 40;
    for (std::size_t i = 0; i < triangles.size(); ++i)
        for (int a = 0; a <= steps; ++a)
            for (int b = 0; a + b <= steps; ++b) {
                const glm::vec2 uv =
                    between(l.mesh.lightmap_uvs, triangles[i], float(a) / steps, float(b) / steps);
                ASSERT_TRUE(uv.x >= 0.0f && uv.x <= 1.0f && uv.y >= 0.0f && uv.y <= 1.0f);
                const glm::dvec2 low = glm::floor(glm::dvec2(uv) * 128.0 - 0.5);
                for (const auto& [dx, dy] : {std::pair(0, 0), {1, 0}, {0, 1}, {1, 1}})
                    readers[{int(low.x) + dx, int(low.y) + dy}].insert(i);
            }
    // Those that share a texel also share a chart: they are connected through such triangles.
    const auto touches = [&](std::size_t a, std::size_t b) {
        return std::ranges::any_of(triangles[a].vertices, [&](std::uint32_t v) {
            return std::ranges::find(triangles[b].vertices, v) != triangles[b].vertices.end();
        });
    };
    std::vector<std::size_t> chart(triangles.size());
    for (std::size_t i = 0; i < chart.size(); ++i) chart[i] = i;
    for (bool changed = true; changed;) {
        changed = false;
        for (std::size_t a = 0; a < chart.size(); ++a)
            for (std::size_t b = 0; b < a; ++b)
                if (chart[a] != chart[b] && touches(a, b)) {
                    chart[a] = chart[b] = std::min(chart[a], chart[b]);
                    changed = true;
                }
    }
    EXPECT_EQ(std::set(chart.begin(), chart.end()).size(), static_cast<std::size_t>(l.charts));
    for (const auto& [texel, readers_of] : readers)
        for (const std::size_t i : readers_of) EXPECT_EQ(chart[i], chart[*readers_of.begin()]);
}

TEST(Lightmap, DoesNotDependOnTheNumberOfThreads) {
    const Lightmap one = make_lightmap(lit_tube(), {}, Workers(1));
    const Lightmap four = make_lightmap(lit_tube(), {}, Workers(4));
    EXPECT_EQ(one.image.pixels, four.image.pixels);
    EXPECT_EQ(one.mesh.lightmap_uvs, four.mesh.lightmap_uvs);
    EXPECT_EQ(one.mesh.lightmap_png, four.mesh.lightmap_png);
}

TEST(Lightmap, HoldsTheComponentsAskedFor) {
    LightmapOptions direct = sized(64);
    direct.components.finite_element = false;
    for (const Spectrum& texel : make_lightmap(lit_tube(), direct, Workers(1)).image.pixels)
        EXPECT_EQ(texel, Spectrum(0.0f));
}

/// However bright: what is lit shows as it does without it.
TEST(Lightmap, EmittersHaveNoSayInItsExposure) {
    SpectralSolution s = lit_tube();
    const double without = make_lightmap(s, sized(128), Workers(1)).mesh.exposure;
    Material lamp = s.rgb.surface.materials[0];
    lamp.emission = Spectrum(1e6f);
    s.rgb.surface.materials.push_back(lamp);
    const std::size_t triangles = s.rgb.surface.triangles.size();
    for (std::size_t t = triangles - 2; t < triangles; ++t)  // the square
        s.rgb.surface.triangles[t].material = 1;
    const Lightmap lit = make_lightmap(s, sized(128), Workers(1));
    EXPECT_NEAR(lit.mesh.exposure, without, 0.3);
    EXPECT_TRUE(lit.image.emitter_mask.empty());
}

TEST(Lightmap, KeepsTheUvsOfTheScene) {
    SpectralSolution s = lit_tube();
    EXPECT_TRUE(make_lightmap(s, sized(64), Workers(1)).mesh.uvs.empty());
    for (std::size_t i = 0; i < 3 * s.rgb.surface.triangles.size(); ++i)
        s.rgb.surface.uvs.emplace_back(float(i), 0.5f);
    const RadianceMesh mesh = make_lightmap(s, sized(64), Workers(1)).mesh;
    ASSERT_EQ(mesh.uvs.size(), mesh.positions.size());
    std::set<float> found;
    for (const auto& t : mesh.triangles)
        for (const std::uint32_t v : t.vertices) found.insert(mesh.uvs[v].x);
    EXPECT_EQ(found.size(), s.rgb.surface.uvs.size());
}

TEST(Lightmap, RefusesWhatItCannotDo) {
    const SpectralSolution s = lit_tube();
    EXPECT_THROW((void)make_lightmap(s, sized(-1), Workers(1)), UsageError);
    EXPECT_THROW((void)make_lightmap(s, sized(largest_lightmap + 1), Workers(1)), UsageError);
    EXPECT_THROW((void)make_lightmap(s, sized(8), Workers(1)), UsageError) << "only padding fits";
    SpectralSolution dark = s;
    std::ranges::fill(dark.rgb.indirect_irradiance, Spectrum(0.0f));
    EXPECT_THROW((void)make_lightmap(dark, sized(64), Workers(1)), InputError);
}

}  // namespace
}  // namespace transillum
