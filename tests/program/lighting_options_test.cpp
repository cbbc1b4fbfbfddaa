// Lights and skies as typed on the command line.
#include "cli/scene_options.h"
#include "support/scene_builder.h"

#include <transillum/base/error.h>
#include <transillum/scene/photometry.h>

#include <gtest/gtest.h>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include <cstdlib>
#include <filesystem>
#include <fstream>

namespace transillum::cli {
namespace {

using Recorder = testing_support::Recorder;

class LightingWords : public testing::Test {
protected:
    LightingWords() {
        std::string name = testing::TempDir() + "transillum_XXXXXX";
        folder_ = mkdtemp(name.data());
    }
    ~LightingWords() override { std::filesystem::remove_all(folder_); }

    static LightingOptions parse(const std::string& words) {
        CLI::App app;
        LightingOptions options;
        add_lighting_options(app, options);
        app.parse(words);
        return options;
    }
    Lighting make(const std::string& words) { return make_lighting(parse(words), recorder_); }
    void expect_refused(const std::string& words, const std::vector<std::string>& parts) {
        try {
            (void)make(words);
            ADD_FAILURE() << words << " was accepted";
        } catch (const UsageError& error) {
            for (const std::string& part : parts)
                EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << error.what();
        }
    }
    /// A dark lat-long image in Radiance's flat format, with one bright pixel.
    std::string sunny_image() const {
        const std::string path = folder_ / "sky.hdr";
        std::ofstream out(path, std::ios::binary);
        out << "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 32 +X 64\n";
        for (int i = 0; i < 32 * 64; ++i)
            out << std::string(i == 700 ? "\x80\x80\x80\x90" : "\x80\x80\x80\x81");
        return path;
    }

    std::filesystem::path folder_;
    Recorder recorder_;
};

TEST_F(LightingWords, NoneIsTheDefault) {
    const Lighting lighting = make("");
    EXPECT_FALSE(lighting.environment.shines());
    EXPECT_TRUE(lighting.lights.empty());
}

TEST_F(LightingWords, DescribeSkies) {
    const Environment uniform = make("--environment uniform:1,2,3").environment;
    EXPECT_EQ(uniform.kind, Environment::Kind::uniform);
    EXPECT_EQ(uniform.radiance_scale, Spectrum(1, 2, 3));
    const Environment overcast =
        make("--environment overcast:5 --environment-up z --environment-scale 2").environment;
    EXPECT_EQ(overcast.kind, Environment::Kind::overcast);
    EXPECT_EQ(overcast.radiance_scale, Spectrum(10.0f));
    EXPECT_EQ(overcast.up, glm::dvec3(0, 0, 1));
    const Environment clear =
        make("--environment clear:7,90,30 --environment-up 0,0,3").environment;
    EXPECT_EQ(clear.kind, Environment::Kind::clear);
    EXPECT_EQ(clear.radiance_scale, Spectrum(7.0f));
    // In the east, 30 degrees up.
    EXPECT_LT(glm::length(clear.sun - glm::dvec3(std::sqrt(0.75), 0.0, 0.5)), 1e-12);
    EXPECT_EQ(make("--environment clear:1,2,3,0,45").environment.radiance_scale, Spectrum(1, 2, 3));
}

TEST_F(LightingWords, NameAnImage) {
    const std::string path = sunny_image();
    const Lighting split =
        make("--environment " + path + " --environment-rotation 90 --environment-up z");
    EXPECT_EQ(split.environment.kind, Environment::Kind::image);
    EXPECT_DOUBLE_EQ(split.environment.rotation, glm::radians(90.0));
    ASSERT_EQ(split.lights.size(), 1u);
    EXPECT_EQ(split.lights[0].kind, PunctualLight::Kind::directional);
    ASSERT_EQ(recorder_.notes.size(), 1u);
    EXPECT_NE(recorder_.notes[0].find("--keep-suns"), std::string::npos);
    EXPECT_TRUE(make("--keep-suns --environment " + path).lights.empty());
}

TEST_F(LightingWords, AddLights) {
    const auto lights = make(
                            "--light point:1,2,3:40 --light lamp=spot:0,0,5:0,0,-2:10,30:1,2,3 "
                            "--light directional:0,-3,0:800")
                            .lights;
    ASSERT_EQ(lights.size(), 3u);
    EXPECT_EQ(lights[0].name, "light 1");
    EXPECT_EQ(lights[0].kind, PunctualLight::Kind::point);
    EXPECT_EQ(lights[0].position, glm::dvec3(1, 2, 3));
    EXPECT_EQ(lights[0].intensity, Spectrum(40.0f));
    EXPECT_EQ(lights[1].name, "lamp");
    EXPECT_EQ(lights[1].kind, PunctualLight::Kind::spot);
    EXPECT_EQ(lights[1].direction, glm::dvec3(0, 0, -1));
    EXPECT_EQ(lights[1].intensity, Spectrum(1, 2, 3));
    EXPECT_DOUBLE_EQ(lights[1].outer_angle, glm::radians(30.0));
    EXPECT_EQ(lights[2].kind, PunctualLight::Kind::directional);
    EXPECT_EQ(lights[2].direction, glm::dvec3(0, -1, 0));
}

TEST_F(LightingWords, HangPhotometry) {
    const std::string path = folder_ / "a.ies";
    std::ofstream(path) << "IESNA91\nTILT=NONE\n1 -1 1 2 1 1 2 0 0 0\n1 1 1\n0 180\n0\n5 5\n";
    Scene scene;
    scene.lighting = make("--light a=point:0,0,0:2,4,8 --light b=directional:0,0,1:1");
    hang_photometry(parse("--light-photometry a=" + path), scene, recorder_);
    const PunctualLight& light = scene.lighting.lights[0];
    ASSERT_NE(light.photometry, nullptr);
    EXPECT_NEAR(luminance(light.intensity_towards({0, 0, 1})), 5.0f, 1e-5f);
    EXPECT_NEAR(light.intensity.z / light.intensity.x, 4.0f, 1e-5f);
    for (const char* const name : {"b", "c"})
        EXPECT_THROW(hang_photometry(parse(std::string("--light-photometry ") + name + "=" + path),
                                     scene, recorder_),
                     UsageError);
    EXPECT_THROW(hang_photometry(parse("--light-photometry a=" + path + "x"), scene, recorder_),
                 IoError);
}

TEST_F(LightingWords, RefuseWhatTheyDoNotMean) {
    expect_refused("--environment overcats:3.5",
                   {"--environment overcats:3.5: not understood; accepted: none, uniform:L"});
    expect_refused("--environment bright", {"not understood"});
    expect_refused("--environment uniform:1,2", {"2 numbers where light has 1 or 3"});
    expect_refused("--environment uniform:-1", {"light is negative"});
    expect_refused("--environment uniform:nan", {"'nan' is no number"});
    expect_refused("--environment uniform:", {"'' is no number"});
    expect_refused("--environment clear:1", {"azimuth and elevation are missing"});
    expect_refused("--environment clear:1,0,91", {"elevation 91"});
    expect_refused("--environment overcast:1 --environment-up 0,0,0",
                   {"--environment-up 0,0,0: a direction has a length"});
    expect_refused("--environment overcast:1 --environment-up w",
                   {"--environment-up w: 'w' is no number; accepted: x"});
    expect_refused("--light lamp", {"--light lamp: not understood; accepted: [NAME=]point"});
    expect_refused("--light point:1,2:3", {"2 numbers where a vector has 3"});
    expect_refused("--light spot:0,0,0:0,0,1:40,30:1", {"half-angles"});
    EXPECT_THROW((void)make("--environment gone.exr"), IoError);
    EXPECT_THROW((void)parse("--environment-scale nan"), CLI::ParseError);
    EXPECT_THROW((void)parse("--environment-scale -1"), CLI::ParseError);
}

}  // namespace
}  // namespace transillum::cli
