// Whatever happens to a file's bytes, it is refused with a typed error, or what it gives is sound.
#include "unit/scene/scene_files.h"

#include <random>

namespace transillum {

namespace {

struct Sample {
    std::string name, bytes;
};

void PrintTo(const Sample& sample, std::ostream* out) {
    *out << sample.name;
}

std::string read_all(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

std::string floats(std::initializer_list<float> values) {
    std::string bytes;
    for (const float v : values) bytes += bytes_of(v);
    return bytes;
}

std::string binary_ply() {
    std::string bytes =
        "ply\nformat binary_little_endian 1.0\nelement vertex 3\nproperty float x\nproperty float "
        "y\n"
        "property float z\nelement face 1\nproperty list uchar int vertex_index\nend_header\n";
    bytes += floats({0, 0, 0, 1, 0, 0, 0, 1, 0});
    bytes += '\3';
    for (int i = 0; i < 3; ++i) bytes += bytes_of(i);
    return bytes;
}

std::string binary_stl() {
    std::string bytes(80, ' ');
    bytes += bytes_of(1);
    bytes += floats({0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0});
    return bytes.append(2, '\0');
}

std::vector<Sample> samples() {
    const std::string corners = "0 0 0\n1 0 0\n1 1 0\n0 1 0\n";
    return {{"obj",
             "o a\nv 0 0 0\nv 1 0 0\nv 1 1 0\nvt 0 0\nvn 0 0 1\nusemtl m\nf 1/1/1 2/1/1 3/1/1\nf "
             "-1 \\\n-2 -3\n"},
            {"off", "OFF\n4 2 0\n" + corners + "4 0 1 2 3\n3 0 1 2 1 0 0\n"},
            {"ply",
             "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float "
             "y\nproperty float z\n"
             "element face 1\nproperty list uchar int vertex_indices\nend_header\n" +
                 corners + "4 0 1 2 3\n"},
            {"ply", binary_ply()},
            {"stl",
             "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 "
             "0\nendloop\n"
             "endfacet\nendsolid a\n"},
            {"stl", binary_stl()},
            {"gltf", read_all(TRANSILLUM_SOURCE_DIR "/data/scenes/cornell.gltf")}};
}

void damage(std::string& bytes, std::mt19937& random) {
    const auto below = [&](std::size_t n) { return static_cast<std::size_t>(random()) % n; };
    const std::size_t at = below(bytes.size());
    switch (below(5)) {
        case 0:
            bytes[at] = static_cast<char>(below(256));
            break;
        case 1:
            bytes[at] = static_cast<char>(bytes[at] ^ 1 << below(8));
            break;
        case 2:
            bytes.erase(at, 1 + below(8));
            break;
        case 3:
            bytes.insert(at, 1 + below(8), bytes[below(bytes.size())]);
            break;
        default:
            bytes[at] = "0123456789-.eE/ \n{}[]\","[below(23)];
            break;
    }
    if (bytes.empty()) bytes.assign(1, ' ');
}

void expect_sound(const Scene& scene) {
    EXPECT_FALSE(scene.polygons.empty());
    for (const glm::dvec3& p : scene.positions) EXPECT_TRUE(is_finite(p));
    for (const std::uint32_t c : scene.corners) EXPECT_LT(c, scene.positions.size());
    for (const Polygon& p : scene.polygons) {
        EXPECT_GE(p.corner_count, 3u);
        EXPECT_LE(std::size_t{p.first_corner} + p.corner_count, scene.corners.size());
        EXPECT_LT(p.material, scene.materials.size());
        EXPECT_LT(p.object, scene.objects.size());
    }
    for (const Material& m : scene.materials) {
        for (int c = 0; c < channel_count; ++c) {
            EXPECT_TRUE(m.diffuse[c] >= 0.0f && m.diffuse[c] <= 1.0f);
            EXPECT_TRUE(m.specular[c] >= 0.0f && m.specular[c] <= 1.0f);
            EXPECT_TRUE(m.emission[c] >= 0.0f && std::isfinite(m.emission[c]));
        }
    }
    EXPECT_TRUE(scene.uvs.empty() || scene.uvs.size() == scene.corners.size());
}

class DamagedFiles : public SceneFiles, public testing::WithParamInterface<Sample> {};

TEST_P(DamagedFiles, AreRefusedOrSound) {
    std::mt19937 random(1);
    int refused = 0;
    constexpr int trials = 600;
    for (int trial = 0; trial < trials; ++trial) {
        std::string bytes = GetParam().bytes;
        for (int i = 0; i <= trial % 4; ++i) damage(bytes, random);
        try {
            expect_sound(load("x." + GetParam().name, bytes));
        } catch (const InputError& error) {
            ++refused;
            EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
        }
    }
    // Both outcomes occur: damage to a coordinate's last digits leaves a file as good as before.
    EXPECT_GT(refused, 0);
    EXPECT_LT(refused, trials);
}

INSTANTIATE_TEST_SUITE_P(All, DamagedFiles, testing::ValuesIn(samples()));

}  // namespace

}  // namespace transillum
