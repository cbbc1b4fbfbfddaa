#include "solution/scene_hash.h"

#include <transillum/scene/photometry.h>

#include <fmt/format.h>

#include <bit>
#include <cstdint>

namespace transillum {

namespace {

class SceneHash {
public:
    void add(std::uint64_t bits) {
        for (int i = 0; i < 8; ++i) hash_ = (hash_ ^ ((bits >> (8 * i)) & 0xff)) * 0x100000001b3u;
    }
    void add(double x) { add(std::bit_cast<std::uint64_t>(x)); }
    template <int N, class T>
    void add(const glm::vec<N, T>& v) {
        for (int i = 0; i < N; ++i) add(static_cast<double>(v[i]));
    }
    template <class T>
    void add(const std::vector<T>& values) {
        add(std::uint64_t{values.size()});
        for (const T& value : values) add(value);
    }
    void add(const std::string& text) {
        add(std::uint64_t{text.size()});
        for (const char c : text) add(static_cast<std::uint64_t>(static_cast<unsigned char>(c)));
    }
    void add(const Polygon& p) {
        for (const std::uint32_t i :
             {p.first_corner, p.corner_count, p.material, p.object, p.source_face})
            add(std::uint64_t{i});
    }
    void add(const Camera& c) {
        add(c.name);
        add(c.eye);
        add(c.look_at);
        add(c.up);
        add(c.vertical_fov);
    }
    void add(const std::pair<std::string, std::string>& setting) {
        add(setting.first);
        add(setting.second);
    }
    void add(const Texture& t) {
        add(static_cast<std::uint64_t>(t.width) << 32 | static_cast<std::uint64_t>(t.height));
        add(static_cast<std::uint64_t>(t.wrap_u) << 8 | static_cast<std::uint64_t>(t.wrap_v));
        add(t.texels);
    }
    void add(const Material& m) {
        add(m.diffuse);
        add(m.specular);
        add(static_cast<std::uint64_t>(m.lobe));
        add(double{m.shininess});
        add(double{m.roughness});
        add(m.emission);
        add(std::uint64_t{m.back_reflects} | std::uint64_t{m.back_emits} << 1);
        for (const std::int32_t t :
             {m.textures.diffuse, m.textures.specular, m.textures.roughness, m.textures.emission})
            add(static_cast<std::uint64_t>(t));
    }
    void add(const PunctualLight& l) {
        add(static_cast<std::uint64_t>(l.kind));
        add(l.position);
        add(l.direction);
        add(l.up);
        add(l.intensity);
        add(l.inner_angle);
        add(l.outer_angle);
        if (!l.photometry) return;
        add(l.photometry->vertical);
        add(l.photometry->horizontal);
        add(l.photometry->candela);
    }
    void add(const Lighting& l) {
        add(l.lights);
        add(l.environment);
    }
    void add(const Environment& e) {
        add(static_cast<std::uint64_t>(e.kind));
        add(e.radiance_scale);
        add(e.up);
        add(e.rotation);
        add(e.sun);
        if (e.image) add(*e.image);
    }
    [[nodiscard]] std::string text() const { return fmt::format("{:016x}", hash_); }

private:
    std::uint64_t hash_ = 0xcbf29ce484222325u;
};

}  // namespace

std::string hash_scene(const SurfaceMesh& mesh, const Lighting& lighting) {
    SceneHash h;
    h.add(mesh.positions);
    for (const RootTriangle& t : mesh.triangles) {
        for (const std::uint32_t v : t.vertices) h.add(std::uint64_t{v});
        h.add(std::uint64_t{t.material});
    }
    h.add(mesh.uvs);
    h.add(mesh.materials);
    for (const auto& texture : mesh.textures) h.add(*texture);
    h.add(lighting);
    return h.text();
}

std::string hash_input(const Scene& scene,
                       const std::vector<std::pair<std::string, std::string>>& settings) {
    SceneHash h;
    h.add(std::string(TRANSILLUM_VERSION));
    h.add(settings);
    h.add(scene.positions);
    for (const std::uint32_t c : scene.corners) h.add(std::uint64_t{c});
    h.add(scene.uvs);
    h.add(scene.polygons);
    h.add(scene.materials);
    for (const Material& m : scene.materials) h.add(m.name);
    for (const auto& texture : scene.textures) h.add(*texture);
    h.add(scene.objects);
    h.add(scene.cameras);
    h.add(scene.lighting);
    return h.text();
}

}  // namespace transillum
