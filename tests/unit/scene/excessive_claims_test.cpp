// Small files that ask for more than any memory holds are refused before it is asked for. The
// limits below end the program where one is not.
#include "unit/scene/damaged_samples.h"
#include "unit/scene/scene_files.h"

#include <nlohmann/json.hpp>

#include <chrono>

extern "C" const char* __asan_default_options();
extern "C" const char* __asan_default_options() {
    // Libraries keep some memory for good.
    return "detect_leaks=0:max_allocation_size_mb=512:hard_rss_limit_mb=1500";
}

namespace transillum {

namespace {

using Json = nlohmann::json;

class ExcessiveClaims : public SceneFiles {};

TEST_F(ExcessiveClaims, OfPlyAreRefused) {
    for (const char* count : {"2147483648", "4294967296", "1000000000", "9223372036854775807"}) {
        for (const char* format : {"ascii", "binary_little_endian", "binary_big_endian"}) {
            const std::string begin = std::string("ply\nformat ") + format + " 1.0\n";
            const std::string vertices =
                "property float x\nproperty float y\nproperty float z\nelement face ";
            const std::string faces =
                "\nproperty list uchar int vertex_index\nend_header\n" + std::string(100, '1');
            expect_refused("x.ply",
                           begin + "element vertex " + count + "\n" + vertices + "1" + faces,
                           {count, "'vertex'"});
            expect_refused("x.ply", begin + "element vertex 3\n" + vertices + count + faces,
                           {count, "'face'"});
        }
    }
    // A face of 2^31 corners, and an element of lists as long.
    std::string header =
        "ply\nformat binary_little_endian 1.0\nelement vertex 1\nproperty float x\n"
        "property float y\nproperty float z\nelement face 1\nproperty list uint int ";
    const std::string body = std::string(12, '\0') + bytes_of(0x80000000u) + std::string(40, '\0');
    expect_refused("x.ply", header + "vertex_index\nend_header\n" + body, {"ends too early"});
    expect_refused("x.ply",
                   header + "other\nproperty list uchar int vertex_index\nend_header\n" + body,
                   {"ends too early"});
}

TEST_F(ExcessiveClaims, OfOffAreRefused) {
    expect_refused("x.off", "OFF\n2147483648 1 0\n0 0 0\n", {"2147483648 vertices"});
    expect_refused("x.off", "OFF\n1 2147483648 0\n0 0 0\n", {"2147483648 faces"});
    expect_refused("x.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n1 1 0\n2147483648 0 1 2\n",
                   {"ends too early"});
    expect_refused("x.off", "OFF\n-1 1 0\n0 0 0\n", {"-1 vertices"});
}

TEST_F(ExcessiveClaims, OfStlAreRefused) {
    for (const std::uint32_t count : {0x80000000u, 0xffffffffu, 85899345u, 1u})
        expect_refused("x.stl", std::string(80, ' ') + bytes_of(count) + std::string(100, '\0'),
                       {std::to_string(count) + " facets"});
}

TEST_F(ExcessiveClaims, OfObjAreRefused) {
    for (const char* index : {"2147483648", "-2147483648", "9223372036854775807",
                              "-9223372036854775808", "99999999999999999999"})
        expect_refused("x.obj", std::string("v 0 0 0\nv 1 0 0\nv 1 1 0\nf 1 2 ") + index + "\n",
                       {"x.obj:4"});
}

/// A triangle in a data URI.
Json triangle() {
    return Json::parse(R"({
        "asset": {"version": "2.0"},
        "nodes": [{"mesh": 0}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
        "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"}],
        "bufferViews": [{"buffer": 0, "byteLength": 36}],
        "buffers": [{"byteLength": 36, "uri":
            "data:;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}]
    })");
}

TEST_F(ExcessiveClaims, OfGltfAreRefused) {
    for (const char* pointer :
         {"/accessors/0/count", "/accessors/0/byteOffset", "/bufferViews/0/byteLength",
          "/bufferViews/0/byteOffset", "/bufferViews/0/byteStride", "/buffers/0/byteLength"})
        for (const std::uint64_t value :
             {std::uint64_t{1} << 31, std::uint64_t{1} << 32, ~std::uint64_t{0},
              (~std::uint64_t{0}) / 12 + 1, ~std::uint64_t{0} - 35}) {
            Json json = triangle();
            json[Json::json_pointer(pointer)] = value;
            expect_refused("x.gltf", json.dump(), {"x.gltf"});
        }
}

TEST_F(ExcessiveClaims, OfContainersAreRefused) {
    for (const std::size_t at : {8u, 12u}) {
        std::string glb = glb_of(triangle().dump(), std::string(36, '\0'));
        glb.replace(at, 4, bytes_of(0x80000000u));
        expect_refused("x.glb", glb, {"x.glb"});
    }
}

/// Nodes that share what is below them: 2^30 paths through 60 nodes.
TEST_F(ExcessiveClaims, OfSharedNodesAreRefused) {
    Json json = triangle();
    for (int level = 0; level < 30; ++level) {
        Json node;
        node["children"] = {2 * level + 2, 2 * level + 3};
        json["nodes"][2 * level] = json["nodes"][2 * level + 1] = node;
    }
    json["nodes"].push_back({{"mesh", 0}});
    json["nodes"].push_back({{"mesh", 0}});
    json["scenes"] = Json::parse(R"([{"nodes": [0]}])");
    expect_refused("x.gltf", json.dump(), {"two parents"});
}

TEST_F(ExcessiveClaims, OfCyclesAreRefused) {
    Json json = triangle();
    json["scenes"] = Json::parse(R"([{"nodes": [0]}])");
    json["nodes"] = Json::parse(R"([{"mesh": 0, "children": [1]}, {"children": [2]},
                                    {"children": [0]}])");
    expect_refused("x.gltf", json.dump(), {"its own ancestor"});
    json["nodes"] = Json::parse(R"([{"mesh": 0, "children": [0]}])");
    expect_refused("x.gltf", json.dump(), {"its own ancestor"});
}

TEST_F(ExcessiveClaims, NodesMayBeDeep) {
    constexpr int depth = 100000;
    Json json = triangle();
    json["nodes"] = Json::array();
    for (int i = 0; i < depth; ++i)
        json["nodes"].push_back({{"children", {i + 1}}, {"translation", {0, 0, 1}}});
    json["nodes"].push_back({{"mesh", 0}});
    const Scene scene = load("x.gltf", json.dump());
    ASSERT_EQ(scene.positions.size(), 3u);
    EXPECT_EQ(scene.positions[0].z, depth);
}

/// 3 * 10^10 corners from a file of some megabytes.
TEST_F(ExcessiveClaims, OfSharedMeshesAreRefused) {
    Json json = triangle();
    for (int i = 1; i < 100000; ++i) {
        json["nodes"].push_back({{"mesh", 0}});
        json["meshes"][0]["primitives"].push_back({{"attributes", {{"POSITION", 0}}}});
    }
    const auto begin = std::chrono::steady_clock::now();
    expect_refused("x.gltf", json.dump(), {"nodes[", "accepted: fewer"});
    // Nothing is measured: it is not built, or this would never end.
    EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::minutes(5));
}

/// However often a file is named, it is in memory once.
TEST_F(ExcessiveClaims, OfSharedBuffersAreHarmless) {
    Json json = triangle();
    write("x.bin", std::string(10000000, '\0'));
    json["buffers"] = Json::array();
    for (int i = 0; i < 1000; ++i)
        json["buffers"].push_back({{"byteLength", 36}, {"uri", i % 2 ? "x.bin" : "./x.bin"}});
    EXPECT_EQ(load("x.gltf", json.dump()).polygons.size(), 1u);
}

TEST_F(ExcessiveClaims, OfDeepJsonAreRefused) {
    for (const char bracket : {'[', '{'})
        expect_refused("x.gltf", std::string(1000000, bracket), {"x.gltf"});
    std::string open, close;
    for (int i = 0; i < 200000; ++i) open += "{\"a\":[", close += "]}";
    expect_refused("x.gltf",
                   R"({"asset":{"version":"2.0"},"nodes":[{"matrix":)" + open + close + "}]}",
                   {"nested more than 100 deep"});
    // Brackets within strings are none.
    Json json = triangle();
    json["asset"]["generator"] = std::string(1000, '[') + "\"\\" + std::string(1000, '{');
    EXPECT_EQ(load("x.gltf", json.dump()).polygons.size(), 1u);
}

TEST_F(ExcessiveClaims, OfImagesAreRefused) {
    // The header of a PNG of 16384 x 16384 pixels, and nothing else.
    const std::string png("\x89PNG\r\n\x1a\n\0\0\0\rIHDR\0\0@\0\0\0@\0\x08\2\0\0\0\xb5\xb2\x6c\xde",
                          33);
    write("t.png", png);
    write("x.mtl", "newmtl m\nKd 1 1 1\nmap_Kd t.png\n");
    expect_refused("x.obj",
                   "mtllib x.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nvt 0 0\nusemtl m\nf 1/1 2/1 3/1\n",
                   {"t.png"});
}

TEST_F(ExcessiveClaims, LinesMayBeHuge) {
    const std::string word(5000000, '1');
    for (const char* file : {"x.obj", "x.off", "x.ply", "x.stl", "x.gltf"}) {
        expect_refused(file, word, {file});
        expect_refused(file, "solid " + word, {file});
        expect_refused(file, "OFF " + word, {file});
    }
    std::string face = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf";
    for (int i = 0; i < 1000000; ++i) face += " 1 2 3";
    const Scene scene = load("x.obj", face + "\n");
    EXPECT_EQ(scene.polygons.at(0).corner_count, 3000000u);
    std::string header = "ply\nformat ascii 1.0\nelement vertex 1\n";
    for (int i = 0; i < 100000; ++i) header += "property int p" + std::to_string(i) + "\n";
    expect_refused("x.ply", header + "end_header\n", {"more than 1000 properties"});
}

}  // namespace

}  // namespace transillum
