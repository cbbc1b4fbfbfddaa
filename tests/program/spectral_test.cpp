// Bands of wavelengths from the command line.
#include "program/program.h"

#include <transillum/render/image.h>
#include <transillum/solution/load_solution.h>

#include <nlohmann/json.hpp>

namespace transillum {

namespace {

class Spectral : public Program {
protected:
    Spectral() {
        write_room("0.5", "1");
        write("walls.csv", "wavelength,blueish\n400,0.9\n700,0.1\n");
        write("map.json",
              "{\"wall\": {\"reflectance\": {\"file\": \"walls.csv\", \"column\": "
              "\"blueish\"}}}");
    }

    [[nodiscard]] Spectrum mean_of(const std::string& image) const {
        SpectrumSum sum(0.0);
        const Image read = read_image(folder_ / image);
        for (const Spectrum& p : read.pixels) sum += SpectrumSum(p);
        return Spectrum(sum / double(read.pixels.size()));
    }
};

const std::string view = " --eye .5,.5,.5 --look-at .5,.4,0 --size 16x16 -o ";

TEST_F(Spectral, BakesAndShowsBands) {
    bake_room("plain.vtm");
    bake_room("room.vtm", "--spectra map.json --spectral 8");
    EXPECT_EQ(load_spectral_solution(folder_ / "room.vtm").groups.size(), 3u);
    ASSERT_EQ(run("-q render room.vtm" + view + "room.exr").exit_code, 0);
    ASSERT_EQ(run("-q render plain.vtm" + view + "plain.exr").exit_code, 0);
    const Spectrum blueish = mean_of("room.exr"), grey = mean_of("plain.exr");
    EXPECT_GT(blueish.z, 1.3f * blueish.x);
    EXPECT_NEAR(grey.z, grey.x, 1e-4f * grey.x);

    const Outcome info = run("info room.vtm --json");
    ASSERT_EQ(info.exit_code, 0) << info.err;
    EXPECT_EQ(nlohmann::json::parse(info.out)["settings"]["spectral"], "8");
    EXPECT_EQ(run("compare room.vtm room.vtm --fail-above 0").exit_code, 0);
    // Other materials.
    EXPECT_EQ(run("compare room.vtm plain.vtm").exit_code, 3);
}

TEST_F(Spectral, AGreyRoomIsAsInRgb) {
    bake_room("plain.vtm");
    bake_room("room.vtm", "--spectral");  // 12 bands
    EXPECT_EQ(load_spectral_solution(folder_ / "room.vtm").bands, 12);
    const Outcome o = run("compare room.vtm plain.vtm --fail-above 1e-5");
    EXPECT_EQ(o.exit_code, 0) << o.out;
}

TEST_F(Spectral, WalksAndTracesPaths) {
    Outcome o = run("-q bake room.obj -o room.vtm --leaves 400 --spectral 8 --spectra map.json");
    ASSERT_EQ(o.exit_code, 0) << o.err;
    write("path.txt", "0 .5 .5 .5  .5 .4 0  0 1 0  45\n0.04 .5 .5 .5  .5 .4 0  0 1 0  45\n");
    o = run("-q walk room.vtm --path path.txt --size 16x16 --format exr -o frames");
    ASSERT_EQ(o.exit_code, 0) << o.err;
    EXPECT_EQ(listing("frames").size(), 2u);
    ASSERT_EQ(run("-q render room.vtm --direct stored" + view + "room.exr").exit_code, 0);
    EXPECT_EQ(mean_of("frames/frame-00000.exr"), mean_of("room.exr"));

    o = run("-q reference room.obj --spectral 8 --spectra map.json --samples 64" + view +
            "paths.exr");
    ASSERT_EQ(o.exit_code, 0) << o.err;
    const Spectrum traced = mean_of("paths.exr"), baked = mean_of("room.exr");
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(baked[c] / traced[c], 1.0f, 0.05f);
}

TEST_F(Spectral, MistakesAreNamed) {
    write("bad.json", "{\"door\": {}}");
    write("worse.json",
          "{\"wall\": {\"reflectance\": {\"file\": \"walls.csv\", \"column\": "
          "\"red\"}}}");
    const auto expect_refused = [&](const std::string& options, int code, const std::string& part) {
        const Outcome o = run("bake room.obj -o out/s.vtm " + options);
        EXPECT_EQ(o.exit_code, code) << o.err;
        EXPECT_NE(o.err.find(part), std::string::npos) << o.err;
        EXPECT_EQ(listing("out"), std::set<std::string>());
    };
    expect_refused("--spectral 7", 2, "'7' bands; accepted: 8 to 60");
    expect_refused("--spectral 61", 2, "'61' bands; accepted: 8 to 60");
    expect_refused("--spectral many", 2, "'many' bands; accepted: 8 to 60");
    expect_refused("--spectral 60 --memory 0.001", 2,
                   "for bands or emitters; accepted: 0.00 in all");
    expect_refused("--spectra map.json", 2, "accepted: together with --spectral");
    expect_refused("--spectral --spectra gone.json", 4, "gone.json");
    expect_refused("--spectral --spectra room.obj", 3, "room.obj: no JSON");
    expect_refused("--spectral --spectra bad.json", 3,
                   "bad.json: material 'door': the scene has none of that name; accepted: 'wall', "
                   "'lamp'");
    expect_refused("--spectral --spectra worse.json", 3,
                   "walls.csv:1: no column 'red'; accepted: blueish");
    EXPECT_EQ(run("reference room.obj -o out/i.exr --spectra map.json").exit_code, 2);
}

}  // namespace

}  // namespace transillum
