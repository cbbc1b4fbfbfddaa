#include "scene/read_texture.h"
#include "unit/scene/image_files.h"
#include "unit/scene/scene_files.h"

#include <transillum/base/sampling.h>

#include <cmath>
#include <limits>

namespace transillum {

namespace {

using Bytes = std::vector<std::uint8_t>;
using Words = std::vector<std::uint16_t>;
using Floats = std::vector<float>;

constexpr float nan = std::numeric_limits<float>::quiet_NaN();
constexpr float infinity = std::numeric_limits<float>::infinity();

/// sRGB 188 of 255, by the formula of IEC 61966-2-1.
constexpr float linear_188 = 0.5028864580f;
constexpr float rounding = 1e-6f;

class ReadTexture : public SceneFiles {
protected:
    template <class Value>
    TextureImage image(const std::string& name, const ImageShape& shape,
                       const std::vector<Value>& values, ImageUse use = ImageUse::albedo,
                       const std::vector<std::pair<std::string, int>>& attributes = {}) {
        write_image(folder_ / name, shape, values, attributes);
        return read_texture((folder_ / name).string(), use, monitor_);
    }
    void expect_image_refused(const std::string& name, const std::vector<std::string>& parts) {
        try {
            (void)read_texture((folder_ / name).string(), ImageUse::albedo, monitor_);
            ADD_FAILURE() << name << " was accepted";
        } catch (const InputError& error) {
            const std::string message = error.what();
            EXPECT_EQ(message.find('\n'), std::string::npos) << message;
            EXPECT_NE(message.find(name), std::string::npos) << message;
            for (const std::string& part : parts)
                EXPECT_NE(message.find(part), std::string::npos) << message;
        }
    }
};

void expect_near(const Spectrum& a, const Spectrum& b, float tolerance = rounding) {
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(a[c], b[c], tolerance) << "channel " << c;
}

TEST_F(ReadTexture, DecodesBytesAsSrgb) {
    const Texture t = image<std::uint8_t>("x.png", {2, 2},
                                          Bytes{255, 188, 0, 1, 2, 3,  //
                                                0, 0, 0, 255, 255, 255})
                          .texture;
    EXPECT_EQ(t.width, 2);
    EXPECT_EQ(t.height, 2);
    expect_near(t.texels[0], {1.0f, linear_188, 0.0f});
    expect_near(t.texels[1], Spectrum(1, 2, 3) / 255.0f / 12.92f);
    EXPECT_EQ(t.texels[2], Spectrum(0.0f)) << "rows run from the top";
    EXPECT_EQ(t.texels[3], Spectrum(1.0f));
    EXPECT_TRUE(monitor_.warnings.empty());
}

TEST_F(ReadTexture, DecodesWordsAsSrgb) {
    const Words words{65535, 188 * 257, 0, 257, 514, 771};
    for (const char* name : {"x.png", "x.tif"}) {
        const Texture t = image<std::uint16_t>(name, {2, 1}, words).texture;
        expect_near(t.texels[0], {1.0f, linear_188, 0.0f});
        expect_near(t.texels[1], Spectrum(1, 2, 3) / 255.0f / 12.92f);
    }
}

TEST_F(ReadTexture, TakesNumbersAsTheyAre) {
    const Texture t =
        image<std::uint8_t>("x.png", {1, 1}, Bytes{51, 102, 255}, ImageUse::numbers).texture;
    expect_near(t.texels[0], {0.2f, 0.4f, 1.0f});
}

TEST_F(ReadTexture, TakesFloatingPointAsLinear) {
    for (const char* name : {"x.exr", "x.tif"}) {
        const Texture t =
            image<float>(name, {2, 1}, Floats{0.5f, 0.25f, 1.0f, 0.0f, 0.125f, 0.75f}).texture;
        EXPECT_EQ(t.texels[0], Spectrum(0.5f, 0.25f, 1.0f)) << name;
        EXPECT_EQ(t.texels[1], Spectrum(0.0f, 0.125f, 0.75f)) << name;
    }
    // Radiance HDR keeps 8 bits of the largest channel.
    const Texture t =
        image<float>("x.hdr", {1, 1}, Floats{8.0f, 4.0f, 2.0f}, ImageUse::emission).texture;
    expect_near(t.texels[0], {8.0f, 4.0f, 2.0f}, 8.0f / 128.0f);
    EXPECT_TRUE(monitor_.warnings.empty());
}

TEST_F(ReadTexture, SpreadsGrey) {
    expect_near(image<std::uint8_t>("x.png", {1, 1, 1}, Bytes{188}).texture.texels[0],
                Spectrum(linear_188));
    const TextureImage with_alpha = image<std::uint8_t>("y.png", {1, 1, 2}, Bytes{188, 51});
    expect_near(with_alpha.texture.texels[0], Spectrum(linear_188));
    EXPECT_FLOAT_EQ(with_alpha.alpha.at(0), 0.2f);
    EXPECT_EQ(image<float>("x.exr", {1, 1, 1}, Floats{0.5f}).texture.texels[0], Spectrum(0.5f));
}

TEST_F(ReadTexture, DoesNotMultiplyByAlpha) {
    const TextureImage png = image<std::uint8_t>("x.png", {1, 1, 4}, Bytes{255, 188, 0, 102});
    expect_near(png.texture.texels[0], {1.0f, linear_188, 0.0f});
    EXPECT_FLOAT_EQ(png.alpha.at(0), 0.4f);
    // OpenEXR holds colours with alpha multiplied in.
    const TextureImage exr = image<float>("x.exr", {1, 1, 4}, Floats{0.25f, 0.125f, 0.0f, 0.5f});
    EXPECT_EQ(exr.texture.texels[0], Spectrum(0.5f, 0.25f, 0.0f));
    EXPECT_EQ(exr.alpha.at(0), 0.5f);
    EXPECT_TRUE(image<std::uint8_t>("z.png", {1, 1}, Bytes{1, 2, 3}).alpha.empty());
}

TEST_F(ReadTexture, ReadsPalettes) {
    // Written with a palette of its own.
    const Bytes colours{255, 0, 0, 0, 255, 0, 0, 0, 255, 255, 255, 255};
    const Texture gif = image<std::uint8_t>("x.gif", {4, 1}, colours).texture;
    ASSERT_EQ(gif.width, 4);
    for (std::size_t i = 0; i < 12; ++i)
        EXPECT_NEAR(gif.texels[i / 3][static_cast<int>(i % 3)], colours[i] / 255.0f, 0.05f);
    // PNG, 2 x 1, one bit a pixel: palette 255 188 0, 0 0 255; pixels 0 1.
    const std::string png{
        "\x89\x50\x4e\x47\x0d\x0a\x1a\x0a\x00\x00\x00\x0d\x49\x48\x44\x52\x00\x00\x00\x02\x00\x00"
        "\x00\x01\x01\x03\x00\x00\x00\xce\xec\xed\xc9\x00\x00\x00\x06\x50\x4c\x54\x45\xff\xbc\x00"
        "\x00\x00\xff\xb9\x96\x18\x9b\x00\x00\x00\x0a\x49\x44\x41\x54\x78\x9c\x63\x70\x00\x00\x00"
        "\x42\x00\x41\x29\x37\xf4\xef\x00\x00\x00\x00\x49\x45\x4e\x44\xae\x42\x60\x82",
        85};
    for (const bool in_memory : {false, true}) {
        write("p.png", png);
        const Texture t = read_texture((folder_ / "p.png").string(), ImageUse::albedo, monitor_,
                                       in_memory ? png : std::string())
                              .texture;
        ASSERT_EQ(t.texels.size(), 2u);
        expect_near(t.texels[0], {1.0f, linear_188, 0.0f});
        EXPECT_EQ(t.texels[1], Spectrum(0.0f, 0.0f, 1.0f));
    }
}

TEST_F(ReadTexture, ReadsOneBit) {
    // Netpbm bitmap, 8 x 1: 1 is black.
    write("x.pbm", "P4\n8 1\n\x2d");
    const Texture t =
        read_texture((folder_ / "x.pbm").string(), ImageUse::albedo, monitor_).texture;
    ASSERT_EQ(t.texels.size(), 8u);
    constexpr std::array<int, 8> black{0, 0, 1, 0, 1, 1, 0, 1};
    for (std::size_t i = 0; i < 8; ++i) EXPECT_EQ(t.texels[i], Spectrum(black[i] ? 0.0f : 1.0f));
}

/// Writes one pixel of named channels.
void write_channels(const std::filesystem::path& file, const std::vector<std::string>& names,
                    const Floats& values) {
    const auto out = OIIO::ImageOutput::create(file.string());
    ASSERT_TRUE(out);
    OIIO::ImageSpec spec(1, 1, static_cast<int>(names.size()), OIIO::TypeDesc::FLOAT);
    spec.channelnames = names;
    ASSERT_TRUE(out->open(file.string(), spec));
    ASSERT_TRUE(out->write_image(OIIO::TypeDesc::FLOAT, values.data()));
    ASSERT_TRUE(out->close());
}

TEST_F(ReadTexture, PicksColourAmongManyChannels) {
    write_channels(folder_ / "x.exr", {"depth", "B", "G", "R", "normal.x", "normal.y"},
                   {9.0f, 0.25f, 0.5f, 0.75f, 7.0f, 8.0f});
    EXPECT_EQ(
        read_texture((folder_ / "x.exr").string(), ImageUse::albedo, monitor_).texture.texels[0],
        Spectrum(0.75f, 0.5f, 0.25f));
}

TEST_F(ReadTexture, RefusesOtherImages) {
    write_channels(folder_ / "five.exr", {"a", "b", "c", "d", "e"}, Floats(5));
    expect_image_refused("five.exr", {"5 channels", "accepted: 1 to 4 channels"});
    write("text.png", "no image");
    expect_image_refused("text.png", {"cannot be read as an image"});
    write("empty.png", "");
    expect_image_refused("empty.png", {"cannot be read as an image"});
    expect_image_refused("gone.png", {"cannot be read as an image"});
    EXPECT_THROW((void)read_texture("inside", ImageUse::albedo, monitor_, "no image"), InputError);
}

TEST_F(ReadTexture, RefusesTruncatedImages) {
    Random random(1, 1);
    Bytes noise(32 * 32 * 3);
    for (std::uint8_t& b : noise) b = static_cast<std::uint8_t>(random.next_bits() >> 24);
    for (const char* name : {"x.png", "x.tif", "x.exr"}) {
        write_image<std::uint8_t>(folder_ / name, {32, 32}, noise);
        std::ifstream in(folder_ / name, std::ios::binary);
        const std::string whole((std::istreambuf_iterator<char>(in)), {});
        // The last bytes of a PNG are its end mark.
        for (std::size_t size = 1; size + 16 < whole.size(); size += 97) {
            write(name, whole.substr(0, size));
            expect_image_refused(name, {});
        }
    }
}

TEST_F(ReadTexture, MendsValuesThatAreNoReflectances) {
    const Floats values{nan,      0.5f,      0.5f, -1.0f, 0.25f, 2.0f,
                        infinity, -infinity, nan,  0.1f,  1.0f,  0.0f};
    const Texture t = image<float>("x.tif", {4, 1}, values).texture;
    EXPECT_EQ(t.texels[0], Spectrum(0.0f, 0.5f, 0.5f));
    EXPECT_EQ(t.texels[1], Spectrum(0.0f, 0.25f, 1.0f));
    EXPECT_EQ(t.texels[2], Spectrum(0.0f));
    EXPECT_EQ(t.texels[3], Spectrum(0.1f, 1.0f, 0.0f));
    ASSERT_EQ(monitor_.warnings.size(), 2u);
    EXPECT_TRUE(monitor_.any_names(monitor_.warnings,
                                   "x.tif: 2 of 4 texels hold a value that is not finite; 0 is"));
    EXPECT_TRUE(monitor_.any_names(monitor_.warnings,
                                   "x.tif: 1 of 4 texels hold a value outside [0, 1]; it is"));
}

TEST_F(ReadTexture, KeepsEmissionAboveOne) {
    const Texture t = image<float>("x.exr", {2, 1}, Floats{100.0f, 0.5f, 3.0f, -2.0f, 1.0f, nan},
                                   ImageUse::emission)
                          .texture;
    EXPECT_EQ(t.texels[0], Spectrum(100.0f, 0.5f, 3.0f));
    EXPECT_EQ(t.texels[1], Spectrum(0.0f, 1.0f, 0.0f));
    EXPECT_TRUE(monitor_.any_names(monitor_.warnings, "1 of 2 texels hold a value below 0"));
}

}  // namespace

}  // namespace transillum
