#include "unit/scene/scene_files.h"

#include <limits>

namespace transillum {

namespace {

std::string facet(float x) {
    std::string bytes(12, '\0');
    for (const float v : {0.0f, 0.0f, 0.0f, x, 0.0f, 0.0f, 0.0f, 1.0f, 0.25f}) bytes += bytes_of(v);
    return bytes + std::string(2, '\0');
}

std::string binary_stl(std::uint32_t announced, const std::string& facets,
                       const std::string& title = "made") {
    std::string header = title;
    header.resize(80);
    return header + bytes_of(announced) + facets;
}

std::string ascii_stl(const std::string& vertices) {
    return "solid lamp\n facet normal 0 0 nan\n  outer loop\n" + vertices +
           "  endloop\n endfacet\nendsolid lamp\n";
}

const std::string three_vertices = "   vertex 0 0 0\n   VERTEX 1e0 0 0\n   vertex 0 1 0.1\n";

class ReadStl : public SceneFiles {};

TEST_F(ReadStl, ReadsBinary) {
    // a title that begins like an ASCII file's does not mislead
    const Scene scene = load("x.stl", binary_stl(2, facet(1) + facet(2), "solid"));
    ASSERT_EQ(scene.polygons.size(), 2u);
    EXPECT_EQ(corners_of(scene, 1)[1], glm::dvec3(2, 0, 0));
    EXPECT_EQ(corners_of(scene, 1)[2], glm::dvec3(0, 1, 0.25));
    EXPECT_EQ(scene.objects, std::vector<std::string>{"x"});
}

TEST_F(ReadStl, ReadsAscii) {
    const Scene scene = load("x.stl", ascii_stl(three_vertices) + "solid\nendsolid\n");
    ASSERT_EQ(scene.polygons.size(), 1u);
    EXPECT_EQ(corners_of(scene, 0)[2], glm::dvec3(0, 1, 0.1));
    EXPECT_EQ(scene.objects.at(scene.polygons[0].object), "lamp");
}

TEST_F(ReadStl, RefusesWrongBinary) {
    expect_refused("x.stl", binary_stl(3, facet(1) + facet(2)),
                   {"the header says 3 facets", "234 bytes", "184 bytes"});
    expect_refused("x.stl", binary_stl(1, facet(1) + facet(2)), {"the header says 1 facets"});
    expect_refused("x.stl", binary_stl(4294967295u, facet(1)),
                   {"the header says 4294967295 facets"});
    expect_refused("x.stl",
                   binary_stl(2, facet(1) + facet(std::numeric_limits<float>::quiet_NaN())),
                   {"facet 1 has a coordinate that is not finite"});
    expect_refused("x.stl", binary_stl(1, facet(std::numeric_limits<float>::infinity())),
                   {"facet 0"});
    expect_refused("x.stl", binary_stl(0, ""), {"no polygon found"});
    expect_no_beginning_loads("x.stl", binary_stl(2, facet(1) + facet(2)));
}

TEST_F(ReadStl, RefusesWrongAsciiAndNamesTheLine) {
    expect_refused("x.stl", ascii_stl("vertex 0 0 0\nvertex 1 0\nvertex 0 1 0\n"),
                   {"x.stl:6: 'vertex' found"});
    expect_refused("x.stl", ascii_stl("vertex 0 0 0 0\nvertex 1 0 0\nvertex 0 1 0\n"),
                   {"x.stl:4: unexpected '0'"});
    expect_refused("x.stl", ascii_stl("vertex 0 0 0\nvertex 1 0 0\n"),
                   {"x.stl:6: 'endloop' found; accepted: vertex"});
    expect_refused("x.stl", ascii_stl(three_vertices + "vertex 1 1 1\n"),
                   {"x.stl:7: 'vertex' found; accepted: endloop"});
    expect_refused("x.stl", ascii_stl("vertex 0 inf 0\nvertex 1 0 0\nvertex 0 1 0\n"),
                   {"x.stl:4: 'inf'"});
    expect_refused("x.stl", "solid a\nendsolid\n", {"no polygon found"});
    const std::string whole = ascii_stl(three_vertices);
    expect_no_beginning_loads("x.stl", whole.substr(0, whole.find("endsolid") + 8));
}

}  // namespace

}  // namespace transillum
