#include "scene/obj_cameras.h"

#include "scene/text_reader.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <optional>

namespace transillum {

namespace {

constexpr std::size_t number_count = 10;

using Numbers = std::array<double, number_count>;

/// The numbers after `camera NAME`, if the line holds just these.
std::optional<Numbers> camera_numbers(const std::vector<std::string_view>& words) {
    if (words.size() != 2 + number_count) return std::nullopt;
    Numbers numbers{};
    for (std::size_t i = 0; i < number_count; ++i) {
        const std::string_view word = words[2 + i];
        const char* const end = word.data() + word.size();
        if (std::from_chars(word.data(), end, numbers[i]).ptr != end) return std::nullopt;
    }
    return numbers;
}

bool is_possible(const Camera& camera) {
    const double view = glm::length(glm::cross(camera.look_at - camera.eye, camera.up));
    return std::isfinite(view) && view > 0.0 && camera.vertical_fov > 0.0 &&
           camera.vertical_fov < 180.0;
}

}  // namespace

std::vector<Camera> read_obj_cameras(const std::string& path, std::string_view text,
                                     Monitor& monitor) {
    constexpr std::string_view beginning = "# camera ";
    std::vector<Camera> cameras;
    std::size_t line = 1;
    for (std::size_t at = 0, end = 0; at < text.size(); at = end + 1, ++line) {
        end = std::min(text.find('\n', at), text.size());
        if (!text.substr(at, end - at).starts_with(beginning)) continue;
        TextReader reader(path, text.substr(at + 2, end - at - 2), {.comments = false}, line);
        reader.next_line();
        const std::optional<Numbers> n = camera_numbers(reader.words());
        if (!n) continue;
        const auto vector = [&](std::size_t i) {
            return glm::dvec3((*n)[i], (*n)[i + 1], (*n)[i + 2]);
        };
        const Camera camera{.name = std::string(reader.words()[1]),
                            .eye = vector(0),
                            .look_at = vector(3),
                            .up = vector(6),
                            .vertical_fov = (*n)[9]};
        if (is_possible(camera)) {
            cameras.push_back(camera);
        } else {
            monitor.warn(path + ":" + std::to_string(line) + ": camera " + in_quotes(camera.name) +
                         " is left out; accepted: eye, look-at and up not in one line, a field of "
                         "view between 0 and 180 degrees");
        }
    }
    return cameras;
}

}  // namespace transillum
