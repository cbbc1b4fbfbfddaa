#include "scene/read_stl.h"

#include "scene/soup.h"
#include "scene/text_reader.h"

#include <algorithm>
#include <cctype>
#include <cstring>
#include <initializer_list>

namespace transillum {

namespace {

constexpr std::size_t header_size = 84;
constexpr std::size_t facet_size = 50;

bool is_word(std::string_view word, std::string_view lower_case) {
    return std::ranges::equal(word, lower_case, {},
                              [](char c) { return std::tolower(static_cast<unsigned char>(c)); });
}

void add_triangle_of_last_positions(Scene& scene) {
    const std::size_t first = scene.corners.size();
    for (std::size_t i = scene.positions.size() - 3; i < scene.positions.size(); ++i)
        scene.corners.push_back(static_cast<std::uint32_t>(i));
    close_polygon(scene, first, 0, static_cast<std::uint32_t>(scene.objects.size() - 1));
}

void read_binary(const std::string& bytes, Scene& scene) {
    const std::string size = std::to_string(bytes.size()) + " bytes";
    if (bytes.size() < header_size)
        throw InputError(scene.path, "the file has " + size +
                                         "; accepted: a header of 84 bytes and facets of 50");
    std::uint32_t facets = 0;
    std::memcpy(&facets, bytes.data() + 80, 4);
    const std::uint64_t expected = header_size + facet_size * std::uint64_t{facets};
    if (bytes.size() != expected)
        throw InputError(scene.path, "the header says " + std::to_string(facets) +
                                         " facets, which take " + std::to_string(expected) +
                                         " bytes; the file has " + size);
    for (std::uint32_t f = 0; f < facets; ++f) {
        float corners[3][3];
        std::memcpy(corners, bytes.data() + header_size + facet_size * f + 12, sizeof corners);
        for (const auto& c : corners) {
            const glm::dvec3 p(c[0], c[1], c[2]);
            if (!is_finite(p))
                throw InputError(
                    scene.path,
                    "facet " + std::to_string(f) +
                        " has a coordinate that is not finite; accepted: finite numbers");
            scene.positions.push_back(p);
        }
        add_triangle_of_last_positions(scene);
    }
}

/// The words that must come next, on one line.
void expect(TextReader& reader, std::initializer_list<const char*> words) {
    for (const char* word : words) {
        const std::string_view found = reader.next_word();
        if (!is_word(found, word)) reader.fail(in_quotes(found) + " found; accepted: " + word);
    }
}

/// The rest of a facet after the word `facet`.
void read_facet(TextReader& reader, Scene& scene) {
    expect(reader, {"normal"});
    for (int axis = 0; axis < 3; ++axis) reader.next_word();  // not used; often not a number
    reader.end_record();
    expect(reader, {"outer", "loop"});
    reader.end_record();
    for (int corner = 0; corner < 3; ++corner) {
        expect(reader, {"vertex"});
        glm::dvec3 p;
        for (int axis = 0; axis < 3; ++axis) p[axis] = reader.number(reader.next_word());
        reader.end_record();
        scene.positions.push_back(p);
    }
    expect(reader, {"endloop"});
    reader.end_record();
    expect(reader, {"endfacet"});
    reader.end_record();
    add_triangle_of_last_positions(scene);
}

void read_ascii(const std::string& text, const std::string& unnamed, Scene& scene) {
    TextReader reader(scene.path, text, {.comments = false});
    while (reader.next_line()) {
        expect(reader, {"solid"});
        const std::string_view name = reader.rest(1);
        scene.objects.emplace_back(name.empty() ? unnamed : name);
        reader.skip_line();
        std::string_view word = reader.next_word();
        for (; is_word(word, "facet"); word = reader.next_word()) read_facet(reader, scene);
        if (!is_word(word, "endsolid"))
            reader.fail(in_quotes(word) + " found; accepted: facet or endsolid");
    }
}

/// Binary files may begin with "solid" too, but their counts contain zero bytes.
bool is_ascii(const std::string& bytes) {
    const std::size_t begin = bytes.find_first_not_of(" \t\r\n");
    if (begin == std::string::npos || !is_word(std::string_view(bytes).substr(begin, 5), "solid"))
        return false;
    return bytes.substr(0, header_size + facet_size).find('\0') == std::string::npos;
}

}  // namespace

Scene read_stl(const std::filesystem::path& path) {
    const std::string bytes = read_file(path);
    Scene scene;
    scene.path = path.string();
    scene.materials.push_back(named_material("default"));
    const std::string name = path.stem().string();
    if (is_ascii(bytes)) {
        read_ascii(bytes, name, scene);
    } else {
        scene.objects.push_back(name);
        read_binary(bytes, scene);
    }
    return scene;
}

}  // namespace transillum
