#include "scene/read_obj.h"

#include "scene/obj_cameras.h"
#include "scene/obj_materials.h"
#include "scene/scene_textures.h"
#include "scene/soup.h"
#include "scene/text_reader.h"

#include <algorithm>
#include <array>
#include <optional>

namespace transillum {

namespace {

constexpr std::int64_t absent = -1;

/// Indices of a face's corner, from 0. Positive ones may run ahead of the statements they name, so
/// they are checked at the end of the file.
struct Corner {
    std::int64_t position = absent, uv = absent, normal = absent;
};

/// Consecutive polygons of one `o` or `g`; named when its first polygon comes.
struct Grouping {
    std::string name;
    bool seen = false, fresh = true;
    std::vector<std::string> names;
    std::vector<std::uint32_t> of_polygon;

    void begin(std::string_view next) {
        name = next;
        seen = fresh = true;
    }
    void add_polygon() {
        if (fresh) names.push_back(name);
        fresh = false;
        of_polygon.push_back(static_cast<std::uint32_t>(names.size() - 1));
    }
};

class ObjReader {
public:
    ObjReader(const std::filesystem::path& path, std::string_view text, Monitor& monitor)
        : reader_(path.string(), text, {.continuation = true}),
          materials_(path, monitor),
          monitor_(monitor) {
        scene_.path = path.string();
        objects_.name = groups_.name = path.stem().string();
    }
    Scene read();

private:
    void read_statement();
    glm::dvec3 read_vector(std::size_t least, std::size_t most) const;
    void read_face();
    Corner read_corner(std::string_view word) const;
    std::int64_t read_index(std::string_view part, std::size_t count, const char* kind) const;
    void check_indices() const;
    void check_index(std::int64_t index, std::size_t count, const char* kind,
                     std::size_t polygon) const;
    [[nodiscard]] std::string naming_error(std::int64_t named, std::size_t count,
                                           const char* kind) const;
    void take_corners();
    [[nodiscard]] std::vector<std::uint8_t> polygons_with_uvs() const;

    TextReader reader_;
    ObjMaterials materials_;
    Monitor& monitor_;
    Scene scene_;
    std::vector<glm::dvec2> uvs_;
    std::size_t normal_count_ = 0;
    std::vector<Corner> corners_;
    std::vector<std::size_t> line_of_polygon_;
    Grouping objects_, groups_;
    std::size_t left_out_ = 0;
};

glm::dvec3 ObjReader::read_vector(std::size_t least, std::size_t most) const {
    const auto& words = reader_.words();
    if (words.size() - 1 < least || words.size() - 1 > most)
        reader_.fail(in_quotes(words[0]) + " with " + std::to_string(words.size() - 1) +
                     " numbers; accepted: " + std::to_string(least) + " to " +
                     std::to_string(most));
    glm::dvec3 v(0.0);
    for (std::size_t i = 1; i < words.size(); ++i) {
        const double value = reader_.number(words[i]);
        if (i <= 3) v[static_cast<int>(i) - 1] = value;
    }
    return v;
}

std::string ObjReader::naming_error(std::int64_t named, std::size_t count, const char* kind) const {
    const std::string n = std::to_string(count);
    return std::string("face names ") + kind + " " + std::to_string(named) + " of " + n +
           "; accepted: " + (count == 0 ? "none" : "1 to " + n + " or -" + n + " to -1");
}

std::int64_t ObjReader::read_index(std::string_view part, std::size_t count,
                                   const char* kind) const {
    const std::int64_t named = reader_.integer(part);
    const auto before = static_cast<std::int64_t>(count);
    if (named == 0 || named < -before) reader_.fail(naming_error(named, count, kind));
    return named > 0 ? named - 1 : before + named;
}

Corner ObjReader::read_corner(std::string_view word) const {
    std::array<std::string_view, 3> parts;
    std::size_t count = 0;
    for (std::string_view left = word;; ++count) {
        if (count == parts.size())
            reader_.fail("corner " + in_quotes(word) +
                         " found; accepted: v, v/vt, v//vn or v/vt/vn");
        const std::size_t slash = left.find('/');
        parts[count] = left.substr(0, slash);
        if (slash == std::string_view::npos) break;
        left.remove_prefix(slash + 1);
    }
    Corner corner;
    corner.position = read_index(parts[0], scene_.positions.size(), "vertex");
    if (!parts[1].empty()) corner.uv = read_index(parts[1], uvs_.size(), "texture coordinate");
    if (!parts[2].empty()) corner.normal = read_index(parts[2], normal_count_, "normal");
    return corner;
}

void ObjReader::read_face() {
    const auto& words = reader_.words();
    if (words.size() < 4)
        reader_.fail("face has " + std::to_string(words.size() - 1) +
                     " corners; accepted: 3 or more");
    const std::size_t first = corners_.size();
    for (std::size_t i = 1; i < words.size(); ++i) {
        corners_.push_back(read_corner(words[i]));
        scene_.corners.push_back(0);
    }
    close_polygon(scene_, first, materials_.current(), 0);
    line_of_polygon_.push_back(reader_.line());
    objects_.add_polygon();
    groups_.add_polygon();
}

void ObjReader::read_statement() {
    // Shading, display and free-form statements of the specification.
    constexpr std::array<std::string_view, 34> passed_over{
        "s",         "mg",     "bevel",  "c_interp", "d_interp", "lod",   "shadow_obj",
        "trace_obj", "maplib", "usemap", "vp",       "cstype",   "deg",   "bmat",
        "step",      "parm",   "trim",   "hole",     "scrv",     "sp",    "end",
        "con",       "ctech",  "stech",  "call",     "csh",      "bsp",   "bzp",
        "cdc",       "cdp",    "res",    "merge",    "vc",       "object"};
    constexpr std::array<std::string_view, 5> geometry{"p", "l", "curv", "curv2", "surf"};
    const std::string_view keyword = reader_.words()[0];
    if (keyword == "v")
        scene_.positions.push_back(read_vector(3, 7));
    else if (keyword == "vt")
        uvs_.emplace_back(read_vector(1, 3));
    else if (keyword == "vn")
        read_vector(3, 3), ++normal_count_;
    else if (keyword == "f" || keyword == "fo")
        read_face();
    else if (keyword == "o")
        objects_.begin(reader_.rest(1));
    else if (keyword == "g")
        groups_.begin(reader_.rest(1));
    else if (keyword == "usemtl")
        materials_.select(reader_.rest(1));
    else if (keyword == "mtllib")
        materials_.load(reader_);
    else if (std::ranges::count(geometry, keyword) > 0)
        ++left_out_;
    else if (std::ranges::count(passed_over, keyword) == 0)
        reader_.fail("statement " + in_quotes(keyword) +
                     " found; accepted: those of OBJ: v, vt, vn, f, o, g, usemtl, mtllib ...");
}

void ObjReader::check_index(std::int64_t index, std::size_t count, const char* kind,
                            std::size_t polygon) const {
    if (index == absent || index < static_cast<std::int64_t>(count)) return;
    throw InputError(scene_.path + ":" + std::to_string(line_of_polygon_[polygon]),
                     naming_error(index + 1, count, kind));
}

void ObjReader::check_indices() const {
    for (std::size_t p = 0; p < scene_.polygons.size(); ++p) {
        const Polygon& polygon = scene_.polygons[p];
        for (std::size_t i = 0; i < polygon.corner_count; ++i) {
            const Corner& corner = corners_[polygon.first_corner + i];
            check_index(corner.position, scene_.positions.size(), "vertex", p);
            check_index(corner.uv, uvs_.size(), "texture coordinate", p);
            check_index(corner.normal, normal_count_, "normal", p);
        }
    }
}

void ObjReader::take_corners() {
    for (std::size_t i = 0; i < corners_.size(); ++i)
        scene_.corners[i] = static_cast<std::uint32_t>(corners_[i].position);
    if (std::ranges::all_of(corners_, [](const Corner& c) { return c.uv == absent; })) return;
    // v runs upwards in the file; small ones would be rounded if they were turned as floats.
    for (const Corner& c : corners_) {
        const glm::dvec2 uv =
            c.uv == absent ? glm::dvec2(0.0) : uvs_[static_cast<std::size_t>(c.uv)];
        scene_.uvs.emplace_back(uv.x, 1.0 - uv.y);
    }
}

std::vector<std::uint8_t> ObjReader::polygons_with_uvs() const {
    std::vector<std::uint8_t> has_uvs;
    for (const Polygon& p : scene_.polygons) {
        const auto first = corners_.begin() + p.first_corner;
        has_uvs.push_back(std::all_of(first, first + p.corner_count,
                                      [](const Corner& c) { return c.uv != absent; }));
    }
    return has_uvs;
}

Scene ObjReader::read() {
    while (reader_.next_line()) read_statement();
    check_indices();
    take_corners();
    Grouping& grouping = objects_.seen ? objects_ : groups_;
    scene_.objects = std::move(grouping.names);
    for (std::size_t p = 0; p < scene_.polygons.size(); ++p)
        scene_.polygons[p].object = grouping.of_polygon[p];
    materials_.finish(scene_);
    finish_textures(scene_, polygons_with_uvs(), monitor_);
    if (left_out_ > 0)
        monitor_.note(scene_.path + ": " + std::to_string(left_out_) +
                      " points, lines or free-form curves and surfaces are left out");
    return std::move(scene_);
}

}  // namespace

Scene read_obj(const std::filesystem::path& path, Monitor& monitor) {
    const std::string text = read_file(path);
    Scene scene = ObjReader(path, text, monitor).read();
    scene.cameras = read_obj_cameras(scene.path, text, monitor);
    return scene;
}

}  // namespace transillum
