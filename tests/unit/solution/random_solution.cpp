#include "random_solution.h"

#include "solution/leaf_colours.h"

#include <transillum/scene/photometry.h>
#include "support/random_hierarchy.h"

#include <transillum/base/srgb.h>

#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <random>
#include <sstream>

namespace transillum::test {

namespace fs = std::filesystem;

namespace {

/// Uniform numbers in [0, 1), all bits in use.
struct Dice {
    std::mt19937_64 bits;
    double number() { return std::ldexp(static_cast<double>(bits() >> 11), -53); }
    float real() { return std::ldexp(static_cast<float>(bits() >> 40), -24); }
    Spectrum spectrum() {
        const float r = real(), g = real(), b = real();
        return {r, g, b};
    }
    glm::dvec3 point() {
        const double x = number(), y = number(), z = number();
        return {x - 0.5, y - 0.5, z - 0.5};
    }
    std::uint32_t below(std::size_t n) { return static_cast<std::uint32_t>(bits() % n); }
    std::string text() {
        static const char* const texts[] = {"",        "plain",    "two words",  "<&>\"'",
                                            "a\nb\tc", "Größe 光", "back\\slash"};
        return texts[below(std::size(texts))];
    }
};

/// Texels that bytes can hold, as sRGB or as they are, and texels that they cannot.
std::vector<std::shared_ptr<const Texture>> random_textures(Dice& dice) {
    std::vector<std::shared_ptr<const Texture>> textures;
    for (int kind = 0; kind < 3; ++kind) {
        Texture texture;
        texture.name = dice.text();
        texture.width = 1 + static_cast<int>(dice.below(9));
        texture.height = 1 + static_cast<int>(dice.below(9));
        texture.wrap_u = Texture::Wrap{static_cast<std::uint8_t>(dice.below(3))};
        texture.wrap_v = Texture::Wrap{static_cast<std::uint8_t>(dice.below(3))};
        const auto value = [&] {
            const float share = static_cast<float>(dice.below(256)) / 255.0f;
            return kind == 0 ? linear_from_srgb(share) : kind == 1 ? share : 3.0f * dice.real();
        };
        for (int i = 0; i < texture.width * texture.height; ++i) {
            const float r = value(), g = value(), b = value();
            texture.texels.emplace_back(r, g, b);
        }
        texture.build_levels();
        textures.push_back(std::make_shared<const Texture>(std::move(texture)));
    }
    return textures;
}

Material random_material(Dice& dice, const Shape& shape, bool emits) {
    Material material;
    material.name = dice.text();
    material.diffuse = dice.spectrum();
    material.specular = dice.spectrum();
    material.lobe = static_cast<Lobe>(dice.below(3));
    material.shininess = 100.0f * dice.real();
    material.roughness = dice.real();
    material.opacity = dice.real();
    material.back_reflects = !shape.one_sided;
    material.back_emits = dice.below(2) == 0;
    if (emits && shape.lit) material.emission = 50.0f * dice.spectrum();
    return material;
}

SurfaceMesh random_surface(Dice& dice, const Shape& shape) {
    SurfaceMesh mesh;
    mesh.materials = {random_material(dice, shape, false), random_material(dice, shape, true),
                      random_material(dice, shape, false)};
    if (shape.uvs) {
        mesh.textures = random_textures(dice);
        mesh.materials[0].textures = {.diffuse = 2, .specular = 0};
        mesh.materials[1].textures = {.roughness = 1, .emission = 2};
    }
    mesh.objects = {dice.text(), dice.text()};
    mesh.fan_count = 5;
    mesh.grid = {-40, dice.number()};
    for (std::size_t i = 0; i < shape.levels.size() + 2; ++i)
        mesh.positions.push_back(dice.point());
    for (std::uint32_t i = 0; i < shape.levels.size(); ++i) {
        RootTriangle root;
        root.vertices = {i, i + 1, i + 2};
        root.fans = {dice.below(5), dice.below(5), dice.below(5)};
        root.material = i % 3;
        root.object = dice.below(2);
        root.source_face = dice.below(1u << 31);
        mesh.triangles.push_back(root);
        for (int corner = 0; corner < 3 && shape.uvs; ++corner) {
            const float u = dice.real(), v = dice.real();
            mesh.uvs.emplace_back(4.0f * u - 2.0f, v);
        }
    }
    return mesh;
}

std::shared_ptr<Photometry> random_photometry(Dice& dice) {
    auto table = std::make_shared<Photometry>();
    table->name = dice.text();
    table->vertical = {0.0, 90.0 * dice.number(), 90.0};
    table->horizontal = {0.0, 180.0};
    for (int i = 0; i < 6; ++i) table->candela.push_back(1000.0 * dice.number());
    return table;
}

/// Two lights share a table.
Lighting random_lighting(Dice& dice, const Shape& shape) {
    Lighting lighting;
    const auto table = random_photometry(dice);
    for (int i = 0; i < shape.lights; ++i) {
        PunctualLight light;
        light.name = dice.text();
        light.kind = static_cast<PunctualLight::Kind>(dice.below(3));
        light.position = dice.point();
        light.direction = dice.point();
        light.up = dice.point();
        light.intensity = dice.spectrum();
        light.inner_angle = dice.number();
        light.outer_angle = dice.number();
        if (i % 4 == 3) light.photometry = random_photometry(dice);
        if (i % 4 == 1 || i % 4 == 2) light.photometry = table;
        lighting.lights.push_back(light);
    }
    Environment& environment = lighting.environment;
    environment.kind = shape.environment;
    environment.radiance_scale = dice.spectrum();
    environment.up = dice.point();
    environment.rotation = dice.number();
    environment.sun = dice.point();
    if (shape.environment != Environment::Kind::image) return lighting;
    auto image = std::make_shared<Texture>();
    image->name = dice.text();
    image->width = 5;
    image->height = 3;
    image->wrap_v = static_cast<Texture::Wrap>(dice.below(3));
    for (int i = 0; i < 15; ++i) image->texels.push_back(1e5f * dice.spectrum());
    environment.image = image;
    return lighting;
}

void add_lights(Dice& dice, const Shape& shape, Solution& solution) {
    const std::size_t roots = shape.levels.size();
    solution.lighting = random_lighting(dice, shape);
    for (int i = 0; i < shape.light_samples; ++i) {
        LightSample sample{dice.point(),    glm::dvec3(0.6, 0.0, -0.8), dice.number(),
                           dice.spectrum(), dice.below(roots),          dice.below(2) == 0};
        if (i < shape.lights) {
            sample.kind = static_cast<LightSample::Kind>(1 + dice.below(2));
            sample.light = static_cast<std::uint32_t>(i);
        }
        if (shape.light_vectors && i % 2 == 0)
            solution.direct.first_samples.push_back(static_cast<std::uint32_t>(i));
        solution.direct.samples.push_back(sample);
    }
    if (shape.light_samples > 0 && !shape.light_vectors) {
        solution.direct.view_pixel = dice.number();
        solution.direct.parallel_pixel = dice.number();
    }
    for (std::size_t i = 0; i < 2 * roots && shape.light_samples > 0; ++i) {
        solution.direct.shot_sides.push_back(static_cast<std::uint8_t>(dice.below(2)));
    }
}

/// Every third side stays dark unless it emits.
void light_patch(Dice& dice, const Shape& shape, Solution& solution, std::uint32_t patch) {
    const std::uint32_t root = solution.patches.root_of_leaf[solution.patches.leaf_of_patch(patch)];
    const bool dark = (root + solution.patches.is_back(patch)) % 3 == 2 || !shape.lit;
    const bool is_black = !solution.reflects(patch) && !solution.emits(patch);
    const bool keeps_zeros = is_black || (dark && !solution.emits(patch));
    const auto value = [&] { return keeps_zeros ? Spectrum(0.0f) : 3.0f * dice.spectrum(); };
    const auto share = [&] { return keeps_zeros ? 0.0f : dice.real(); };
    solution.direct_irradiance.push_back(value());
    solution.indirect_irradiance.push_back(value());
    solution.standard_error.push_back(value());
    solution.coverage.push_back(share());
    if (shape.norms) {
        solution.spatial_error.push_back(share());
        solution.directional_error.push_back(share());
    }
    for (std::size_t i = 0; i < solution.direct.first_samples.size(); ++i)
        solution.direct.vectors.push_back(keeps_zeros ? glm::vec3(0.0f) : dice.spectrum() - 0.5f);
    for (int i = 0; i < shape.light_samples && !shape.light_vectors; ++i) {
        solution.direct.geometry_factor.push_back(share());
        solution.direct.visibility.push_back(share());
    }
}

/// Levels at random; what is dark stays so.
void add_glossy_elements(Dice& dice, Solution& solution) {
    std::vector<std::int8_t> levels = choose_bin_levels(solution.surface, {});
    for (std::int8_t& level : levels)
        if (level >= 0) level = static_cast<std::int8_t>(dice.below(max_bin_level + 1));
    solution.glossy = lay_out_glossy_sides(solution.surface, solution.patches, levels);
    solution.glossy_elements.assign(solution.glossy.element_count, Spectrum(0.0f));
    for (const GlossySide& side : solution.glossy.sides)
        for (std::uint32_t p = side.first_patch; p < side.first_patch + side.leaf_count; ++p) {
            if (solution.indirect_irradiance[p] == Spectrum(0.0f)) continue;
            for (int k = 0; k < side.bins(); ++k)
                solution.glossy_elements[side.element(k, p)] = dice.spectrum();
        }
}

void add_summary(Dice& dice, Solution& solution) {
    solution.iterations = dice.bits();
    solution.seed = dice.bits();
    solution.relative_error = dice.number();
    solution.interrupted = dice.below(2) == 0;
    solution.balance = {dice.point(), dice.point(), dice.point(), dice.point(), dice.point()};
    for (std::uint32_t i = dice.below(4); i > 0; --i) {
        solution.decisions.push_back({dice.text(), dice.text()});
        solution.settings.emplace_back(dice.text(), dice.text());
    }
    solution.scene_hash = dice.text();
}

// Structured bindings name every member: a member added later does not compile until it is
// compared.
auto tie_of(const Material& m) {
    const auto& [name, diffuse, specular, lobe, shininess, roughness, emission, textures, reflects,
                 emits, opacity] = m;
    return std::tie(name, diffuse, specular, lobe, shininess, roughness, emission, textures.diffuse,
                    textures.specular, textures.roughness, textures.emission, reflects, emits,
                    opacity);
}
auto tie_of(const Texture::Level& l) {
    const auto& [width, height, texels] = l;
    return std::tie(width, height, texels);
}
auto tie_of(const Texture& t) {
    const auto& [name, width, height, texels, wrap_u, wrap_v, levels] = t;
    return std::tie(name, width, height, texels, wrap_u, wrap_v);
}
auto tie_of(const RootTriangle& t) {
    const auto& [vertices, fans, material, object, source_face] = t;
    return std::tie(vertices, fans, material, object, source_face);
}
auto tie_of(const Camera& c) {
    const auto& [name, eye, look_at, up, fov] = c;
    return std::tie(name, eye, look_at, up, fov);
}
auto tie_of(const LightSample& s) {
    const auto& [position, normal, area, emitted, root, back, kind, light] = s;
    return std::tie(position, normal, area, emitted, root, back, kind, light);
}
auto tie_of(const PunctualLight& l) {
    const auto& [name, kind, position, direction, up, intensity, inner, outer, photometry] = l;
    return std::tie(name, kind, position, direction, up, intensity, inner, outer);
}
auto tie_of(const Photometry& p) {
    const auto& [name, vertical, horizontal, candela] = p;
    return std::tie(name, vertical, horizontal, candela);
}
auto tie_of(const GlossySide& s) {
    const auto& [root, back, brdf, projection, bin_level, first_patch, leaf_count, first_element] =
        s;
    return std::tie(root, back, brdf, projection, bin_level, first_patch, leaf_count,
                    first_element);
}
auto tie_of(const Decision& d) {
    const auto& [what, why] = d;
    return std::tie(what, why);
}
auto tie_of(const EnergyBalance& b) {
    const auto& [emitted, entered, absorbed, escaped, black_backs] = b;
    return std::tie(emitted, entered, absorbed, escaped, black_backs);
}

template <class T>
void expect_equal_structs(const std::vector<T>& a, const std::vector<T>& b) {
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t i = 0; i < a.size(); ++i) EXPECT_TRUE(tie_of(a[i]) == tie_of(b[i])) << i;
}

void expect_equal(const std::vector<std::shared_ptr<const Texture>>& a,
                  const std::vector<std::shared_ptr<const Texture>>& b) {
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t i = 0; i < a.size(); ++i) {
        EXPECT_TRUE(tie_of(*a[i]) == tie_of(*b[i])) << "texture " << i;
        expect_equal_structs(a[i]->levels, b[i]->levels);
    }
}

void expect_equal(const SurfaceMesh& a, const SurfaceMesh& b) {
    const auto& [positions, triangles, uvs, fan_count, materials, textures, objects, grid] = a;
    const auto& [exponent, largest_move] = grid;
    EXPECT_TRUE(positions == b.positions);
    EXPECT_TRUE(uvs == b.uvs);
    EXPECT_EQ(fan_count, b.fan_count);
    EXPECT_EQ(objects, b.objects);
    EXPECT_EQ(exponent, b.grid.exponent);
    EXPECT_EQ(largest_move, b.grid.largest_move);
    expect_equal_structs(triangles, b.triangles);
    expect_equal_structs(materials, b.materials);
    expect_equal(textures, b.textures);
}

void expect_equal(const DirectLight& a, const DirectLight& b) {
    const auto& [samples, first_samples, vectors, geometry_factor, visibility, shot_sides,
                 view_pixel, parallel_pixel] = a;
    EXPECT_EQ(view_pixel, b.view_pixel);
    EXPECT_EQ(parallel_pixel, b.parallel_pixel);
    EXPECT_EQ(first_samples, b.first_samples);
    EXPECT_EQ(vectors, b.vectors);
    expect_equal_structs(samples, b.samples);
    EXPECT_EQ(geometry_factor, b.geometry_factor);
    EXPECT_EQ(visibility, b.visibility);
    EXPECT_EQ(shot_sides, b.shot_sides);
}

template <class T>
void expect_equal_targets(const std::shared_ptr<const T>& a, const std::shared_ptr<const T>& b) {
    ASSERT_EQ(a == nullptr, b == nullptr);
    EXPECT_TRUE(!a || tie_of(*a) == tie_of(*b));
}

void expect_equal(const Lighting& a, const Lighting& b) {
    const auto& [lights, environment] = a;
    const auto& [kind, radiance_scale, up, rotation, sun, image] = environment;
    expect_equal_structs(lights, b.lights);
    for (std::size_t i = 0; i < lights.size(); ++i) {
        expect_equal_targets(lights[i].photometry, b.lights[i].photometry);
        for (std::size_t j = 0; j < i; ++j)
            EXPECT_EQ(lights[i].photometry == lights[j].photometry,
                      b.lights[i].photometry == b.lights[j].photometry);
    }
    EXPECT_EQ(kind, b.environment.kind);
    EXPECT_EQ(radiance_scale, b.environment.radiance_scale);
    EXPECT_EQ(up, b.environment.up);
    EXPECT_EQ(rotation, b.environment.rotation);
    EXPECT_EQ(sun, b.environment.sun);
    expect_equal_targets(image, b.environment.image);
}

}  // namespace

Solution random_solution(const Shape& shape, unsigned seed) {
    Dice dice{std::mt19937_64(seed)};
    Solution solution;
    solution.surface = random_surface(dice, shape);
    solution.patches = testing_support::random_hierarchy(shape.levels, shape.splits, seed);
    add_lights(dice, shape, solution);
    for (std::uint32_t patch = 0; patch < solution.patches.patch_count(); ++patch) {
        light_patch(dice, shape, solution, patch);
    }
    add_glossy_elements(dice, solution);
    average_textures(solution);
    for (int i = 0; i < shape.cameras; ++i) {
        solution.cameras.push_back(
            {dice.text(), dice.point(), dice.point(), dice.point(), 1.0 + 178.0 * dice.number()});
    }
    add_summary(dice, solution);
    return solution;
}

void expect_equal(const GlossySides& a, const GlossySides& b) {
    // The tables follow from the materials.
    const auto& [brdfs, projections, sides, of_root_side, element_count] = a;
    EXPECT_EQ(brdfs.size(), b.brdfs.size());
    EXPECT_EQ(projections.size(), b.projections.size());
    expect_equal_structs(sides, b.sides);
    EXPECT_EQ(of_root_side, b.of_root_side);
    EXPECT_EQ(element_count, b.element_count);
}

void expect_equal(const Solution& a, const Solution& b) {
    const auto& [surface, patches, direct, glossy, lighting, cameras, leaf_diffuse, leaf_emission,
                 direct_irradiance, indirect_irradiance, standard_error, spatial_error,
                 directional_error, coverage, glossy_elements, iterations, seed, relative_error,
                 interrupted, balance, decisions, settings, scene_hash, continuation] = a;
    expect_equal(surface, b.surface);
    EXPECT_TRUE(leaf_diffuse == b.leaf_diffuse);
    EXPECT_TRUE(leaf_emission == b.leaf_emission);
    EXPECT_TRUE(patches == b.patches);
    expect_equal(direct, b.direct);
    expect_equal(lighting, b.lighting);
    expect_equal_structs(cameras, b.cameras);
    EXPECT_TRUE(direct_irradiance == b.direct_irradiance);
    EXPECT_TRUE(indirect_irradiance == b.indirect_irradiance);
    EXPECT_TRUE(standard_error == b.standard_error);
    EXPECT_EQ(spatial_error, b.spatial_error);
    EXPECT_EQ(directional_error, b.directional_error);
    EXPECT_EQ(coverage, b.coverage);
    expect_equal(glossy, b.glossy);
    EXPECT_TRUE(glossy_elements == b.glossy_elements);
    EXPECT_EQ(iterations, b.iterations);
    EXPECT_EQ(seed, b.seed);
    EXPECT_EQ(relative_error, b.relative_error);
    EXPECT_EQ(interrupted, b.interrupted);
    EXPECT_TRUE(tie_of(balance) == tie_of(b.balance));
    expect_equal_structs(decisions, b.decisions);
    EXPECT_EQ(settings, b.settings);
    EXPECT_EQ(scene_hash, b.scene_hash);
}

fs::path fresh_folder() {
    std::string pattern = (fs::path(testing::TempDir()) / "transillum_solution_XXXXXX").string();
    if (mkdtemp(pattern.data()) == nullptr) throw std::runtime_error("no temporary folder");
    return pattern;
}

std::map<std::string, std::string> files_below(const fs::path& folder) {
    std::map<std::string, std::string> files;
    for (const auto& entry : fs::recursive_directory_iterator(folder)) {
        std::ostringstream bytes;
        if (entry.is_regular_file()) bytes << std::ifstream(entry.path(), std::ios::binary).rdbuf();
        files[fs::relative(entry.path(), folder).string()] = bytes.str();
    }
    return files;
}

}  // namespace transillum::test
