#include "program/program.h"

#include <gmock/gmock.h>

namespace transillum {

namespace {

using testing::HasSubstr;

class Export : public Program {};

TEST_F(Export, WritesEveryFormatAlike) {
    write_room("0.5", "1");
    bake_room("room.vtm");
    const Outcome o = run("export room.vtm -o room.glb -o room.ply -o room.vtp --threads 1");
    ASSERT_EQ(o.exit_code, 0) << o.err;
    EXPECT_THAT(o.out, HasSubstr("room.glb: "));
    EXPECT_THAT(o.err, HasSubstr("exposure"));
    // They are scenes, too.
    for (const char* mesh : {"room.glb", "room.ply"})
        EXPECT_EQ(run(std::string("-q check ") + mesh).exit_code, 0) << mesh;
    const std::string before = read("room.glb");
    ASSERT_EQ(run("-q export room.vtm -o room.glb --threads 3").exit_code, 0);
    EXPECT_EQ(read("room.glb"), before);
    ASSERT_EQ(run("-q export room.vtm -o room.glb --components direct --flat").exit_code, 0);
    EXPECT_NE(read("room.glb"), before);
}

}  // namespace

}  // namespace transillum
