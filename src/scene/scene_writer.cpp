#include "scene/scene_writer.h"

#include "scene/soup.h"
#include "scene/text_reader.h"

#include <transillum/scene/used_positions.h>

#include <glm/geometric.hpp>

#include <algorithm>
#include <cctype>
#include <numeric>
#include <sstream>

namespace transillum {

namespace {

/// Nothing that a reader of bare geometry would not say of its material.
bool is_default(const Material& m) {
    return m.diffuse == Material{}.diffuse && m.lobe == Lobe::none && !m.emits() &&
           m.textures.diffuse < 0 && m.opacity == 1.0f && m.back_reflects;
}

}  // namespace

void SceneWriter::leave_out(const char* what, std::size_t count) const {
    if (count > 0)
        monitor.warn(files.main().string() + ": " + format + " holds no " + what + "; " +
                     std::to_string(count) + " left out");
}

void SceneWriter::warn_materials(std::size_t count, const std::string& what) const {
    if (count > 0)
        monitor.warn(files.main().string() + ": " + std::to_string(count) +
                     (count == 1 ? " material " : " materials ") + what);
}

void SceneWriter::leave_out_all_but_geometry() const {
    if (!std::ranges::all_of(scene.materials, is_default))
        leave_out("materials", scene.materials.size());
    leave_out("textures", scene.textures.size());
    leave_out("texture coordinates", scene.uvs.size());
    if (scene.objects.size() > 1) leave_out("objects", scene.objects.size());
    leave_out("cameras", scene.cameras.size());
    leave_out("lights", scene.lighting.lights.size());
    leave_out("environment", scene.lighting.environment.shines() ? 1 : 0);
}

std::vector<std::uint32_t> SceneWriter::polygons_by_object() const {
    std::vector<std::uint32_t> order(scene.polygons.size());
    std::iota(order.begin(), order.end(), 0u);
    std::ranges::stable_sort(order, {}, [&](std::uint32_t p) { return scene.polygons[p].object; });
    return order;
}

std::vector<bool> SceneWriter::used_materials() const {
    std::vector<bool> used(scene.materials.size());
    for (const Polygon& p : scene.polygons) used[p.material] = true;
    return used;
}

void SceneWriter::require_triangles() const {
    for (std::size_t p = 0; p < scene.polygons.size(); ++p)
        if (scene.polygons[p].corner_count != 3)
            throw InputError(scene.path, "face " + std::to_string(p) + " has " +
                                             std::to_string(scene.polygons[p].corner_count) +
                                             " corners; accepted by " + format + ": 3");
}

std::vector<glm::vec3> SceneWriter::float_positions() const {
    constexpr auto most = static_cast<double>(std::numeric_limits<float>::max());
    const std::vector<bool> used = used_positions(scene);
    std::vector<glm::vec3> rounded(scene.positions.size());
    double furthest = 0.0;
    for (std::size_t i = 0; i < rounded.size(); ++i) {
        if (!used[i]) continue;
        const glm::dvec3& p = scene.positions[i];
        if (!(max_channel(glm::abs(p)) <= most))
            throw InputError(scene.path, "vertex " + std::to_string(i) +
                                             " has a coordinate beyond 3.4e38; accepted by " +
                                             format + ": single precision");
        rounded[i] = glm::vec3(p);
        furthest = std::max(furthest, glm::length(glm::dvec3(rounded[i]) - p));
    }
    if (furthest > 0.0) {
        std::ostringstream text;
        text << files.main().string() << ": " << format
             << " holds single precision; vertices were moved by up to " << furthest;
        monitor.note(text.str());
    }
    return rounded;
}

std::string SceneWriter::stem() const {
    std::string name = files.main().stem().string();
    for (char& c : name)
        if (std::iscntrl(static_cast<unsigned char>(c)) || c == '#' || c == '\\' || c == ' ')
            c = '_';
    if (name.starts_with('-')) name[0] = '_';
    return name;
}

}  // namespace transillum
