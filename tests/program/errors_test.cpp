// What a user does wrong: the exit code, one line that names the place, and nothing left behind.
#include "program/program.h"

#include <algorithm>
#include <vector>

namespace transillum {

namespace {

constexpr int usage = 2, bad_input = 3, io_failed = 4;

struct Mistake {
    const char* name;
    const char* arguments;
    int exit_code;
    std::vector<std::string> named;  ///< parts of the message
};

void PrintTo(const Mistake& mistake, std::ostream* out) {
    *out << mistake.arguments;
}

std::string name_of(const testing::TestParamInfo<Mistake>& info) {
    return info.param.name;
}

class Mistakes : public Program, public testing::WithParamInterface<Mistake> {
protected:
    void expect_refused(const Mistake& m) const {
        const Outcome o = run(m.arguments);
        EXPECT_EQ(o.exit_code, m.exit_code) << o.err;
        EXPECT_TRUE(o.err.starts_with("transillum: ")) << o.err;
        EXPECT_EQ(std::ranges::count(o.err, '\n'), 1) << o.err;
        for (const std::string& part : m.named)
            EXPECT_NE(o.err.find(part), std::string::npos) << o.err;
        EXPECT_EQ(o.out, "");
        EXPECT_EQ(listing("out"), std::set<std::string>());
    }
};

using CommandLine = Mistakes;

TEST_P(CommandLine, IsRefused) {
    write_room("0.5", "1");
    expect_refused(GetParam());
}

INSTANTIATE_TEST_SUITE_P(
    Program, CommandLine,
    testing::Values(
        Mistake{"NoSubcommand", "", usage, {"subcommand"}},
        Mistake{"UnknownOption", "bake room.obj -o out/s.vtm --shiny", usage, {"--shiny"}},
        Mistake{"UnknownOptionAlone", "bake --shiny", usage, {"--shiny"}},
        Mistake{"UnknownWord",
                "bake room.obj -o out/s.vtm --first-shot maybe",
                usage,
                {"--first-shot", "maybe", "hemicube"}},
        Mistake{"SubdivisionWithoutLimit",
                "subdivide room.obj -o out/s.obj",
                usage,
                {"--max-edge", "--max-level"}},
        Mistake{"SubdivisionToUnknownFormat",
                "subdivide room.obj --max-level 1 -o out/s.fbx",
                usage,
                {"fbx", ".gltf .glb .obj .ply .stl .off"}},
        Mistake{"SubdivisionTooFine",
                "subdivide room.obj --max-edge 1e-9 -o out/s.obj",
                usage,
                {"1e-09", "accepted: at least"}},
        Mistake{"UnknownProgress", "--progress loud info room.vtm", usage, {"--progress", "loud"}},
        Mistake{"QuietAndVerbose", "-q -v info room.vtm", usage, {"--quiet", "--verbose"}},
        Mistake{"NotANumber",
                "bake room.obj -o out/s.vtm --iterations many",
                usage,
                {"--iterations", "many"}},
        Mistake{"NoIterations",
                "bake room.obj -o out/s.vtm --iterations 0",
                usage,
                {"--iterations", "0"}},
        Mistake{
            "NegativeThreads", "bake room.obj -o out/s.vtm --threads -1", usage, {"threads", "-1"}},
        Mistake{"NanCreaseAngle",
                "bake room.obj -o out/s.vtm --crease-angle nan",
                usage,
                {"--crease-angle"}},
        Mistake{"NanTime", "bake room.obj -o out/s.vtm --time nan", usage, {"--time"}},
        Mistake{"NanPatchSize", "bake room.obj -o out/s.vtm --patch-size nan", usage, {"patch"}},
        Mistake{"NoAlbedo", "bake room.obj -o out/s.vtm --max-albedo 0", usage, {"albedo", "0"}},
        Mistake{
            "NanAlbedo", "bake room.obj -o out/s.vtm --max-albedo nan", usage, {"albedo", "nan"}},
        Mistake{"UnknownEnvironment",
                "bake room.obj -o out/s.vtm --environment overcats:3",
                usage,
                {"--environment", "overcats:3", "overcast:L"}},
        Mistake{"PhotometryOfNoLight",
                "bake room.obj -o out/s.vtm --light-photometry lamp",
                usage,
                {"--light-photometry", "lamp", "NAME=FILE.ies"}},
        Mistake{"OutputOfAnotherKind", "bake room.obj -o out/s.vtk", usage, {"out/s.vtk", ".vtm"}},
        Mistake{"OutputFolderMissing",
                "bake room.obj -o out/no/s.vtm",
                io_failed,
                {"out/no/s.vtm", "folder"}},
        Mistake{
            "OutputFolderUnwritable", "bake room.obj -o /proc/s.vtm", io_failed, {"/proc/s.vtm"}},
        Mistake{
            "MissingScene", "bake none.obj -o out/s.vtm", io_failed, {"none.obj", "No such file"}},
        Mistake{
            "SceneOfAnotherKind", "bake room.mtl -o out/s.vtm", bad_input, {"room.mtl", ".gltf"}}),
    name_of);

using View = Mistakes;

TEST_P(View, IsRefused) {
    write_room("0.5", "1");
    bake_room("room.vtm");
    ASSERT_EQ(run("-q render room.vtm -o small.exr --size 4x4").exit_code, 0);
    ASSERT_EQ(run("-q render room.vtm -o wide.exr --size 8x4").exit_code, 0);
    expect_refused(GetParam());
}

INSTANTIATE_TEST_SUITE_P(
    Program, View,
    testing::Values(
        Mistake{
            "NoHeight", "render room.vtm -o out/p.png --size 640x0", usage, {"--size", "640x0"}},
        Mistake{
            "SizeOfWords", "render room.vtm -o out/p.png --size large", usage, {"--size", "large"}},
        Mistake{"UnknownCamera", "render room.vtm -o out/p.png --camera top", usage, {"top"}},
        Mistake{"EyeAlone", "render room.vtm -o out/p.png --eye 1,2,3", usage, {"--look-at"}},
        Mistake{"NanEye",
                "render room.vtm -o out/p.png --eye nan,0,0 --look-at 0,0,0",
                usage,
                {"--eye"}},
        Mistake{"EyeAtTarget",
                "render room.vtm -o out/p.png --eye 0,0,0 --look-at 0,0,0",
                usage,
                {"--look-at"}},
        Mistake{"FlatView",
                "render room.vtm -o out/p.png --eye 0,0,0 --look-at 0,0,1 --fov 180",
                usage,
                {"--fov", "180"}},
        Mistake{"NanExposure", "render room.vtm -o out/p.png --exposure nan", usage, {"exposure"}},
        Mistake{
            "PictureOfAnotherKind", "render room.vtm -o out/p.jpg", usage, {"out/p.jpg", ".png"}},
        Mistake{
            "PictureFolderMissing", "render room.vtm -o out/no/p.png", io_failed, {"out/no/p.png"}},
        Mistake{"MissingSolution",
                "render none.vtm -o out/p.png",
                io_failed,
                {"none.vtm", "No such file"}},
        Mistake{"ExportToAnotherKind", "export room.vtm -o out/s.obj", usage, {"s.obj", ".glb"}},
        Mistake{"ExportOfAnotherComponent",
                "export room.vtm -o out/s.glb --components monte-carlo",
                usage,
                {"--components", "monte-carlo"}},
        Mistake{"ExportToMissingFolder", "export room.vtm -o out/no/s.glb", io_failed, {"out/no"}},
        Mistake{"ExportOfNothing", "export none.vtm -o out/s.glb", io_failed, {"none.vtm"}},
        Mistake{"MissingSolutionOfInfo", "info none.vtm", io_failed, {"none.vtm", "No such file"}},
        Mistake{"MonteCarloByGuess",
                "render room.vtm -o out/p.png --monte-carlo guess",
                usage,
                {"--monte-carlo", "guess", "subpatch"}},
        Mistake{"MonteCarloLeftOut",
                "render room.vtm -o out/p.png --monte-carlo wavefront --components emission,direct",
                usage,
                {"--monte-carlo", "--components"}},
        Mistake{"NoBundles",
                "render room.vtm -o out/p.png --monte-carlo subpatch --iterations 0",
                usage,
                {"--iterations", "0"}},
        Mistake{"ComparedSizesDiffer", "compare small.exr wide.exr", bad_input, {"4x4", "8x4"}},
        Mistake{"ComparedKindsDiffer", "compare small.exr room.vtm", usage, {"image"}},
        Mistake{"ComparedImageMissing", "compare small.exr none.exr", io_failed, {"none.exr"}}),
    name_of);

struct Damage {
    const char* name;
    const char* file;
    const char* bytes;
    std::vector<std::string> named;
};

void PrintTo(const Damage& damage, std::ostream* out) {
    *out << damage.name;
}

class DamagedScene : public Program, public testing::WithParamInterface<Damage> {};

TEST_P(DamagedScene, IsRefused) {
    const Damage& d = GetParam();
    write(d.file, d.bytes);
    const Outcome o = run(std::string("bake ") + d.file + " -o out/s.vtm");
    EXPECT_EQ(o.exit_code, bad_input) << o.err;
    EXPECT_EQ(std::ranges::count(o.err, '\n'), 1) << o.err;
    for (const std::string& part : d.named) EXPECT_NE(o.err.find(part), std::string::npos) << o.err;
    EXPECT_EQ(listing("out"), std::set<std::string>());
}

INSTANTIATE_TEST_SUITE_P(
    Program, DamagedScene,
    testing::Values(Damage{"Empty", "a.obj", "", {"a.obj", "empty"}},
                    Damage{"TruncatedGltf",
                           "a.gltf",
                           R"({"asset": {"version": "2.0"}, "meshes": [{"primi)",
                           {"a.gltf", "line 1"}},
                    Damage{"IndexOutOfRange",
                           "a.obj",
                           "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 4\n",
                           {"a.obj:4", "vertex 4 of 3"}},
                    Damage{"NanCoordinate",
                           "a.obj",
                           "v 0 0 0\nv nan 0 0\nv 0 1 0\nf 1 2 3\n",
                           {"a.obj:2", "nan", "finite"}},
                    Damage{
                        "NoFace", "a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\n", {"a.obj", "no polygon"}},
                    Damage{"NeitherLightNorArea",
                           "a.obj",
                           "v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n",
                           {"a.obj", "no light"}},
                    Damage{"NoLight",
                           "a.obj",
                           "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n",
                           {"a.obj", "no light", "Ke"}}),
    [](const auto& info) { return std::string(info.param.name); });

struct Paint {
    const char* name;
    const char* albedo;
    const char* emission;
    const char* wall_lines;
    const char* options;
    int exit_code;
    std::vector<std::string> named;
};

void PrintTo(const Paint& paint, std::ostream* out) {
    *out << paint.name;
}

class BadMaterial : public Program, public testing::WithParamInterface<Paint> {};

TEST_P(BadMaterial, IsRefused) {
    const Paint& p = GetParam();
    write_room(p.albedo, p.emission, p.wall_lines);
    const Outcome o = run(std::string("-q bake room.obj -o out/s.vtm --leaves 100 ") + p.options);
    EXPECT_EQ(o.exit_code, p.exit_code) << o.err;
    EXPECT_EQ(std::ranges::count(o.err, '\n'), 1) << o.err;
    for (const std::string& part : p.named) EXPECT_NE(o.err.find(part), std::string::npos) << o.err;
    EXPECT_EQ(listing("out"), std::set<std::string>());
}

INSTANTIATE_TEST_SUITE_P(
    Program, BadMaterial,
    testing::Values(
        Paint{"AlbedoAboveOne", "1.5", "1", "", "", bad_input, {"room.mtl:2", "Kd is 1.5"}},
        Paint{"NegativeEmission", "0.5", "-1", "", "", bad_input, {"room.mtl:5", "Ke is -1"}},
        Paint{"NanEmission", "0.5", "nan", "", "", bad_input, {"room.mtl:5", "nan"}},
        Paint{"DarkLamp", "0.5", "0", "", "", bad_input, {"room.obj", "no light"}},
        Paint{"NothingAbsorbs", "1", "1", "", "--max-albedo 1", usage, {"albedo", "never fade"}}),
    [](const auto& info) { return std::string(info.param.name); });

using MissingTexture = Program;

TEST_F(MissingTexture, IsNamedAndDoneWithout) {
    write_room("0.5", "1", "map_Kd none.png\n");
    const Outcome o = run("bake room.obj -o s.vtm --leaves 100 --iterations 4");
    EXPECT_EQ(o.exit_code, 0) << o.err;
    EXPECT_NE(o.err.find("'wall': its texture 'none.png' is not there; 0.5 0.5 0.5 is taken"),
              std::string::npos)
        << o.err;
}

using DamagedSolution = Program;

TEST_F(DamagedSolution, TruncatedIndexIsRefused) {
    write_room("0.5", "1");
    bake_room("room.vtm");
    write("room.vtm", read("room.vtm").substr(0, 200));
    const Outcome o = run("render room.vtm -o out/p.png");
    EXPECT_EQ(o.exit_code, bad_input);
    EXPECT_TRUE(o.err.starts_with("transillum: room.vtm: ")) << o.err;
    EXPECT_EQ(listing("out"), std::set<std::string>());
}

TEST_F(DamagedSolution, TruncatedPieceIsRefused) {
    write_room("0.5", "1");
    bake_room("room.vtm");
    const std::string bytes = read("room/radiance.vtp");
    write("room/radiance.vtp", bytes.substr(0, bytes.size() / 2));
    const Outcome o = run("info room.vtm");
    EXPECT_EQ(o.exit_code, bad_input);
    EXPECT_TRUE(o.err.starts_with("transillum: room/radiance.vtp: ")) << o.err;
    EXPECT_EQ(o.out, "");
}

TEST_F(DamagedSolution, ForeignFileIsRefused) {
    write("other.vtm",
          "<VTKFile type=\"vtkMultiBlockDataSet\" "
          "version=\"1.0\"><vtkMultiBlockDataSet/></VTKFile>\n");
    const Outcome o = run("render other.vtm -o out/p.png");
    EXPECT_EQ(o.exit_code, bad_input);
    EXPECT_NE(o.err.find("other.vtm: not a transillum solution"), std::string::npos) << o.err;
    EXPECT_EQ(listing("out"), std::set<std::string>());
}

TEST_F(DamagedSolution, FailingBakeLeavesTheOlderOneWhole) {
    write_room("0.5", "1");
    bake_room("out/s.vtm");
    const std::string index = read("out/s.vtm"), radiance = read("out/s/radiance.vtp");
    write_room("0.5", "0");
    EXPECT_EQ(run("bake room.obj -o out/s.vtm").exit_code, bad_input);
    EXPECT_EQ(read("out/s.vtm"), index);
    EXPECT_EQ(read("out/s/radiance.vtp"), radiance);
    EXPECT_EQ(run("info out/s.vtm").exit_code, 0);
}

}  // namespace

}  // namespace transillum
