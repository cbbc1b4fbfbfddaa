#include "benchmarks/measured_scene.h"

#include <transillum/scene/limit_albedo.h>
#include <transillum/scene/load_scene.h>

namespace transillum::benchmarks {

Scene load_measured_scene(const std::string& path) {
    Monitor silent;
    Scene scene = load_scene(path, {}, silent);
    limit_albedo(scene, 0.99f, silent);
    return scene;
}

}  // namespace transillum::benchmarks
