/// What the writers of several formats share.
#pragma once

#include <transillum/base/monitor.h>
#include <transillum/base/staged_files.h>
#include <transillum/scene/scene.h>

#include <cstdint>
#include <string>
#include <vector>

namespace transillum {

/// Where a scene goes and what is told on the way.
struct SceneWriter {
    const Scene& scene;
    StagedFiles& files;
    const char* format;  ///< for messages
    Monitor& monitor;

    /// "room.stl: STL holds no materials; 5 left out"; nothing where there are none.
    void leave_out(const char* what, std::size_t count) const;
    /// "room.obj: 3 materials <what>"; nothing for 0.
    void warn_materials(std::size_t count, const std::string& what) const;
    /// What formats of bare geometry leave out.
    void leave_out_all_but_geometry() const;

    /// Numbers of the polygons, object after object, else in the scene's order.
    [[nodiscard]] std::vector<std::uint32_t> polygons_by_object() const;
    [[nodiscard]] std::vector<bool> used_materials() const;

    /// \throws InputError naming a polygon of more than three corners.
    void require_triangles() const;
    /// Every position as a float, noting the furthest move. \throws InputError where one that a
    /// polygon uses is no finite number or larger than floats are.
    [[nodiscard]] std::vector<glm::vec3> float_positions() const;

    /// Begins the names of files beside the main one: its stem, of characters that every format's
    /// text can hold.
    [[nodiscard]] std::string stem() const;
};

void write_obj(const SceneWriter& writer);
void write_ply(const SceneWriter& writer);
void write_stl(const SceneWriter& writer);
void write_off(const SceneWriter& writer);
void write_gltf(const SceneWriter& writer);
void write_glb(const SceneWriter& writer);

}  // namespace transillum
