#include <transillum/base/error.h>
#include <transillum/scene/used_positions.h>

#include <cmath>

namespace transillum {

std::vector<bool> used_positions(const Scene& scene) {
    std::vector<bool> used(scene.positions.size());
    for (const Polygon& polygon : scene.polygons)
        for (std::uint32_t c = 0; c < polygon.corner_count; ++c)
            used[scene.corners[polygon.first_corner + c]] = true;
    for (std::size_t i = 0; i < used.size(); ++i) {
        const glm::dvec3& p = scene.positions[i];
        if (used[i] && !(std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z)))
            throw InputError(
                scene.path,
                "vertex " + std::to_string(i) +
                    " has a coordinate that is no finite number; accepted: finite ones");
    }
    return used;
}

}  // namespace transillum
