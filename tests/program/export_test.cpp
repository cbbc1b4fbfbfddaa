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

TEST_F(Export, WritesALightmapBesideItsMesh) {
    write_room("0.5", "1");
    bake_room("room.vtm");
    const Outcome o = run("export room.vtm -o room.glb --lightmap room.exr --lightmap-size 128");
    ASSERT_EQ(o.exit_code, 0) << o.err;
    EXPECT_THAT(o.out, HasSubstr("room.exr: 128 x 128 texels of "));
    EXPECT_EQ(run("-q check room.glb").exit_code, 0);
    const std::string both = read("room.exr");
    ASSERT_EQ(run("-q export room.vtm -o room.glb --lightmap room.exr --lightmap-size 128 "
                  "--components finite-element")
                  .exit_code,
              0);
    EXPECT_NE(read("room.exr"), both);
}

TEST_F(Export, NamesWhatALightmapCannotDo) {
    write_room("0.5", "1");
    bake_room("room.vtm");
    for (const auto& [options, message] : std::vector<std::pair<const char*, const char*>>{
             {"-o room.ply --lightmap room.exr", "extension '.ply' with --lightmap"},
             {"-o room.glb --lightmap room.png", "a name that ends in .exr"},
             {"-o room.glb --lightmap none/room.exr", "its folder does not exist"},
             {"-o room.glb --lightmap room.exr --lightmap-size 8", "lightmap of 8 texels"},
             {"-o room.glb --lightmap room.exr --flat", "--lightmap excludes --flat"},
             {"-o room.glb --lightmap-size 64", "--lightmap-size requires --lightmap"}}) {
        const Outcome o = run(std::string("export room.vtm ") + options);
        EXPECT_EQ(o.exit_code, 2 + 2 * (std::string(options).find("none/") != std::string::npos))
            << options;
        EXPECT_THAT(o.err, HasSubstr(message));
    }
}

}  // namespace

}  // namespace transillum
