// SIGINT keeps what there is.
#include "program/program.h"

#include <nlohmann/json.hpp>

namespace transillum {

namespace {

/// Starts `command`, interrupts it as soon as it speaks of `phase`, and ends with its exit code.
std::string interrupted_at(const std::string& phase, const std::string& command) {
    return "\"$TRANSILLUM\" " + command + " & for i in $(seq 1000); do grep -q '" + phase +
           "' stderr && break; sleep 0.01; done; kill -INT $!; wait $!";
}

using Interrupt = Program;

TEST_F(Interrupt, OfABakeSavesASolution) {
    write_room("0.5", "1");
    const Outcome o = shell(interrupted_at(
        "transport",
        "bake room.obj -o out/s.vtm --leaves 1000 --resolution 64 --iterations 1000000000"));
    EXPECT_EQ(o.exit_code, 130) << o.err;
    EXPECT_EQ(listing("out"), (std::set<std::string>{"s", "s.vtm"}));

    const Outcome info = run("info out/s.vtm --json");
    ASSERT_EQ(info.exit_code, 0) << info.err;
    const auto json = nlohmann::json::parse(info.out);
    EXPECT_TRUE(json["interrupted"].get<bool>());
    EXPECT_GE(json["iterations"].get<int>(), 1);
    EXPECT_LT(json["iterations"].get<int>(), 1000000000);
    EXPECT_EQ(run("-q render out/s.vtm -o out/p.png --size 8x8").exit_code, 0);
}

TEST_F(Interrupt, OfARenderLeavesNothing) {
    write_room("0.5", "1");
    bake_room("room.vtm");
    const Outcome o =
        shell(interrupted_at("render", "render room.vtm -o out/p.exr --size 1000x16000"));
    EXPECT_EQ(o.exit_code, 130) << o.err;
    EXPECT_EQ(listing("out"), std::set<std::string>());
}

TEST_F(Interrupt, OfAReferenceSavesTheMeanSoFar) {
    write_room("0.5", "1");
    const Outcome o = shell(interrupted_at(
        "path tracing", "reference room.obj -o out/p.exr --size 16x16 --samples 10000000"));
    EXPECT_EQ(o.exit_code, 130) << o.err;
    EXPECT_EQ(listing("out"), std::set<std::string>{"p.exr"});
    EXPECT_EQ(run("compare out/p.exr out/p.exr").exit_code, 0);
}

}  // namespace

}  // namespace transillum
