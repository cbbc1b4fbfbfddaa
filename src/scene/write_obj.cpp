// Wavefront OBJ; cameras as the comments that obj_cameras.h describes.
#include "scene/scene_writer.h"
#include "scene/text_writer.h"
#include "scene/write_mtl.h"

#include <algorithm>
#include <bit>
#include <limits>
#include <optional>
#include <unordered_map>

namespace transillum {

namespace {

/// Texture coordinates that several corners have are written once.
class UvLines {
public:
    /// Its number from 1; writes it where it is new. v runs upwards in the file.
    std::uint64_t number_of(const glm::vec2& uv, TextWriter& text) {
        const std::uint64_t key = std::uint64_t{std::bit_cast<std::uint32_t>(uv.x)} << 32 |
                                  std::bit_cast<std::uint32_t>(uv.y);
        const auto [found, is_new] = numbers_.try_emplace(key, numbers_.size() + 1);
        if (is_new) text.word("vt").number(uv.x).number(1.0 - static_cast<double>(uv.y)).end_line();
        return found->second;
    }

private:
    std::unordered_map<std::uint64_t, std::uint64_t> numbers_;
};

void write_cameras(const SceneWriter& writer, TextWriter& text) {
    std::size_t renamed = 0;
    for (const Camera& camera : writer.scene.cameras) {
        std::string name = name_in_text(camera.name);
        std::ranges::replace(name, ' ', '_');
        if (name.empty()) name = "camera";
        renamed += name != camera.name;
        text.word("#").word("camera").word(name);
        for (const glm::dvec3& v : {camera.eye, camera.look_at, camera.up})
            text.number(v.x).number(v.y).number(v.z);
        text.number(camera.vertical_fov).end_line();
    }
    if (renamed > 0)
        writer.monitor.note(writer.files.main().string() + ": " + std::to_string(renamed) +
                            " cameras are renamed; accepted: names without blanks");
}

class ObjWriter {
public:
    ObjWriter(const SceneWriter& writer, std::vector<std::string> materials)
        : writer_(writer), scene_(writer.scene), materials_(std::move(materials)) {}

    void write_positions() {
        for (const glm::dvec3& p : scene_.positions)
            text_.word("v").number(p.x).number(p.y).number(p.z).end_line();
    }
    void write_polygon(const Polygon& polygon) {
        if (object_ != polygon.object) {
            text_.word("o").word(name_in_text(scene_.objects[polygon.object])).end_line();
            object_ = polygon.object;
            ++objects_;
        }
        if (material_ != polygon.material) {
            text_.word("usemtl").word(materials_[polygon.material]).end_line();
            material_ = polygon.material;
        }
        std::vector<std::uint64_t> uvs;
        if (!scene_.uvs.empty())
            for (std::uint32_t c = 0; c < polygon.corner_count; ++c)
                uvs.push_back(uv_lines_.number_of(scene_.uvs[polygon.first_corner + c], text_));
        text_.word("f");
        for (std::uint32_t c = 0; c < polygon.corner_count; ++c) {
            std::string corner =
                std::to_string(std::uint64_t{scene_.corners[polygon.first_corner + c]} + 1);
            if (!uvs.empty()) corner.append("/").append(std::to_string(uvs[c]));
            text_.word(corner);
        }
        text_.end_line();
    }
    [[nodiscard]] TextWriter& text() { return text_; }
    [[nodiscard]] std::size_t objects() const { return objects_; }

private:
    const SceneWriter& writer_;
    const Scene& scene_;
    std::vector<std::string> materials_;
    TextWriter text_;
    UvLines uv_lines_;
    std::optional<std::uint32_t> object_, material_;
    std::size_t objects_ = 0;
};

}  // namespace

void write_obj(const SceneWriter& writer) {
    const Scene& scene = writer.scene;
    const std::vector<std::string> names = material_names(writer);
    const std::string library = writer.stem() + ".mtl";
    ObjWriter obj(writer, names);
    obj.text().word("mtllib").word(library).end_line();
    write_cameras(writer, obj.text());
    obj.write_positions();
    for (const std::uint32_t p : writer.polygons_by_object()) obj.write_polygon(scene.polygons[p]);
    writer.leave_out("objects without polygons", scene.objects.size() - obj.objects());
    writer.leave_out("lights", scene.lighting.lights.size());
    writer.leave_out("environment", scene.lighting.environment.shines() ? 1 : 0);
    write_mtl(writer, library, names);
    writer.files.write_main(obj.text().text());
}

}  // namespace transillum
