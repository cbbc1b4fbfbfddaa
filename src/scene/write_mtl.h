/// Materials of an OBJ file.
#pragma once

#include "scene/scene_writer.h"

#include <string>
#include <vector>

namespace transillum {

/// A name as a word or several of OBJ's text can hold it: no control characters, blanks around,
/// comment or continuation.
[[nodiscard]] std::string name_in_text(std::string_view name);

/// What to call the materials: their names, changed where they are empty or another has the same;
/// that is noted.
[[nodiscard]] std::vector<std::string> material_names(const SceneWriter& writer);

/// Stages the material library `file` and the images it names. Textures of materials that no
/// polygon has are left out.
void write_mtl(const SceneWriter& writer, const std::string& file,
               const std::vector<std::string>& names);

}  // namespace transillum
