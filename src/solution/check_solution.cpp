#include "check_solution.h"

#include <transillum/base/error.h>
#include <transillum/geometry/root_trees.h>
#include <transillum/scene/photometry.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <stdexcept>

namespace transillum {

namespace {

struct Defect : std::runtime_error {
    using std::runtime_error::runtime_error;
};

constexpr double infinity = std::numeric_limits<double>::infinity();
/// Shares of sums may exceed one by their rounding.
constexpr double one_and_rounding = 1.0 + 1e-5;

constexpr std::size_t unnumbered = std::numeric_limits<std::size_t>::max();

/// Where a value belongs; spelt out only when there is something to say.
struct Place {
    Place(const char* thing_, std::size_t number_ = unnumbered, const char* part_ = "")
        : thing(thing_), number(number_), part(part_) {}
    [[nodiscard]] Place operator/(const char* of_it) const { return {thing, number, of_it}; }
    [[nodiscard]] std::string text() const {
        std::string text = thing;
        if (number != unnumbered) text.append(" ").append(std::to_string(number));
        if (*part != 0) text.append(" ").append(part);
        return text;
    }
    const char* thing;
    std::size_t number;
    const char* part;
};

void check_number(double value, double least, double most, const Place& what) {
    if (std::isfinite(value) && value >= least && value <= most) return;
    std::ostringstream text;
    text << what.text() << ": " << value << " is not a finite number";
    if (least > -infinity) text << " of at least " << least;
    if (most < infinity) text << " and at most " << most;
    throw Defect(text.str());
}

template <class T>
void check_vector(const glm::vec<3, T>& value, double least, const Place& what) {
    for (int channel = 0; channel < 3; ++channel)
        check_number(value[channel], least, infinity, what);
}

void check_index(std::size_t index, std::size_t count, const Place& what) {
    if (index < count) return;
    throw Defect(what.text() + ": index " + std::to_string(index) + " of " + std::to_string(count));
}

void check_count(std::size_t count, std::size_t expected, const Place& what) {
    if (count == expected) return;
    throw Defect(what.text() + ": " + std::to_string(count) + " entries, expected " +
                 std::to_string(expected));
}

/// VTK ends a text at its first zero.
void check_text(const std::string& text, const Place& what) {
    if (text.find('\0') != std::string::npos)
        throw Defect(what.text() + ": text holds a zero byte");
}

void check_texture(const Texture* texture, const Place& what) {
    if (texture == nullptr) throw Defect(what.text() + " is not there");
    check_text(texture->name, what / "name");
    check_number(texture->width, 1.0, infinity, what / "width");
    check_number(texture->height, 1.0, infinity, what / "height");
    check_count(
        texture->texels.size(),
        static_cast<std::size_t>(texture->width) * static_cast<std::size_t>(texture->height),
        what / "texels");
    for (const Spectrum& texel : texture->texels) check_vector(texel, 0.0, what / "texel");
    if (std::max(texture->wrap_u, texture->wrap_v) > Texture::Wrap::clamp)
        throw Defect(what.text() + ": unknown wrap mode");
}

/// Textures that no material names are not stored and may be anything.
void check_textures(const SurfaceMesh& mesh) {
    std::vector<bool> is_used(mesh.textures.size());
    for (std::size_t i = 0; i < mesh.materials.size(); ++i) {
        const MaterialTextures& t = mesh.materials[i].textures;
        for (const std::int32_t texture : {t.diffuse, t.specular, t.roughness, t.emission}) {
            if (texture == -1) continue;
            check_number(texture, 0.0, static_cast<double>(mesh.textures.size()) - 1.0,
                         Place("material", i, "texture"));
            is_used[static_cast<std::size_t>(texture)] = true;
        }
    }
    for (std::size_t i = 0; i < mesh.textures.size(); ++i)
        if (is_used[i]) check_texture(mesh.textures[i].get(), Place("texture", i));
    if (mesh.uvs.empty() && std::ranges::count(is_used, true) > 0 && !mesh.triangles.empty())
        throw Defect("UVs: none, but materials have textures");
}

void check_material(const Material& material, const Place& what) {
    check_text(material.name, what / "name");
    check_vector(material.diffuse, 0.0, what / "diffuse albedo");
    check_vector(material.specular, 0.0, what / "specular albedo");
    check_vector(material.emission, 0.0, what / "emission");
    if (material.lobe > Lobe::ggx)
        throw Defect((what / "lobe").text() + ": " +
                     std::to_string(static_cast<int>(material.lobe)) + ", at most 2 is accepted");
    check_number(material.shininess, 0.0, infinity, what / "shininess");
    check_number(material.roughness, 0.0, infinity, what / "roughness");
    check_number(material.opacity, 0.0, 1.0, what / "opacity");
}

void check_triangle(const SurfaceMesh& mesh, const RootTriangle& triangle, const Place& what) {
    for (std::size_t k = 0; k < 3; ++k) {
        check_index(triangle.vertices[k], mesh.positions.size(), what / "vertex");
        check_index(triangle.fans[k], mesh.fan_count, what / "fan");
    }
    check_index(triangle.material, mesh.materials.size(), what / "material");
    check_index(triangle.object, mesh.objects.size(), what / "object");
}

void check_surface(const SurfaceMesh& mesh) {
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        check_vector(mesh.positions[i], -infinity, Place("position", i));
    }
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
        check_triangle(mesh, mesh.triangles[i], Place("root", i));
    }
    if (!mesh.uvs.empty()) check_count(mesh.uvs.size(), 3 * mesh.triangles.size(), "UVs");
    for (std::size_t i = 0; i < mesh.uvs.size(); ++i) {
        check_vector(glm::vec3(mesh.uvs[i], 0.0f), -infinity, Place("UV", i));
    }
    for (std::size_t i = 0; i < mesh.materials.size(); ++i) {
        check_material(mesh.materials[i], Place("material", i));
    }
    check_textures(mesh);
    for (std::size_t i = 0; i < mesh.objects.size(); ++i) {
        check_text(mesh.objects[i], Place("object", i));
    }
    check_number(mesh.grid.largest_move, 0.0, infinity, "grid: largest move");
}

/// The tables of the trees are as their leaves' levels make them.
void check_trees(const PatchHierarchy& patches) try {
    if (subdivide_to_trees(trees_of(patches)) != patches)
        throw Defect("subdivision: the tables of its trees contradict each other");
} catch (const UsageError& error) {
    throw Defect(std::string("subdivision: ") + error.what());
}

void check_hierarchy(const PatchHierarchy& patches, std::size_t roots) {
    check_count(patches.roots.size(), roots, "subdivided roots");
    check_count(patches.root_of_leaf.size(), patches.leaf_count, "roots of leaves");
    std::uint64_t leaf = 0;
    for (std::uint32_t i = 0; i < roots; ++i) {
        const auto [first, level, mixed] = patches.roots[i];
        check_number(level, 0, max_subdivision_level, Place("root", i, "level"));
        check_count(first, leaf, Place("root", i, "first leaf"));
        if (mixed != RootPatches::uniform)
            check_index(static_cast<std::uint32_t>(mixed), patches.mixed_roots.size(),
                        Place("root", i, "tree"));
        leaf += patches.leaves_of(i);
        check_index(leaf - 1, patches.leaf_count, Place("root", i, "last leaf"));
        for (std::uint64_t k = first; k < leaf; ++k) {
            check_count(patches.root_of_leaf[k], i, Place("root of leaf", k));
        }
    }
    check_count(patches.leaf_count, leaf, "leaves");
    if (!patches.mixed_roots.empty()) check_trees(patches);
}

void check_table(const std::vector<float>& values, std::size_t count, double most,
                 const Place& what) {
    check_count(values.size(), count, what);
    for (std::size_t i = 0; i < count; ++i) {
        check_number(values[i], 0.0, most, Place(what.thing, i));
    }
}

void check_spectra(const std::vector<Spectrum>& values, std::size_t count, const Place& what) {
    check_count(values.size(), count, what);
    for (std::size_t i = 0; i < count; ++i) {
        check_vector(values[i], 0.0, Place(what.thing, i));
    }
}

void check_ascending(const std::vector<double>& angles, double most, const Place& what) {
    if (angles.empty()) throw Defect(what.text() + ": none");
    for (std::size_t i = 0; i < angles.size(); ++i)
        check_number(angles[i], i == 0 ? 0.0 : std::nextafter(angles[i - 1], infinity), most, what);
}

void check_photometry(const Photometry& table, const Place& what) {
    check_text(table.name, what / "photometry name");
    check_ascending(table.vertical, 180.0, what / "photometry, vertical angle");
    check_ascending(table.horizontal, 360.0, what / "photometry, horizontal angle");
    check_count(table.candela.size(), table.vertical.size() * table.horizontal.size(),
                what / "photometry, candela");
    for (const double value : table.candela)
        check_number(value, 0.0, infinity, what / "photometry, candela");
}

void check_lights(const std::vector<PunctualLight>& lights) {
    for (std::size_t i = 0; i < lights.size(); ++i) {
        const Place what("light", i);
        check_text(lights[i].name, what / "name");
        check_index(static_cast<std::size_t>(lights[i].kind), 3, what / "kind");
        check_vector(lights[i].position, -infinity, what / "position");
        check_vector(lights[i].direction, -infinity, what / "direction");
        check_vector(lights[i].up, -infinity, what / "up");
        check_vector(lights[i].intensity, 0.0, what / "intensity");
        check_number(lights[i].inner_angle, 0.0, infinity, what / "inner angle");
        check_number(lights[i].outer_angle, 0.0, infinity, what / "outer angle");
        if (lights[i].photometry) check_photometry(*lights[i].photometry, what);
    }
}

void check_environment(const Environment& environment) {
    const Place what("environment");
    check_index(static_cast<std::size_t>(environment.kind), 5, what / "kind");
    check_vector(environment.radiance_scale, 0.0, what / "radiance scale");
    check_vector(environment.up, -infinity, what / "up");
    check_number(environment.rotation, -infinity, infinity, what / "rotation");
    check_vector(environment.sun, -infinity, what / "sun");
    const bool has_image = environment.image != nullptr;
    check_count(has_image, environment.kind == Environment::Kind::image, what / "image");
    if (!has_image) return;
    const Texture& image = *environment.image;
    check_text(image.name, what / "image name");
    check_index(static_cast<std::size_t>(image.wrap_u), 3, what / "image wrap");
    check_index(static_cast<std::size_t>(image.wrap_v), 3, what / "image wrap");
    check_number(image.width, 1, infinity, what / "image width");
    check_number(image.height, 1, infinity, what / "image height");
    check_spectra(image.texels, static_cast<std::size_t>(image.width) * image.height,
                  "environment texel");
}

void check_light_vectors(const DirectLight& direct, std::size_t patches) {
    const std::vector<std::uint32_t>& first = direct.first_samples;
    for (std::size_t i = 0; i < first.size(); ++i) {
        const Place what("light vector", i, "first sample");
        check_index(first[i], direct.samples.size(), what);
        if (i == 0) check_count(first[i], 0, what);
        if (i > 0 && first[i] <= first[i - 1]) throw Defect(what.text() + ": not after the last");
    }
    check_count(direct.vectors.size(), patches * first.size(), "light vectors");
    for (std::size_t i = 0; i < direct.vectors.size(); ++i)
        check_vector(direct.vectors[i], -infinity, Place("light vectors, entry", i));
}

void check_direct(const DirectLight& direct, std::size_t roots, std::size_t patches,
                  std::size_t lights) {
    for (std::size_t i = 0; i < direct.samples.size(); ++i) {
        const LightSample& sample = direct.samples[i];
        const Place what("light sample", i);
        check_vector(sample.position, -infinity, what / "position");
        check_vector(sample.normal, -infinity, what / "normal");
        check_number(sample.area, 0.0, infinity, what / "area");
        check_vector(sample.emitted, 0.0, what / "emitted");
        check_index(sample.root, roots, what / "root");
        check_index(static_cast<std::size_t>(sample.kind), 3, what / "kind");
        if (sample.kind != LightSample::Kind::area)
            check_index(sample.light, lights, what / "light");
    }
    check_number(direct.view_pixel, 0.0, infinity, "pixel of the first shot's views");
    check_number(direct.parallel_pixel, 0.0, infinity, "pixel of directional lights' views");
    check_light_vectors(direct, patches);
    const std::size_t entries = direct.has_vectors() ? 0 : patches * direct.samples.size();
    check_table(direct.geometry_factor, entries, infinity, "geometry factor, entry");
    check_table(direct.visibility, entries, one_and_rounding, "visibility, entry");
    if (!direct.shot_sides.empty()) check_count(direct.shot_sides.size(), 2 * roots, "shot sides");
    for (std::size_t i = 0; i < direct.shot_sides.size(); ++i) {
        check_number(direct.shot_sides[i], 0, 1, Place("shot side", i));
    }
}

void check_camera(const Camera& camera, const Place& what) {
    check_text(camera.name, what / "name");
    check_vector(camera.eye, -infinity, what / "eye");
    check_vector(camera.look_at, -infinity, what / "look-at");
    check_vector(camera.up, -infinity, what / "up");
    const double least = std::numeric_limits<double>::min();
    check_number(camera.vertical_fov, least, std::nextafter(180.0, 0.0), what / "field of view");
}

void check_summary(const Solution& solution) {
    check_number(solution.relative_error, 0.0, infinity, "relative error");
    check_vector(solution.balance.emitted, -infinity, "emitted energy");
    check_vector(solution.balance.entered, -infinity, "energy from the environment");
    check_vector(solution.balance.absorbed, -infinity, "absorbed energy");
    check_vector(solution.balance.escaped, -infinity, "escaped energy");
    check_vector(solution.balance.black_backs, -infinity, "energy on black backs");
    for (const auto& [what, why] : solution.decisions) {
        check_text(what, "decision");
        check_text(why, "decision");
    }
    for (const auto& [name, value] : solution.settings) {
        check_text(name, "setting");
        check_text(value, "setting");
    }
    check_text(solution.scene_hash, "scene hash");
}

}  // namespace

std::string find_defect(const Solution& solution) try {
    const std::size_t roots = solution.surface.triangles.size();
    const std::size_t patches = solution.patches.patch_count();
    check_surface(solution.surface);
    check_hierarchy(solution.patches, roots);
    check_lights(solution.lighting.lights);
    check_environment(solution.lighting.environment);
    check_direct(solution.direct, roots, patches, solution.lighting.lights.size());
    for (std::size_t i = 0; i < solution.cameras.size(); ++i) {
        check_camera(solution.cameras[i], Place("camera", i));
    }
    check_spectra(solution.direct_irradiance, patches, "direct irradiance of patch");
    check_spectra(solution.indirect_irradiance, patches, "indirect irradiance of patch");
    check_spectra(solution.standard_error, patches, "standard error of patch");
    check_table(solution.coverage, patches, infinity, "coverage of patch");
    if (!solution.spatial_error.empty() || !solution.directional_error.empty()) {
        check_table(solution.spatial_error, patches, infinity, "spatial error of patch");
        check_table(solution.directional_error, patches, infinity, "directional error of patch");
    }
    for (const GlossySide& side : solution.glossy.sides)
        if (solution.glossy.brdfs[side.brdf].lobe == Lobe::none)
            throw Defect("triangle " + std::to_string(side.root) +
                         ": direction bins on a side without a lobe");
    check_spectra(solution.glossy_elements, solution.glossy.element_count, "glossy element");
    check_summary(solution);
    return {};
} catch (const Defect& defect) {
    return defect.what();
}

}  // namespace transillum
