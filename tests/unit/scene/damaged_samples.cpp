#include "unit/scene/damaged_samples.h"

#include "unit/scene/image_files.h"
#include "unit/scene/scene_files.h"

namespace transillum {

namespace {

template <class T>
std::string values(std::initializer_list<T> all, bool big_endian = false) {
    std::string bytes;
    for (const T v : all) bytes += bytes_of(v, big_endian);
    return bytes;
}

std::string read_all(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

std::string binary_ply(bool big_endian) {
    std::string bytes = std::string("ply\nformat binary_") + (big_endian ? "big" : "little") +
                        "_endian 1.0\nelement vertex 3\nproperty float x\nproperty double y\n"
                        "property float z\nproperty uchar red\nelement face 1\n"
                        "property list uchar int vertex_index\nelement edge 1\n"
                        "property list ushort short weights\nend_header\n";
    for (const float x : {0.0f, 1.0f, 2.0f}) {
        bytes += bytes_of(x, big_endian) + bytes_of(2.0 * static_cast<double>(x * x), big_endian);
        bytes += bytes_of(0.5f, big_endian) + '\7';
    }
    bytes += '\3' + values<std::int32_t>({0, 1, 2}, big_endian);
    return bytes + values<std::uint16_t>({2, 7, 8}, big_endian);
}

std::string binary_stl() {
    std::string bytes(80, ' ');
    bytes += bytes_of(std::uint32_t{2});
    for (int i = 0; i < 2; ++i)
        bytes += values<float>({0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0}).append(2, '\0');
    return bytes;
}

std::string tiny_png() {
    std::string folder = testing::TempDir() + "transillum_XXXXXX";
    const std::filesystem::path file = std::filesystem::path(mkdtemp(folder.data())) / "t.png";
    write_image<std::uint8_t>(file, {2, 1, 3}, {255, 0, 7, 0, 200, 9});
    const std::string bytes = read_all(file);
    std::filesystem::remove_all(folder);
    return bytes;
}

std::string triangle_bytes() {
    return values<float>({0, 0, 0, 1, 0, 0, 0, 1, 0}) + values<float>({0, 0, 1, 0, 0, 1}) +
           values<std::uint16_t>({0, 1, 2, 0});
}

/// Nodes, a camera, a light, a material with a texture.
std::string gltf_json(const std::string& buffer, const std::string& image) {
    return R"({"asset":{"version":"2.0"},"extensionsUsed":["KHR_lights_punctual"],
"extensions":{"KHR_lights_punctual":{"lights":[{"type":"spot","intensity":3}]}},
"scenes":[{"nodes":[0,1]}],"nodes":[{"mesh":0,"children":[2],"scale":[2,1,1]},
{"camera":0,"matrix":[1,0,0,0,0,1,0,0,0,0,1,0,1,2,3,1]},
{"extensions":{"KHR_lights_punctual":{"light":0}},"rotation":[0,0,1,0]}],
"cameras":[{"type":"perspective","perspective":{"yfov":0.7}}],
"materials":[{"name":"m","pbrMetallicRoughness":{"baseColorTexture":{"index":0},
"metallicFactor":0.5},"emissiveFactor":[1,0.5,0],"alphaMode":"BLEND"}],
"textures":[{"source":0,"sampler":0}],"samplers":[{"wrapS":33071}],
"images":[)" +
           image + R"(],"meshes":[{"primitives":[{"material":0,"indices":2,
"attributes":{"POSITION":0,"TEXCOORD_0":1}}]}],
"accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"},
{"bufferView":0,"byteOffset":36,"componentType":5126,"count":3,"type":"VEC2"},
{"bufferView":0,"byteOffset":60,"componentType":5123,"count":3,"type":"SCALAR"}],
"bufferViews":[{"buffer":0,"byteLength":68},{"buffer":0,"byteOffset":68,"byteLength":LENGTH}],
"buffers":[)" +
           buffer + "]}";
}

std::string with_length(std::string json, std::size_t length) {
    return json.replace(json.find("LENGTH"), 6, std::to_string(length));
}

std::vector<Sample> gltf_samples() {
    const std::string png = tiny_png();
    const std::string size = std::to_string(68 + png.size());
    const std::string embedded = R"({"bufferView":1,"mimeType":"image/png"})";
    const std::string json =
        with_length(gltf_json(R"({"uri":"x.bin","byteLength":)" + size + "}", R"({"uri":"t.png"})"),
                    png.size());
    const std::string in_glb =
        with_length(gltf_json(R"({"byteLength":)" + size + "}", embedded), png.size());
    const std::string binary = triangle_bytes() + png;
    return {{"Gltf", "x.gltf", json, {{"x.bin", binary}, {"t.png", png}}},
            {"GltfBuffer", "x.gltf", json, {{"x.bin", binary}, {"t.png", png}}, 0},
            {"GltfImage", "x.gltf", json, {{"x.bin", binary}, {"t.png", png}}, 1},
            {"Glb", "x.glb", glb_of(in_glb, binary)}};
}

}  // namespace

void PrintTo(const Sample& sample, std::ostream* out) {
    *out << sample.name;
}

std::string glb_of(std::string json, std::string binary) {
    json.resize((json.size() + 3) / 4 * 4, ' ');
    binary.resize((binary.size() + 3) / 4 * 4, '\0');
    const auto size = [](std::size_t n) { return bytes_of(static_cast<std::uint32_t>(n)); };
    return "glTF" + size(2) + size(28 + json.size() + binary.size()) + size(json.size()) + "JSON" +
           json + size(binary.size()) + std::string("BIN\0", 4) + binary;
}

std::vector<Sample> samples() {
    const std::string corners = "0 0 0\n1 0 0\n1 1 0\n0 1 0\n";
    const std::string obj =
        "# camera c 0 0 5 0 0 0 0 1 0 45\nmtllib x.mtl\no a\nv 0 0 0\nv 1 0 0\nv 1 1 0\n"
        "vt 0 0\nvn 0 0 1\nusemtl m\nf 1/1/1 2/1/1 3/1/1\nf -1 \\\n-2 -3\n";
    const std::string mtl =
        "newmtl m\nKd 0.5 0.4 1\nKs 0.1 0.1 0.1\nNs 30\nKe 1 2 3\nd 0.9\nillum 2\n"
        "map_Kd -s 2 2 -o 0.5 0 -clamp on t.png\nnewmtl n\nKd 1 1 1\nTr 0.1\n";
    std::vector<Sample> all{
        {"Obj", "x.obj", obj, {{"x.mtl", mtl}, {"t.png", tiny_png()}}},
        {"Mtl", "x.obj", obj, {{"x.mtl", mtl}, {"t.png", tiny_png()}}, 0},
        {"Off", "x.off", "OFF\n4 2 0\n" + corners + "4 0 1 2 3\n3 0 1 2 1 0 0\n"},
        {"PlyAscii", "x.ply",
         "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\n"
         "property float z\nelement face 1\nproperty list uchar int vertex_indices\n"
         "end_header\n" +
             corners + "4 0 1 2 3\n"},
        {"PlyLittleEndian", "x.ply", binary_ply(false)},
        {"PlyBigEndian", "x.ply", binary_ply(true)},
        {"StlAscii", "x.stl",
         "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\n"
         "endloop\nendfacet\nendsolid a\n"},
        {"StlBinary", "x.stl", binary_stl()},
        {"Cornell", "x.gltf", read_all(TRANSILLUM_SOURCE_DIR "/data/scenes/cornell.gltf")}};
    for (Sample& sample : gltf_samples()) all.push_back(std::move(sample));
    return all;
}

}  // namespace transillum
