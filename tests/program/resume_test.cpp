// Baking in parts.
#include "program/program.h"

namespace transillum {

namespace {

using Resume = Program;

TEST_F(Resume, TwoPartsAreAWholeByteForByte) {
    write_room("0.7", "1");
    for (const std::string name : {"whole", "part"}) {
        const Outcome o = run("-q bake room.obj --leaves 100 --resolution 64 -o " + name +
                              ".vtm --iterations " + (name == "whole" ? "20" : "10"));
        ASSERT_EQ(o.exit_code, 0) << o.err;
    }
    const Outcome o = run("-q resume part.vtm --iterations 10 -o parts.vtm");
    ASSERT_EQ(o.exit_code, 0) << o.err;
    EXPECT_NE(o.out.find("20 iterations"), std::string::npos) << o.out;
    EXPECT_EQ(listing("parts"), listing("whole"));
    for (const std::string& piece : listing("whole")) {
        if (piece == "run.json") continue;
        EXPECT_TRUE(read("parts/" + piece) == read("whole/" + piece)) << piece;
    }
    // Onto itself, and as many again.
    ASSERT_EQ(run("-q resume part.vtm").exit_code, 0);
    EXPECT_TRUE(read("part/radiance.vtp") == read("whole/radiance.vtp"));
}

TEST_F(Resume, AfterAnInterruption) {
    write_room("0.5", "1");
    const Outcome o = shell(
        "\"$TRANSILLUM\" bake room.obj -o room.vtm --leaves 1000 --resolution 64 --iterations "
        "1000000000 & for i in $(seq 1000); do grep -q transport stderr && break; sleep 0.01; "
        "done; "
        "kill -INT $!; wait $!");
    ASSERT_EQ(o.exit_code, 130) << o.err;
    const Outcome more = run("resume room.vtm --iterations 5");
    EXPECT_EQ(more.exit_code, 0) << more.err;
    EXPECT_NE(more.err.find("5 iterations more"), std::string::npos) << more.err;
    EXPECT_EQ(more.out.find("interrupted"), std::string::npos) << more.out;
}

TEST_F(Resume, SaysWhatIsMissing) {
    write_room("0.5", "1");
    bake_room("without.vtm", "--keep-sums off");
    const Outcome without = run("resume without.vtm");
    EXPECT_EQ(without.exit_code, 3);
    EXPECT_NE(without.err.find("--keep-sums on"), std::string::npos) << without.err;
    bake_room("bands.vtm", "--spectral 8");
    const Outcome bands = run("resume bands.vtm");
    EXPECT_EQ(bands.exit_code, 3);
    EXPECT_NE(bands.err.find("--spectral"), std::string::npos) << bands.err;
    EXPECT_EQ(run("resume missing.vtm").exit_code, 4);
    bake_room("room.vtm");
    EXPECT_EQ(run("resume room.vtm -o room.png").exit_code, 2);
}

}  // namespace

}  // namespace transillum
