// What check says, and how it ends.
#include "program/program.h"

#include <nlohmann/json.hpp>

#include <set>
#include <string>

namespace transillum {

namespace {

constexpr int done = 0, usage = 2, bad_input = 3, io_failed = 4;

class Check : public Program {
protected:
    /// Two triangles that pass through each other.
    void write_cross() const {
        write("cross.obj",
              "v 0 0 0\nv 4 0 0\nv 0 4 0\nv 1 1 -1\nv 2 1 -1\nv 1 1 1\n"
              "o floor\nf 1 2 3\no blade\nf 4 5 6\n");
    }
};

TEST_F(Check, SaysThatAClosedRoomIsSound) {
    write_room("0.5", "1");
    const Outcome text = run("-q check room.obj");
    EXPECT_EQ(text.exit_code, done) << text.err;
    EXPECT_NE(text.out.find("nothing harmful"), std::string::npos) << text.out;
    EXPECT_NE(text.out.find("no way from outside"), std::string::npos) << text.out;
    const Outcome json = run("-q check room.obj --json");
    EXPECT_EQ(json.exit_code, done);
    const auto report = nlohmann::json::parse(json.out);
    EXPECT_TRUE(report["sound"].get<bool>());
    EXPECT_TRUE(report["leaks_searched"].get<bool>());
    EXPECT_EQ(report["triangles"], 12);
    EXPECT_EQ(report["counts"].size(), 20u);
    EXPECT_EQ(report["components"].size(), 1u);
}

TEST_F(Check, EndsDifferentlyWhereSomethingIsHarmful) {
    write_cross();
    const Outcome text = run("-q check cross.obj");
    EXPECT_EQ(text.exit_code, bad_input);
    EXPECT_NE(text.out.find("! object-intersection"), std::string::npos) << text.out;
    EXPECT_NE(text.out.find("'floor', 1 triangles: object-intersection 1"), std::string::npos)
        << text.out;
    EXPECT_EQ(text.out.find("t-junction"), std::string::npos) << text.out;
    const auto report = nlohmann::json::parse(run("-q check cross.obj --json").out);
    EXPECT_FALSE(report["sound"].get<bool>());
    EXPECT_EQ(report["counts"]["object-intersection"], 1);
    EXPECT_EQ(report["counts"]["border-edge"], 6);
    EXPECT_EQ(report["objects"][1]["counts"]["object-intersection"], 1);
}

TEST_F(Check, WritesDefectsAndWaysOut) {
    write_room("0.5", "1");
    write_cross();
    EXPECT_EQ(run("-q check cross.obj --vtk defects.vtp").exit_code, bad_input);
    const std::string defects = read("defects.vtp");
    for (const char* name : {"PolyData", "Defect", "Polygon", "Other", "Object", "DefectNames"})
        EXPECT_NE(defects.find(name), std::string::npos) << name;
    EXPECT_EQ(run("-q check room.obj --leak-path way.vtp").exit_code, done);
    EXPECT_NE(read("way.vtp").find("Width"), std::string::npos);
}

TEST_F(Check, TellsAllInItsJson) {
    write("gap.mtl", "newmtl lamp\nKe 1 1 1\n");
    // A room of 4 units that stands open by 0.01 along an edge, and a lamp in it.
    write("gap.obj",
          "mtllib gap.mtl\n"
          "v 0 0 0\nv 4 0 0\nv 4 4 0\nv 0 4 0\nv 0 0 4\nv 4 0 4\nv 4 4 4\nv 0 4 4\n"
          "v 0 3.99 4\nv 4 3.99 4\nv 1 1 3\nv 1 3 3\nv 3 3 3\nv 3 1 3\n"
          "o room\nf 1 2 3 4\nf 5 9 10 6\nf 1 5 6 2\nf 4 3 7 8\nf 1 4 8 9 5\nf 2 6 10 7 3\n"
          "o lamp\nusemtl lamp\nf 11 12 13 14\n");
    const Outcome o = run("-q check gap.obj --json --vtk out/gap.vtp --leak-path out/way.vtp");
    EXPECT_EQ(o.exit_code, bad_input) << o.err;
    const auto report = nlohmann::json::parse(o.out);
    std::set<std::string> names;
    for (const auto& [name, value] : report.items()) names.insert(name);
    EXPECT_EQ(names,
              (std::set<std::string>{"polygons", "triangles", "vertices", "diagonal", "thresholds",
                                     "sound", "counts", "harmful", "objects", "components",
                                     "thinnest_wall", "leaks_searched", "leaks"}));
    EXPECT_EQ(report["polygons"], 7);
    EXPECT_EQ(report["triangles"], 16);
    EXPECT_EQ(report["vertices"], 14);
    EXPECT_EQ(report["thresholds"].size(), 4u);
    for (const auto& [name, count] : report["counts"].items())
        EXPECT_EQ(count, name == "border-edge" ? 8 : name == "leak" ? 1 : 0) << name;
    for (const auto& name : report["harmful"]) EXPECT_TRUE(report["counts"].contains(name));
    ASSERT_EQ(report["components"].size(), 2u);
    const auto& room = report["components"][0];
    EXPECT_EQ(room["faces"], 14);
    EXPECT_EQ(room["object"], 0);
    EXPECT_FALSE(room["closed"].get<bool>());
    EXPECT_TRUE(room["orientable"].get<bool>());
    EXPECT_EQ(room["volume"], 0.0);
    EXPECT_EQ(room["borders"], 1);
    ASSERT_EQ(report["objects"].size(), 2u);
    EXPECT_EQ(report["objects"][1]["name"], "lamp");
    EXPECT_EQ(report["objects"][1]["triangles"], 2);
    ASSERT_EQ(report["leaks"].size(), 1u);
    const auto& leak = report["leaks"][0];
    EXPECT_EQ(leak["from"], "luminaire 'lamp'");
    EXPECT_NEAR(leak["width"].get<double>(), 0.01, 1e-9);
    EXPECT_FALSE(leak["opening"].get<bool>());
    EXPECT_GE(leak["path"].size(), 2u);
    EXPECT_GT(leak["length"], 0.0);
    EXPECT_EQ(listing("out"), (std::set<std::string>{"gap.vtp", "way.vtp"}));
}

TEST_F(Check, WritesFilesWhereThereIsNothingToo) {
    write_room("0.5", "1");
    const Outcome o =
        run("-q check room.obj --no-leaks --vtk out/none.vtp --leak-path out/way.vtp");
    EXPECT_EQ(o.exit_code, done) << o.err;
    EXPECT_NE(o.out.find("leaks: not searched"), std::string::npos) << o.out;
    EXPECT_EQ(listing("out"), (std::set<std::string>{"none.vtp", "way.vtp"}));
}

TEST_F(Check, RefusesWhatItCannotUse) {
    write_cross();
    EXPECT_EQ(run("check cross.obj --needle nan").exit_code, usage);
    EXPECT_EQ(run("check cross.obj --tolerance 1.1e-3").exit_code, usage);
    EXPECT_NE(run("check cross.obj --tolerance 1e-3").exit_code, usage);
    EXPECT_EQ(run("check").exit_code, usage);
    EXPECT_EQ(run("check nothing.obj").exit_code, io_failed);
    EXPECT_EQ(run("check cross.obj --vtk no/folder.vtp").exit_code, io_failed);
}

}  // namespace

}  // namespace transillum
