#include "unit/scene/scene_files.h"

namespace transillum {

namespace {

class ReadOff : public SceneFiles {};

TEST_F(ReadOff, ReadsPolygonsBetweenComments) {
    const Scene scene =
        load("x.off",
             "# made by hand\nOFF # here\n4 2\n\n0 0 0\n# a comment\n1 0 # split\n 0\n1 1 0\n"
             "0 1 0.1\n4  0 1 2 3 255 0 0\n3 0 1 # and\n2\n# end\n");
    ASSERT_EQ(scene.polygons.size(), 2u);
    EXPECT_EQ(scene.polygons[0].corner_count, 4u);
    EXPECT_EQ(corners_of(scene, 0)[3], glm::dvec3(0, 1, 0.1));
    EXPECT_EQ(corners_of(scene, 1)[2], glm::dvec3(1, 1, 0));
    EXPECT_EQ(scene.objects, std::vector<std::string>{"x"});
    EXPECT_TRUE(scene.materials[0].back_reflects);
    EXPECT_FALSE(scene.materials[0].back_emits);
}

TEST_F(ReadOff, PassesOverVertexColours) {
    EXPECT_EQ(load("x.off", "COFF\n3 1 0\n0 0 0 1 0 0 1\n1 0 0 1 0 0 1\n0 1 0 1 0 0 1\n3 0 1 2\n")
                  .polygons.size(),
              1u);
}

TEST_F(ReadOff, RefusesWhatIsWrongAndNamesTheLine) {
    const std::string three = "OFF\n3 1 3\n0 0 0\n1 0 0\n0 1 0\n";
    expect_refused("x.off", three + "3 0 1 3\n",
                   {"x.off:6: face names vertex 3 of 3; accepted: 0 to 2"});
    expect_refused("x.off", three + "3 0 1 -1\n", {"x.off:6: face names vertex -1 of 3"});
    expect_refused("x.off", three + "2 0 1\n", {"x.off:6: face has 2 corners"});
    expect_refused("x.off", three + "3 0 1\n", {"x.off:6: the file ends too early"});
    expect_refused("x.off", three + "3 0 1 2\n3 0 1 2\n",
                   {"x.off:7: data after the last of 1 faces"});
    expect_refused("x.off", "OFF\n2 1 3\n0 0 0\n1 0 0\n0.5 1 0\n3 0 1 2\n",
                   {"x.off:5: '0.5' found; accepted: an integer"});
    expect_refused("x.off", "OFF\n4 1 3\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n",
                   {"x.off:6: unexpected '2'"});
    expect_refused("x.off", "OFF\n3 1 3\n0 0 0\n1 nan 0\n0 1 0\n3 0 1 2\n", {"x.off:4: 'nan'"});
    expect_refused("x.off", "OFF\n4294967295 1 0\n0 0 0\n",
                   {"x.off:2: 4294967295 vertices announced"});
    expect_refused("x.off", "OFF\n3 99999999999 0\n0 0 0\n",
                   {"x.off:2: 99999999999 faces announced"});
    expect_refused("x.off", "PLY\n", {"x.off:1: 'PLY' found; accepted: OFF"});
    expect_refused("x.off", "OFF\n3 0 0\n0 0 0\n1 0 0\n0 1 0\n", {"x.off: no polygon found"});
}

TEST_F(ReadOff, RefusesEveryBeginningOfAFile) {
    expect_no_beginning_loads("x.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2");
}

}  // namespace

}  // namespace transillum
