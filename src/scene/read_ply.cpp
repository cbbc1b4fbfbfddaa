#include "scene/read_ply.h"

#include "scene/ply_header.h"
#include "scene/soup.h"
#include "scene/text_reader.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>

namespace transillum {

namespace {

static_assert(std::endian::native == std::endian::little);

/// The values after the header, one after the other.
class PlyValues {
public:
    PlyValues(std::string path, const PlyHeader& header, std::string_view bytes)
        : path_(std::move(path)),
          format_(header.format),
          bytes_(bytes),
          at_(header.body_offset),
          text_(path_, bytes.substr(header.body_offset), {.comments = false}, header.body_line) {}

    void begin(const std::string& element, std::uint64_t number) {
        element_ = element;
        number_ = number;
    }
    void end() {
        if (format_ == PlyFormat::ascii) text_.end_record();
    }
    double read(PlyType type) {
        return format_ == PlyFormat::ascii ? text_.number(text_.next_word()) : read_binary(type);
    }
    void skip(PlyType type) {
        if (format_ == PlyFormat::ascii) {
            text_.next_word();
        } else {
            read_binary(type);
        }
    }
    /// \throws InputError where anything follows the last element.
    void finish() {
        if (format_ == PlyFormat::ascii ? text_.next_line() : at_ != bytes_.size())
            fail("data after the last element; accepted: none");
    }
    [[noreturn]] void fail(const std::string& what) const {
        if (format_ == PlyFormat::ascii) text_.fail(what);
        throw InputError(path_, element_ + " " + std::to_string(number_) + ": " + what);
    }

private:
    template <class T>
    static double decode(const std::array<char, 8>& raw) {
        T value;
        std::memcpy(&value, raw.data(), sizeof value);
        return static_cast<double>(value);
    }
    double read_binary(PlyType type);

    std::string path_;
    PlyFormat format_;
    std::string_view bytes_;
    std::size_t at_;
    TextReader text_;
    std::string element_ = "element";
    std::uint64_t number_ = 0;
};

double PlyValues::read_binary(PlyType type) {
    const std::size_t size = size_of(type);
    if (bytes_.size() - at_ < size)
        fail("the file ends too early, after " + std::to_string(bytes_.size()) + " bytes");
    std::array<char, 8> raw{};
    std::memcpy(raw.data(), bytes_.data() + at_, size);
    if (format_ == PlyFormat::big_endian)
        std::reverse(raw.begin(), raw.begin() + static_cast<std::ptrdiff_t>(size));
    at_ += size;
    switch (type) {
        case PlyType::int8:
            return decode<std::int8_t>(raw);
        case PlyType::uint8:
            return decode<std::uint8_t>(raw);
        case PlyType::int16:
            return decode<std::int16_t>(raw);
        case PlyType::uint16:
            return decode<std::uint16_t>(raw);
        case PlyType::int32:
            return decode<std::int32_t>(raw);
        case PlyType::uint32:
            return decode<std::uint32_t>(raw);
        case PlyType::float32:
            return decode<float>(raw);
        case PlyType::float64:
            return decode<double>(raw);
    }
    return 0.0;
}

/// A whole number from `least` on.
std::uint64_t read_whole(PlyValues& values, PlyType type, const char* what, double least,
                         double end, const std::string& accepted) {
    const double value = values.read(type);
    if (!(value >= least && value < end && value == std::floor(value)))
        values.fail(what + shown(value) + "; accepted: " + accepted);
    return static_cast<std::uint64_t>(value);
}

void skip_property(PlyValues& values, const PlyProperty& property) {
    std::uint64_t count = 1;
    if (property.is_list)
        count =
            read_whole(values, property.count_type, "list of length ", 0.0, 0x1p32, "0 or more");
    while (count-- > 0) values.skip(property.type);
}

int axis_of(const PlyProperty& property) {
    constexpr std::string_view axes = "xyz";
    if (property.is_list || property.name.size() != 1) return -1;
    const std::size_t axis = axes.find(property.name[0]);
    return axis == std::string_view::npos ? -1 : static_cast<int>(axis);
}

bool is_corner_list(const PlyProperty& property) {
    return property.is_list &&
           (property.name == "vertex_indices" || property.name == "vertex_index");
}

void read_vertex(PlyValues& values, const PlyElement& element, Scene& scene) {
    glm::dvec3 p(0.0);
    for (const PlyProperty& property : element.properties) {
        const int axis = axis_of(property);
        if (axis < 0) {
            skip_property(values, property);
            continue;
        }
        p[axis] = values.read(property.type);
        if (!std::isfinite(p[axis]))
            values.fail(property.name + " is not finite; accepted: a finite number");
    }
    scene.positions.push_back(p);
}

void read_face(PlyValues& values, const PlyElement& element, std::uint64_t vertices, Scene& scene) {
    for (const PlyProperty& property : element.properties) {
        if (!is_corner_list(property)) {
            skip_property(values, property);
            continue;
        }
        const std::size_t first = scene.corners.size();
        const std::uint64_t corners = read_whole(values, property.count_type,
                                                 "number of corners is ", 3.0, 0x1p32, "3 or more");
        const std::string accepted = index_range(vertices);
        for (std::uint64_t i = 0; i < corners; ++i)
            scene.corners.push_back(static_cast<std::uint32_t>(
                read_whole(values, property.type, "face names vertex ", 0.0,
                           static_cast<double>(vertices), accepted)));
        close_polygon(scene, first, 0, 0);
    }
}

/// The element of that name, once it is known that exactly one has `wanted` properties that `is`
/// accepts.
template <class Predicate>
const PlyElement& required_element(const PlyHeader& header, const std::string& path,
                                   const char* name, std::ptrdiff_t wanted, Predicate is,
                                   const char* accepted) {
    const PlyElement* found = nullptr;
    for (const PlyElement& e : header.elements) {
        if (e.name != name) continue;
        if (found)
            throw InputError(path, std::string("element ") + name + " comes twice; accepted: once");
        found = &e;
    }
    if (!found || std::ranges::count_if(found->properties, is) != wanted)
        throw InputError(path, std::string("element ") + name +
                                   " is not as needed; accepted: one with " + accepted);
    return *found;
}

}  // namespace

Scene read_ply(const std::filesystem::path& path, Monitor& monitor) {
    const std::string bytes = read_file(path);
    Scene scene;
    scene.path = path.string();
    scene.materials.push_back(named_material("default"));
    scene.objects.push_back(path.stem().string());

    const PlyHeader header = read_ply_header(scene.path, bytes);
    const PlyElement& vertex = required_element(
        header, scene.path, "vertex", 3, [](const PlyProperty& p) { return axis_of(p) >= 0; },
        "properties x, y and z");
    const PlyElement& face = required_element(header, scene.path, "face", 1, is_corner_list,
                                              "a list property vertex_indices or vertex_index");
    if (std::ranges::count(vertex.properties, "red", &PlyProperty::name) > 0)
        monitor.note(scene.path + ": vertex colours are not honoured");

    PlyValues values(scene.path, header, bytes);
    for (const PlyElement& element : header.elements) {
        for (std::uint64_t i = 0; i < element.count; ++i) {
            values.begin(element.name, i);
            if (&element == &vertex) {
                read_vertex(values, element, scene);
            } else if (&element == &face) {
                read_face(values, element, vertex.count, scene);
            } else {
                for (const PlyProperty& property : element.properties)
                    skip_property(values, property);
            }
            values.end();
        }
    }
    values.finish();
    return scene;
}

}  // namespace transillum
