// What must hold for the results of the program, whatever they are.
#include "program/program.h"

#include <transillum/solution/load_solution.h>

#include <nlohmann/json.hpp>

namespace transillum {

namespace {

constexpr const char* cornell = TRANSILLUM_SOURCE_DIR "/data/scenes/cornell.gltf";
const std::string coarse = " --leaves 500 --iterations 32 --resolution 128 --hemicube 64 ";

class Results : public Program {
protected:
    void bake_cornell(const std::string& name, const std::string& options = {}) const {
        const Outcome o = run(std::string("-q bake ") + cornell + " -o " + name + coarse + options);
        ASSERT_EQ(o.exit_code, 0) << o.err;
    }
};

TEST_F(Results, DoNotDependOnTheNumberOfThreads) {
    bake_cornell("one.vtm", "--threads 1");
    const std::set<std::string> pieces = listing("one");
    ASSERT_TRUE(pieces.contains("radiance.vtp") && pieces.contains("incoming.vtp"));
    for (const char* threads : {"2", "8"}) {
        const std::string name = std::string("with_") + threads;
        bake_cornell(name + ".vtm", std::string("--threads ") + threads);
        ASSERT_EQ(listing(name), pieces);
        for (const std::string& piece : pieces) {
            if (piece == "run.json") continue;
            EXPECT_TRUE(read(name + "/" + piece) == read("one/" + piece))
                << threads << ' ' << piece;
        }
        // Alike but for the folder they name.
        std::string index = read(name + ".vtm");
        for (std::size_t at; (at = index.find(name + "/")) != std::string::npos;)
            index.replace(at, name.size(), "one");
        EXPECT_EQ(index, read("one.vtm"));
    }
}

TEST_F(Results, AreFoundAgainWhereNothingChanged) {
    bake_cornell("box.vtm");
    const auto written = [&] {
        return std::filesystem::last_write_time(folder_ / "box" / "radiance.vtp");
    };
    const auto before = written();
    const std::string command = std::string("bake ") + cornell + " -o box.vtm" + coarse;
    const Outcome same = run(command + "--threads 1");
    EXPECT_EQ(same.exit_code, 0) << same.err;
    EXPECT_NE(same.err.find("unchanged"), std::string::npos) << same.err;
    EXPECT_NE(same.out.find("32 iterations"), std::string::npos) << same.out;
    EXPECT_EQ(written(), before);
    for (const char* option : {"--again", "--seed 2", "--max-albedo 0.5"}) {
        const Outcome other = run(command + option);
        EXPECT_EQ(other.exit_code, 0) << other.err;
        EXPECT_EQ(other.err.find("unchanged"), std::string::npos) << option;
        EXPECT_NE(written(), before) << option;
    }
}

// Wherever memory lies: addresses are random in each run, and once not at all.
TEST_F(Results, AreTheSameInEveryRun) {
    const std::string bake =
        std::string("\"$TRANSILLUM\" -q bake ") + cornell + coarse + "-o box.vtm";
    const bool fixes = shell("setarch --addr-no-randomize true").exit_code == 0;
    const std::vector<std::string> runs{bake, bake,
                                        fixes ? "setarch --addr-no-randomize " + bake : bake};
    std::set<std::string> pieces;
    for (std::size_t i = 0; i < runs.size(); ++i) {
        const Outcome o =
            shell("mkdir " + std::to_string(i) + " && cd " + std::to_string(i) + " && " + runs[i]);
        ASSERT_EQ(o.exit_code, 0) << o.err;
        pieces = listing(std::to_string(i) + "/box");
        pieces.erase("run.json");
        EXPECT_TRUE(read(std::to_string(i) + "/box.vtm") == read("0/box.vtm"));
        for (const std::string& piece : pieces)
            EXPECT_TRUE(read(std::to_string(i) + "/box/" + piece) == read("0/box/" + piece))
                << "run " << i << ", " << piece;
    }
    EXPECT_TRUE(pieces.contains("radiance.vtp"));
}

TEST_F(Results, OfRefinedPatchesDoNotDependOnTheNumberOfThreads) {
    const std::string options = "--refine 2 --refine-tolerance 0.3 --threads ";
    bake_cornell("one.vtm", options + "1");
    bake_cornell("two.vtm", options + "2");
    for (const char* piece : {"radiance.vtp", "surface.vtp"})
        EXPECT_TRUE(read(std::string("one/") + piece) == read(std::string("two/") + piece))
            << piece;
    EXPECT_GT(load_solution(folder_ / "one.vtm").patches.mixed_roots.size(), 0u);
}

// Every phase is a solution, and a list says in which order they come.
TEST_F(Results, KeepThePhasesOfRefinement) {
    bake_cornell("box.vtm", "--refine 2 --phases");
    const std::string list = read("box-phases.pvd");
    std::uint32_t leaves = 0;
    for (const char* number : {"0", "1"}) {
        const std::string name = std::string("box-phases/phase-0") + number + ".vtm";
        EXPECT_NE(list.find(std::string("timestep=\"") + number + "\" file=\"" + name + '"'),
                  std::string::npos)
            << list;
        const Solution phase = load_solution(folder_ / name);
        EXPECT_GT(phase.patches.leaf_count, leaves);
        leaves = phase.patches.leaf_count;
    }
    const Outcome o = run(std::string("bake ") + cornell + " -o other.vtm --phases");
    EXPECT_EQ(o.exit_code, 2);
    EXPECT_NE(o.err.find("--refine"), std::string::npos) << o.err;
}

// What tables would need is known before it is taken.
TEST_F(Results, AreRefusedWhereTheyWouldTakeTooMuchMemory) {
    const Outcome o = run(std::string("bake ") + cornell + " -o box.vtm --memory 0.001");
    EXPECT_EQ(o.exit_code, 2);
    EXPECT_NE(o.err.find("light samples"), std::string::npos) << o.err;
    EXPECT_NE(o.err.find("accepted: 0.00 in all"), std::string::npos) << o.err;
}

TEST_F(Results, KeepLightVectorsWhereAskedTo) {
    const Outcome o = run(std::string("bake ") + cornell +
                          " -o box.vtm --leaves 200 --iterations 8 --first-shot vectors");
    ASSERT_EQ(o.exit_code, 0) << o.err;
    EXPECT_NE(o.err.find("1 light vector a patch"), std::string::npos) << o.err;
    const Outcome info = run("info box.vtm");
    EXPECT_NE(info.out.find("light vectors          1 a patch"), std::string::npos) << info.out;
    EXPECT_EQ(run("render box.vtm -o box.exr --size 8x8 --direct stored").exit_code, 0);
    EXPECT_EQ(run("render box.vtm -o box.exr --size 8x8 --direct traced").exit_code, 0);
}

// Mirrors cast light that direction bins can't hold; glossy walls don't.
TEST_F(Results, SayHowMuchLightMeetsSharpLobes) {
    for (const bool sharp : {false, true}) {
        write_room("0.3", "1",
                   std::string("Ks 0.5 0.5 0.5\nillum 2\nNs ") + (sharp ? "1000\n" : "10\n"));
        const Outcome o = run("bake room.obj -o room.vtm --leaves 100 --iterations 64");
        ASSERT_EQ(o.exit_code, 0) << o.err;
        EXPECT_EQ(o.err.find("lobes sharper than direction bins can hold") != std::string::npos,
                  sharp)
            << o.err;
        EXPECT_NE(o.err.find("direction bins on"), std::string::npos) << o.err;
    }
}

// A red floor under a uniform sky sends back its share of it.
TEST_F(Results, OfAnOpenSceneSeeTheEnvironment) {
    write("floor.obj",
          "mtllib floor.mtl\nusemtl m\nv 0 0 0\nv 1 0 0\nv 1 0 -1\nv 0 0 -1\nf 1 2 3 4\n");
    write("floor.mtl", "newmtl m\nKd 0.5 0.25 0\n");
    const Outcome o =
        run("-q bake floor.obj -o floor.vtm --leaves 100 --environment uniform:2,2,2");
    ASSERT_EQ(o.exit_code, 0) << o.err;
    const Solution floor = load_solution(folder_ / "floor.vtm");
    for (std::uint32_t p = 0; p < floor.patches.patch_count(); ++p) {
        const Spectrum radiance = floor.finite_element_radiance(p);
        EXPECT_NEAR(radiance.x, 1.0f, 1e-3f);
        EXPECT_NEAR(radiance.y, 0.5f, 1e-3f);
        EXPECT_EQ(radiance.z, 0.0f);
    }
}

TEST_F(Results, DependOnTheSeed) {
    bake_cornell("a.vtm", "--seed 1");
    bake_cornell("b.vtm", "--seed 2");
    EXPECT_FALSE(read("a/radiance.vtp") == read("b/radiance.vtp"));
}

/// Doubling is exact in binary arithmetic, so the radiance is doubled to the last bit, as long as
/// the fixed-point scale of the transport follows the emission.
TEST_F(Results, DoubleWithTheEmission) {
    for (const std::string first_shot : {"off", "hemicube"}) {
        write_room("0.5", "1.25");
        bake_room("single.vtm", "--hemicube 64 --first-shot " + first_shot);
        write_room("0.5", "2.5");
        bake_room("double.vtm", "--hemicube 64 --first-shot " + first_shot);
        const Solution one = load_solution(folder_ / "single.vtm"),
                       two = load_solution(folder_ / "double.vtm");
        ASSERT_EQ(one.patches.patch_count(), two.patches.patch_count());
        float brightest = 0.0f;
        for (std::uint32_t p = 0; p < one.patches.patch_count(); ++p) {
            EXPECT_EQ(2.0f * one.emission(p), two.emission(p));
            EXPECT_EQ(2.0f * one.direct_radiance(p), two.direct_radiance(p)) << p;
            EXPECT_EQ(2.0f * one.finite_element_radiance(p), two.finite_element_radiance(p)) << p;
            brightest = std::max(brightest, max_channel(one.finite_element_radiance(p)));
        }
        EXPECT_GT(brightest, 0.0f);
    }
}

TEST_F(Results, RenderWithoutTheScene) {
    write_room("0.5", "1");
    bake_room("room.vtm");
    std::filesystem::remove(folder_ / "room.obj");
    std::filesystem::remove(folder_ / "room.mtl");
    const Outcome o =
        run("-q render room.vtm -o out/p.png -o out/p.exr --size 16x12 --eye 0.5,0.5,0.9 --look-at "
            "0.5,0.5,0");
    EXPECT_EQ(o.exit_code, 0) << o.err;
    EXPECT_EQ(listing("out"), (std::set<std::string>{"p.exr", "p.png"}));
}

/// In another second and with other threads: neither the time nor their number may enter the files.
TEST_F(Results, WalkAlongAPath) {
    bake_cornell("box.vtm");
    write("in.path",
          "0 278 273 -800  278 273 0  0 1 0  40\n"
          "1 278 273 -600  278 273 0  0 1 0  40\n");
    const std::string options = " --path in.path --fps 2 --size 32x32 --samples 4 ";
    ASSERT_EQ(run("-q walk box.vtm -o frames" + options).exit_code, 0);
    EXPECT_EQ(listing("frames"),
              (std::set<std::string>{"frame-00000.png", "frame-00001.png", "frame-00002.png"}));
    EXPECT_FALSE(read("frames/frame-00000.png") == read("frames/frame-00002.png"));
    // A frame is the picture from there.
    ASSERT_EQ(run("-q walk box.vtm -o linear --format exr" + options).exit_code, 0);
    ASSERT_EQ(run("-q render box.vtm -o last.exr --eye 278,273,-600 --look-at 278,273,0 --fov 40 "
                  "--size 32x32 --samples 4 --direct stored")
                  .exit_code,
              0);
    EXPECT_EQ(run("compare linear/frame-00002.exr last.exr --fail-above 0").exit_code, 0);
    // With bundles on sub-patches it knows more by then.
    const std::string bundles = " --monte-carlo subpatch --iterations 4 ";
    ASSERT_EQ(run("-q walk box.vtm -o gathered --format exr" + options + bundles).exit_code, 0);
    EXPECT_EQ(run("compare gathered/frame-00002.exr last.exr --fail-above 0").exit_code, 1);
    const Outcome o = run("walk box.vtm -o frames --path missing.path");
    EXPECT_EQ(o.exit_code, 4);
    EXPECT_NE(o.err.find("missing.path"), std::string::npos) << o.err;
}

TEST_F(Results, RenderAlikeTwice) {
    bake_cornell("c.vtm");
    for (const char* camera : {"front", "corner"}) {
        const std::string name = std::string("out/") + camera;
        const std::string render =
            std::string("\"$TRANSILLUM\" -q render c.vtm --size 40x30 --camera ") + camera;
        const Outcome o = shell(render + " --threads 1 -o " + name + "1.exr -o " + name +
                                "1.png && sleep 1.1 && " + render + " --threads 2 -o " + name +
                                "2.exr -o " + name + "2.png");
        ASSERT_EQ(o.exit_code, 0) << o.err;
        for (const char* extension : {".exr", ".png"})
            EXPECT_TRUE(read(name + "1" + extension) == read(name + "2" + extension))
                << name << extension;
    }
    EXPECT_FALSE(read("out/front1.exr") == read("out/corner1.exr"));
}

TEST_F(Results, ReloadAsTheyWereSaved) {
    bake_cornell("c.vtm");
    const auto first = nlohmann::json::parse(run("info --json c.vtm").out);
    EXPECT_EQ(first["iterations"], 32);
    EXPECT_EQ(first["cameras"], nlohmann::json({"front", "corner"}));
    EXPECT_EQ(first["settings"]["sides"], "file");
    EXPECT_FALSE(first["decisions"].empty());
}

TEST_F(Results, CompareTellsByItsExitCode) {
    bake_cornell("a.vtm", "--seed 1");
    bake_cornell("b.vtm", "--seed 2");
    EXPECT_EQ(run("compare a.vtm a.vtm --fail-above 0").exit_code, 0);
    EXPECT_EQ(run("compare a.vtm b.vtm").exit_code, 0);
    EXPECT_EQ(run("compare a.vtm b.vtm --fail-above 10").exit_code, 0);
    const Outcome o = run("compare a.vtm b.vtm --fail-above 0 --json");
    EXPECT_EQ(o.exit_code, 1);
    EXPECT_GT(nlohmann::json::parse(o.out)["relative_rmse"].get<double>(), 0.0);
}

TEST_F(Results, HelpSaysTheDefaults) {
    const std::pair<const char*, std::vector<const char*>> expected[] = {
        {"bake",
         {"--iterations", "=1024", "--max-level", "=8", "--max-albedo", "=0.99",
          "--averaging balanced|none|paper=balanced"}},
        {"render",
         {"--size WxH=500x500", "--samples", "=16",
          "--direct stored|traced|traced-everywhere=traced",
          "--monte-carlo auto|off|rays|subpatch|wavefront=auto"}},
        {"walk", {"--monte-carlo auto|off|rays|subpatch|wavefront=auto", "--iterations"}},
        {"reference", {"--size WxH=500x500", "--samples", "=256", "--max-albedo", "=0.99"}},
        {"info", {"SOLUTION", "--json"}},
        {"compare", {"--fail-above", "--json"}}};
    for (const auto& [subcommand, parts] : expected) {
        const Outcome o = run(std::string(subcommand) + " --help");
        EXPECT_EQ(o.exit_code, 0);
        EXPECT_EQ(o.err, "");
        for (const char* part : parts)
            EXPECT_NE(o.out.find(part), std::string::npos) << subcommand << ": " << part;
    }
}

}  // namespace

}  // namespace transillum
