// Object File Format (Geomview).
#include "scene/scene_writer.h"
#include "scene/text_writer.h"

namespace transillum {

void write_off(const SceneWriter& writer) {
    const Scene& scene = writer.scene;
    writer.leave_out_all_but_geometry();
    TextWriter text;
    text.word("OFF").end_line();
    text.integer(scene.positions.size()).integer(scene.polygons.size()).integer(0).end_line();
    for (const glm::dvec3& p : scene.positions) text.number(p.x).number(p.y).number(p.z).end_line();
    for (const std::uint32_t p : writer.polygons_by_object()) {
        const Polygon& polygon = scene.polygons[p];
        text.integer(polygon.corner_count);
        for (std::uint32_t c = 0; c < polygon.corner_count; ++c)
            text.integer(scene.corners[polygon.first_corner + c]);
        text.end_line();
    }
    writer.files.write_main(text.text());
}

}  // namespace transillum
