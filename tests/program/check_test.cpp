// What check says, and how it ends.
#include "program/program.h"

#include <nlohmann/json.hpp>

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

TEST_F(Check, RefusesWhatItCannotUse) {
    write_cross();
    EXPECT_EQ(run("check cross.obj --needle nan").exit_code, usage);
    EXPECT_EQ(run("check").exit_code, usage);
    EXPECT_EQ(run("check nothing.obj").exit_code, io_failed);
    EXPECT_EQ(run("check cross.obj --vtk no/folder.vtp").exit_code, io_failed);
}

}  // namespace

}  // namespace transillum
