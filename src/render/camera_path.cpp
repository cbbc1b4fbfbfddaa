#include <transillum/base/error.h>
#include <transillum/render/camera_path.h>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <sstream>
#include <string>

namespace transillum {

namespace {

constexpr std::size_t numbers_a_line = 11;

KeyFrame read_key_frame(const std::string& where, const std::string& line) {
    std::array<double, numbers_a_line> n{};
    std::istringstream words(line);
    std::string word;
    std::size_t count = 0;
    for (; words >> word; ++count) {
        std::size_t used = 0;
        double value = 0.0;
        try {
            value = std::stod(word, &used);
        } catch (const std::exception&) {
            used = 0;
        }
        if (used != word.size() || !std::isfinite(value))
            throw InputError(where, "'" + word + "'; accepted: a finite number");
        if (count < n.size()) n[count] = value;
    }
    if (count != n.size())
        throw InputError(
            where, std::to_string(count) + " numbers; accepted: 11 (time, eye, look-at, up, fov)");
    KeyFrame key{n[0],
                 {.name = {},
                  .eye = {n[1], n[2], n[3]},
                  .look_at = {n[4], n[5], n[6]},
                  .up = {n[7], n[8], n[9]},
                  .vertical_fov = n[10]}};
    if (!(n[10] > 0.0 && n[10] < 180.0))
        throw InputError(where, "a field of view of " + std::to_string(n[10]) +
                                    "; accepted: above 0, below 180 degrees");
    const Camera& c = key.camera;
    if (!(glm::length(glm::cross(c.look_at - c.eye, c.up)) > 0.0))
        throw InputError(where, "eye, look-at and up span no frame; accepted: up across the view");
    return key;
}

}  // namespace

CameraPath read_camera_path(const std::filesystem::path& path) {
    std::ifstream file(path);
    if (!file) throw IoError(path.string(), "cannot be read");
    CameraPath keys;
    std::string line;
    for (int number = 1; std::getline(file, line); ++number) {
        line.erase(std::min(line.find('#'), line.size()));
        if (line.find_first_not_of(" \t\r") == std::string::npos) continue;
        const std::string where = path.string() + ":" + std::to_string(number);
        keys.push_back(read_key_frame(where, line));
        if (keys.size() > 1 && !(keys.back().time > keys[keys.size() - 2].time))
            throw InputError(where, "a time of " + std::to_string(keys.back().time) +
                                        "; accepted: later than the line before");
    }
    if (keys.empty()) throw InputError(path.string(), "no key frame; accepted: one a line");
    return keys;
}

Camera camera_at(const CameraPath& path, double time) {
    const auto next = std::ranges::upper_bound(path, time, {}, &KeyFrame::time);
    if (next == path.begin()) return path.front().camera;
    if (next == path.end()) return path.back().camera;
    const KeyFrame &from = *(next - 1), &to = *next;
    const double t = (time - from.time) / (to.time - from.time);
    const Camera &a = from.camera, &b = to.camera;
    return {{},
            glm::mix(a.eye, b.eye, t),
            glm::mix(a.look_at, b.look_at, t),
            glm::mix(a.up, b.up, t),
            glm::mix(a.vertical_fov, b.vertical_fov, t)};
}

}  // namespace transillum
