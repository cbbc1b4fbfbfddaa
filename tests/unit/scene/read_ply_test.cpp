#include "unit/scene/scene_files.h"

#include <limits>

namespace transillum {

namespace {

std::string header(const std::string& format, const std::string& vertices = "4",
                   const std::string& faces = "2") {
    return "ply\nformat " + format + " 1.0\ncomment a square, twice\nelement vertex " + vertices +
           "\nproperty float x\nproperty double y\nproperty float z\nproperty uchar red\nelement "
           "face " +
           faces + "\nproperty list uchar int vertex_indices\nproperty short tag\nend_header\n";
}

const std::string ascii_body = "0 0 0 9\n1 0 0 9\n1 1 0 9\n0 0.1 0 9\n4 0 1 2 3 7\n3 0 1 2 7\n";

std::string vertex(bool big, float x, double y, float z) {
    return bytes_of(x, big) + bytes_of(y, big) + bytes_of(z, big) + "\x09";
}

std::string face(bool big, const std::vector<std::int32_t>& corners) {
    std::string bytes(1, static_cast<char>(corners.size()));
    for (const std::int32_t c : corners) bytes += bytes_of(c, big);
    return bytes + bytes_of(std::int16_t{7}, big);
}

std::string four_vertices(bool big) {
    return vertex(big, 0, 0, 0) + vertex(big, 1, 0, 0) + vertex(big, 1, 1, 0) +
           vertex(big, 0, 0.1, 0);
}

std::string body(bool big) {
    return four_vertices(big) + face(big, {0, 1, 2, 3}) + face(big, {0, 1, 2});
}

const std::string little = "binary_little_endian";

class ReadPly : public SceneFiles {};

TEST_F(ReadPly, ReadsTheSameFromAllFormats) {
    const std::vector<std::string> files{header("ascii") + ascii_body, header(little) + body(false),
                                         header("binary_big_endian") + body(true)};
    for (const std::string& file : files) {
        const Scene scene = load("x.ply", file);
        ASSERT_EQ(scene.polygons.size(), 2u);
        EXPECT_EQ(scene.polygons[0].corner_count, 4u);
        EXPECT_EQ(corners_of(scene, 0)[3], glm::dvec3(0, 0.1, 0)) << "in double precision";
        EXPECT_EQ(corners_of(scene, 1)[1], glm::dvec3(1, 0, 0));
    }
    EXPECT_TRUE(monitor_.any_names(monitor_.notes, "vertex colours are not honoured"));
}

TEST_F(ReadPly, PassesOverOtherElementsAndLists) {
    const Scene scene =
        load("x.ply",
             "ply\r\nformat ascii 1.0\r\nelement material 1\r\nproperty list uchar float k\r\n"
             "element face 1\r\nproperty list uint8 uint32 vertex_index\r\nelement vertex 3\r\n"
             "property float32 x\r\nproperty float32 y\r\nproperty float32 z\r\nend_header\r\n"
             "2 nan 1\r\n3 0 1 2\r\n0 0 0\r\n1 0 0\r\n0 1 0\r\n");
    EXPECT_EQ(corners_of(scene, 0)[2], glm::dvec3(0, 1, 0));
}

TEST_F(ReadPly, RefusesWrongBinary) {
    const auto nan = std::numeric_limits<double>::quiet_NaN();
    expect_refused(
        "x.ply",
        header(little) + four_vertices(false) + face(false, {0, 1, 2, 4}) + face(false, {0, 1, 2}),
        {"x.ply: face 0: face names vertex 4; accepted: 0 to 3"});
    expect_refused(
        "x.ply",
        header(little) + four_vertices(false) + face(false, {0, 1, 2}) + face(false, {0, -1, 2}),
        {"x.ply: face 1: face names vertex -1; accepted: 0 to 3"});
    expect_refused(
        "x.ply",
        header(little) + four_vertices(false) + face(false, {0, 1}) + face(false, {0, 1, 2}),
        {"x.ply: face 0: number of corners is 2; accepted: 3 or more"});
    expect_refused("x.ply", header(little, "1", "0") + vertex(false, 0, nan, 0),
                   {"x.ply: vertex 0: y is not finite"});
    expect_refused("x.ply", header(little) + body(false) + "x", {"data after the last element"});
    expect_refused("x.ply", header(little, "3") + body(false), {"x.ply: face 0"});
    expect_refused("x.ply", header(little, "4294967295") + body(false),
                   {"element 'vertex': 4294967295 announced; accepted: at most 20"});
    expect_refused("x.ply", header(little, "4", "18446744073709551615") + body(false),
                   {"'18446744073709551615'"});
    expect_no_beginning_loads("x.ply", header(little) + body(false));
}

TEST_F(ReadPly, RefusesWrongAsciiAndNamesTheLine) {
    expect_refused("x.ply",
                   header("ascii", "4", "1") + "0 0 0 9\n1 0 0 9\n1 inf 0 9\n0 1 0 9\n3 0 1 2 7\n",
                   {"x.ply:15: 'inf'"});
    expect_refused("x.ply", header("ascii", "3", "1") + "0 0 0 9\n1 0 0 9\n1 1 0 9\n3 0 1 3 7\n",
                   {"x.ply:16: face names vertex 3; accepted: 0 to 2"});
    expect_refused("x.ply", header("ascii", "3", "1") + "0 0 0 9\n1 0 0 9\n1 1 0\n3 0 1 2 7\n",
                   {"x.ply:16: unexpected '0'"});
    expect_refused("x.ply", header("ascii", "4", "1") + "0 0 0 9\n1 0 0 9\n1 1 0 9\n3 0 1 2 7\n",
                   {"x.ply:16: unexpected '7'"});
    expect_refused("x.ply", header("ascii", "4", "1") + ascii_body,
                   {"x.ply:18: data after the last element"});
    expect_refused("x.ply", header("ascii", "999") + ascii_body,
                   {"element 'vertex': 999 announced"});
    const std::string whole = header("ascii") + ascii_body;
    expect_no_beginning_loads("x.ply", whole.substr(0, whole.size() - 1));
}

TEST_F(ReadPly, RefusesWrongHeaders) {
    expect_refused("x.ply", "ply\nformat ascii 2.0\nend_header\n", {"x.ply:2", "version 1.0"});
    expect_refused("x.ply", "ply\nelement vertex 0\nproperty float x\nend_header\n",
                   {"no format in the header"});
    expect_refused("x.ply", "ply\nformat ascii 1.0\nproperty float x\nend_header\n",
                   {"x.ply:3: 'property' found"});
    expect_refused("x.ply",
                   "ply\nformat ascii 1.0\nelement vertex 0\nproperty real x\nend_header\n",
                   {"x.ply:4: type 'real'"});
    expect_refused("x.ply", "ply\nformat ascii 1.0\nelement vertex 9999999\nend_header\n",
                   {"element 'vertex': has no property"});
    expect_refused(
        "x.ply",
        "ply\nformat ascii 1.0\nelement vertex 0\nproperty float x\nproperty float x\nend_header\n",
        {"x.ply:5: property 'x' comes twice"});
    expect_refused("x.ply",
                   "ply\nformat ascii 1.0\nelement vertex 0\nproperty float x\nend_header\n",
                   {"element vertex is not as needed"});
    expect_refused("x.ply", "solid\n", {"not a whole PLY header"});
}

}  // namespace

}  // namespace transillum
