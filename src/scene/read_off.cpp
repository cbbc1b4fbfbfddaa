#include "scene/read_off.h"

#include "scene/soup.h"
#include "scene/text_reader.h"

#include <array>

namespace transillum {

namespace {

struct Counts {
    std::uint64_t vertices = 0, faces = 0;
};

/// \returns whether vertices carry more than a position.
bool read_keyword(TextReader& reader) {
    constexpr std::array<std::string_view, 8> keywords{"OFF",   "COFF",   "NOFF",   "CNOFF",
                                                       "STOFF", "STCOFF", "STNOFF", "STCNOFF"};
    const std::string_view word = reader.next_word();
    for (const std::string_view keyword : keywords)
        if (word == keyword) return keyword != "OFF";
    reader.fail(in_quotes(word) + " found; accepted: OFF, with any of the prefixes ST, C, N");
}

std::uint64_t read_count(TextReader& reader, std::string_view what, std::size_t file_size) {
    const std::int64_t count = reader.integer(reader.next_word());
    // A vertex or face takes at least six characters.
    const auto most = static_cast<std::int64_t>(file_size / 6);
    if (count < 0 || count > most)
        reader.fail(std::to_string(count) + " " + std::string(what) +
                    " announced; accepted: 0 to " + std::to_string(most) + " in a file of " +
                    std::to_string(file_size) + " bytes");
    return static_cast<std::uint64_t>(count);
}

void read_vertices(TextReader& reader, std::uint64_t count, bool attributes, Scene& scene) {
    for (std::uint64_t i = 0; i < count; ++i) {
        glm::dvec3 p;
        for (int axis = 0; axis < 3; ++axis) p[axis] = reader.number(reader.next_word());
        if (attributes) reader.skip_line();
        reader.end_record();
        scene.positions.push_back(p);
    }
}

void read_faces(TextReader& reader, std::uint64_t count, Scene& scene) {
    const auto vertices = static_cast<std::int64_t>(scene.positions.size());
    for (std::uint64_t i = 0; i < count; ++i) {
        const std::size_t first = scene.corners.size();
        const std::int64_t corners = reader.integer(reader.next_word());
        if (corners < 3)
            reader.fail("face has " + std::to_string(corners) + " corners; accepted: 3 or more");
        for (std::int64_t k = 0; k < corners; ++k) {
            const std::int64_t vertex = reader.integer(reader.next_word());
            if (vertex < 0 || vertex >= vertices)
                reader.fail("face names vertex " + std::to_string(vertex) + " of " +
                            std::to_string(vertices) +
                            "; accepted: " + index_range(scene.positions.size()));
            scene.corners.push_back(static_cast<std::uint32_t>(vertex));
        }
        reader.skip_line();  // a colour
        close_polygon(scene, first, 0, 0);
    }
}

}  // namespace

Scene read_off(const std::filesystem::path& path) {
    const std::string text = read_file(path);
    TextReader reader(path.string(), text, {});
    Scene scene;
    scene.path = path.string();
    scene.materials.push_back(named_material("default"));
    scene.objects.push_back(path.stem().string());

    const bool attributes = read_keyword(reader);
    Counts counts;
    counts.vertices = read_count(reader, "vertices", text.size());
    counts.faces = read_count(reader, "faces", text.size());
    reader.skip_line();  // the number of edges, which nobody keeps right
    read_vertices(reader, counts.vertices, attributes, scene);
    read_faces(reader, counts.faces, scene);
    if (reader.next_line())
        reader.fail("data after the last of " + std::to_string(counts.faces) +
                    " faces; accepted: none");
    return scene;
}

}  // namespace transillum
