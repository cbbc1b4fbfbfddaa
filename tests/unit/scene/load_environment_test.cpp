#include "unit/scene/scene_files.h"

#include <transillum/scene/load_environment.h>

#include <OpenImageIO/imageio.h>

#include <limits>

namespace transillum {
namespace {

class LoadEnvironment : public SceneFiles {
protected:
    std::filesystem::path write_image(const std::string& name, int width, int height, int channels,
                                      const std::vector<float>& values,
                                      OIIO::TypeDesc type = OIIO::TypeDesc::FLOAT) const {
        const std::filesystem::path path = folder_ / name;
        const auto out = OIIO::ImageOutput::create(path.string());
        EXPECT_TRUE(out->open(path.string(), OIIO::ImageSpec(width, height, channels, type)));
        EXPECT_TRUE(out->write_image(OIIO::TypeDesc::FLOAT, values.data()));
        out->close();
        return path;
    }
    void expect_refused_image(const std::filesystem::path& path, const std::string& part) {
        try {
            (void)load_environment(path, monitor_);
            ADD_FAILURE() << path << " was accepted";
        } catch (const InputError& error) {
            const std::string message = error.what();
            EXPECT_NE(message.find(path.string()), std::string::npos) << message;
            EXPECT_NE(message.find(part), std::string::npos) << message;
            EXPECT_EQ(message.find('\n'), std::string::npos) << message;
        }
    }
};

TEST_F(LoadEnvironment, ReadsLinearRadiance) {
    for (const char* name : {"sky.exr", "sky.hdr"}) {
        const auto path = write_image(name, 2, 1, 3, {1.0f, 2.0f, 4.0f, 0.5f, 0.0f, 64.0f});
        const Environment e = load_environment(path, monitor_);
        EXPECT_EQ(e.kind, Environment::Kind::image);
        EXPECT_EQ(e.image->width, 2);
        EXPECT_EQ(e.image->height, 1);
        EXPECT_EQ(e.image->name, path.string());
        EXPECT_EQ(e.image->texels, (std::vector<Spectrum>{{1.0f, 2.0f, 4.0f}, {0.5f, 0.0f, 64.0f}}))
            << name;
    }
    EXPECT_TRUE(monitor_.warnings.empty());
}

TEST_F(LoadEnvironment, TakesOneChannelAsGreyAndLeavesOutAlpha) {
    const auto grey = load_environment(write_image("g.exr", 2, 1, 1, {3.0f, 5.0f}), monitor_);
    EXPECT_EQ(grey.image->texels, (std::vector<Spectrum>{Spectrum(3.0f), Spectrum(5.0f)}));
    const auto path = write_image("a.exr", 2, 1, 4, {1, 2, 3, 0.5f, 4, 5, 6, 1});
    EXPECT_EQ(load_environment(path, monitor_).image->texels,
              (std::vector<Spectrum>{{1, 2, 3}, {4, 5, 6}}));
}

TEST_F(LoadEnvironment, CountsAndBlackensSpoiltPixels) {
    const float nan = std::numeric_limits<float>::quiet_NaN(),
                infinity = std::numeric_limits<float>::infinity();
    const auto path =
        write_image("bad.exr", 4, 2, 3, {nan, 1, 1, 1, infinity, 1, 1, -2, 3, 1, 1, 1,  //
                                         1,   1, 1, 1, 1,        1, 1, 1,  1, 1, 1, -infinity});
    const Environment e = load_environment(path, monitor_);
    EXPECT_EQ(e.image->texels[0], Spectrum(0.0f));
    EXPECT_EQ(e.image->texels[1], Spectrum(0.0f));
    EXPECT_EQ(e.image->texels[2], Spectrum(1.0f, 0.0f, 3.0f));
    EXPECT_EQ(e.image->texels[7], Spectrum(0.0f));
    ASSERT_EQ(monitor_.warnings.size(), 1u);
    EXPECT_NE(monitor_.warnings[0].find(path.string() + ": of 8 pixels 3 are NaN or infinite and "
                                                        "set to 0, 1 have channels below 0"),
              std::string::npos)
        << monitor_.warnings[0];
}

TEST_F(LoadEnvironment, WarnsOfAnotherShape) {
    (void)load_environment(write_image("odd.exr", 3, 2, 1, std::vector<float>(6, 1.0f)), monitor_);
    ASSERT_EQ(monitor_.warnings.size(), 1u);
    EXPECT_NE(monitor_.warnings[0].find("3 x 2 pixels; a lat-long image is twice as wide as high"),
              std::string::npos);
}

TEST_F(LoadEnvironment, MakesEightBitsLinear) {
    const auto path =
        write_image("s.png", 2, 1, 3, {1, 0, 0, 0.2f, 0.2f, 0.2f}, OIIO::TypeDesc::UINT8);
    const Environment e = load_environment(path, monitor_);
    EXPECT_EQ(e.image->texels[0], Spectrum(1, 0, 0));
    EXPECT_NEAR(e.image->texels[1].x, 0.033105f, 1e-6f);
}

TEST_F(LoadEnvironment, RefusesWhatIsNoImage) {
    expect_refused_image(write("x.exr", "hello"), "cannot be read as an image");
    expect_refused_image(write("x.hdr", "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 4 +X 8\nshort"),
                         "cannot be read as an image");
    expect_refused_image(write("x.txt", "hello"), "cannot be read as an image");
    EXPECT_THROW((void)load_environment(folder_ / "gone.exr", monitor_), IoError);
    EXPECT_THROW((void)load_environment(folder_, monitor_), IoError);
}

}  // namespace
}  // namespace transillum
