// What repair and subdivide write, and how they end.
#include "program/program.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <map>
#include <string>
#include <vector>

namespace transillum {

namespace {

constexpr int done = 0, usage = 2, bad_input = 3, io_failed = 4;
const std::vector<std::string> formats{"obj", "ply", "stl", "off", "gltf", "glb"};

class Repair : public Program {
protected:
    /// A room with a wall there twice, one turned, one cut in two (T-junctions), a face without
    /// area and a blade through a wall.
    void write_dirty_room() const {
        write_room("0.5", "1");
        write("dirty.obj",
              "mtllib room.mtl\n"
              "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\n"
              "v 0.5 0 0\nv 0.5 1 0\nv -0.5 0.25 0.5\nv 0.5 0.25 0.5\nv 0 0.75 0.5\n"
              "o room\nusemtl wall\nf 1 5 6 2\nf 1 9 10 4\nf 9 2 3 10\nf 5 8 7 6\nf 5 8 7 6\n"
              "f 1 4 8 5\nf 3 7 6 2\nf 1 9 2\nusemtl lamp\nf 4 3 7 8\n"
              "o blade\nusemtl wall\nf 11 12 13\n");
    }
    /// Nothing but the scene, and what belongs to its format.
    void expect_only(const std::string& stem) const {
        for (const std::string& name : listing("out"))
            EXPECT_EQ(std::filesystem::path(name).stem(), stem) << name;
    }
    [[nodiscard]] std::uint64_t triangles_of(const std::string& file) const {
        const Outcome o = run("-q check " + file + " --no-leaks --json");
        return nlohmann::json::parse(o.out)["triangles"].get<std::uint64_t>();
    }
};

TEST_F(Repair, WritesEveryFormatSound) {
    write_dirty_room();
    EXPECT_EQ(run("-q check dirty.obj").exit_code, bad_input);
    for (const std::string& format : formats) {
        const std::string file = "out/fixed." + format;
        const Outcome o = run("-q repair dirty.obj -o " + file);
        EXPECT_EQ(o.exit_code, done) << o.err;
        EXPECT_NE(o.out.find("nothing harmful (!) is left"), std::string::npos) << o.out;
        EXPECT_NE(o.out.find(file), std::string::npos) << o.out;
        const Outcome check = run("-q check " + file);
        EXPECT_EQ(check.exit_code, done) << file << '\n' << check.out << check.err;
        expect_only("fixed");
    }
}

TEST_F(Repair, TellsWhatWasDone) {
    write_dirty_room();
    const Outcome o = run("-q repair dirty.obj -o out/fixed.obj --json");
    ASSERT_EQ(o.exit_code, done) << o.err;
    const auto report = nlohmann::json::parse(o.out);
    EXPECT_EQ(report["output"], "out/fixed.obj");
    EXPECT_TRUE(report["sound"].get<bool>());
    EXPECT_EQ(report["pairs_left"], 0);
    EXPECT_TRUE(report["left"].empty());
    EXPECT_GT(report["crossing_pairs"], 0);
    EXPECT_GT(report["faces_made"], report["faces_cut"]);
    std::set<std::string> steps;
    for (const auto& step : report["steps"]) {
        EXPECT_GT(step["count"], 0);
        steps.insert(step["what"]);
    }
    for (const char* step : {"dropped duplicate faces", "cut faces where they meet",
                             "turned faces against their neighbours"})
        EXPECT_TRUE(steps.contains(step)) << o.out;
    for (const char* when : {"before", "after"}) EXPECT_EQ(report[when].size(), 20u);
    EXPECT_EQ(report["before"]["duplicate-face"], 2);
    EXPECT_EQ(report["after"]["duplicate-face"], 0);
    const Outcome unchecked = run("-q repair dirty.obj -o out/fixed.obj --json --no-check");
    EXPECT_EQ(unchecked.exit_code, done);
    EXPECT_FALSE(nlohmann::json::parse(unchecked.out).contains("after"));
}

TEST_F(Repair, SaysWhereThereIsNothingToDo) {
    write_room("0.5", "1");
    const Outcome o = run("-q repair room.obj -o out/same.obj");
    EXPECT_EQ(o.exit_code, done) << o.err;
    EXPECT_NE(o.out.find("nothing to repair"), std::string::npos) << o.out;
    EXPECT_EQ(run("-q check out/same.obj").exit_code, done);
    EXPECT_EQ(triangles_of("out/same.obj"), 12u);
}

TEST_F(Repair, DoesNoMoreThanItsLevel) {
    write_dirty_room();
    const auto report = [&](const std::string& level) {
        return nlohmann::json::parse(
            run("-q repair dirty.obj -o out/fixed.obj --json --level " + level).out);
    };
    EXPECT_TRUE(report("off")["steps"].empty());
    const auto safe = report("safe");
    EXPECT_EQ(safe["faces_cut"], 0);
    EXPECT_FALSE(safe["sound"].get<bool>());
    EXPECT_EQ(safe["after"]["duplicate-face"], 0);
    EXPECT_GT(safe["after"]["object-intersection"], 0);
}

TEST_F(Repair, LeavesNothingBehindWhereItFails) {
    write_dirty_room();
    write("torn.obj", "v 0 0 0\nv 1 0 0\nf 1 2 9\n");
    const auto expect = [&](const std::string& arguments, int exit_code, const char* named) {
        const Outcome o = run(arguments);
        EXPECT_EQ(o.exit_code, exit_code) << arguments << '\n' << o.err;
        EXPECT_NE(o.err.find(named), std::string::npos) << o.err;
        EXPECT_EQ(std::ranges::count(o.err, '\n'), 1) << o.err;
        EXPECT_EQ(listing("out"), std::set<std::string>());
    };
    expect("repair dirty.obj -o out/fixed.fbx", usage, ".gltf .glb .obj .ply .stl .off");
    expect("repair dirty.obj -o out/no/fixed.obj", io_failed, "out/no");
    expect("repair torn.obj -o out/fixed.obj", bad_input, "torn.obj:3");
    expect("repair nothing.obj -o out/fixed.obj", io_failed, "nothing.obj");
    expect("repair dirty.obj -o out/fixed.obj --level most", usage, "--level");
    expect("repair dirty.obj -o out/fixed.obj --tolerance 1.1e-3", usage, "--tolerance");
}

TEST_F(Repair, RefusesToWriteNothing) {
    write("flat.obj", "v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n");
    const Outcome o = run("repair flat.obj -o out/fixed.obj");
    EXPECT_EQ(o.exit_code, bad_input);
    EXPECT_NE(o.err.find("flat.obj: no face with an area"), std::string::npos) << o.err;
    EXPECT_EQ(listing("out"), std::set<std::string>());
}

TEST_F(Repair, IsPartOfBaking) {
    write_dirty_room();
    const std::map<std::string, std::string> said{{"off", "no repair: --repair off"},
                                                  {"safe", "meshes repaired: "},
                                                  {"full", "cut faces where they meet"}};
    for (const auto& [level, decision] : said) {
        const Outcome o = run("-q bake dirty.obj -o out/" + level +
                              ".vtm --leaves 50 --iterations 4 --resolution 32 --repair " + level);
        ASSERT_EQ(o.exit_code, done) << o.err;
        const auto info = nlohmann::json::parse(run("info out/" + level + ".vtm --json").out);
        EXPECT_EQ(info["settings"]["repair"], level);
        EXPECT_TRUE(std::ranges::any_of(info["decisions"], [&](const auto& d) {
            return d.template get<std::string>().find(decision) != std::string::npos;
        })) << info["decisions"];
    }
    EXPECT_EQ(run("bake dirty.obj -o out/most.vtm --repair most").exit_code, usage);
}

using Subdivide = Repair;

TEST_F(Subdivide, WritesEveryFormatFiner) {
    write_room("0.5", "1");
    for (const std::string& format : formats) {
        const std::string file = "out/fine." + format;
        const Outcome o = run("-q subdivide room.obj --max-level 2 -o " + file);
        EXPECT_EQ(o.exit_code, done) << o.err;
        EXPECT_EQ(triangles_of(file), 12u * 16u) << file;
        EXPECT_EQ(run("-q check " + file).exit_code, done) << file;
        expect_only("fine");
    }
    EXPECT_EQ(run("-q subdivide room.obj --max-edge 0.2 -o out/fine.obj").exit_code, done);
    EXPECT_GE(triangles_of("out/fine.obj"), 12u * 25u);
    EXPECT_EQ(run("-q check out/fine.obj").exit_code, done);
}

}  // namespace

}  // namespace transillum
