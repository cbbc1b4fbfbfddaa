#include <transillum/scene/split_sun.h>

#include <gtest/gtest.h>
#include <glm/geometric.hpp>

#include <cmath>
#include <numbers>

namespace transillum {
namespace {

constexpr double pi = std::numbers::pi;

/// A dim sky with suns added to some texels.
struct Sky {
    std::shared_ptr<Texture> image = std::make_shared<Texture>();
    Environment environment;
    explicit Sky(int height = 64, Spectrum background = {1.0f, 1.5f, 2.0f}) {
        image->width = 2 * height;
        image->height = height;
        image->texels.resize(static_cast<std::size_t>(2 * height) * height, background);
        environment.kind = Environment::Kind::image;
        environment.image = image;
        environment.rotation = 0.4;
        environment.up = {0, 0, 1};
    }
    Spectrum& at(int column, int row) { return image->texels[row * image->width + column]; }
};

/// Of a surface that sees every texel that differs: sums over texels are exact for those.
SpectrumSum irradiance(const Environment& e, const glm::dvec3& normal) {
    const Texture& image = *e.image;
    SpectrumSum sum(0.0);
    for (int row = 0; row < image.height; ++row)
        for (int column = 0; column < image.width; ++column) {
            const glm::dvec3 d =
                sky_direction(e.up, e.rotation + 2.0 * pi * (column + 0.5) / image.width,
                              pi / 2.0 - pi * (row + 0.5) / image.height);
            const Spectrum texel =
                image.texels[static_cast<std::size_t>(row) * image.width + column];
            sum += texel_solid_angle(image, row) * std::max(0.0, glm::dot(d, normal)) *
                   SpectrumSum(e.radiance_scale) * SpectrumSum(texel);
        }
    return sum;
}

TEST(SplitSun, KeepsTheIrradianceOfWhateverSeesTheSun) {
    Sky sky;
    sky.environment.radiance_scale = {2.0f, 1.0f, 0.5f};
    sky.at(20, 12) = {50000, 40000, 30000};
    sky.at(21, 12) = {20000, 15000, 10000};
    sky.at(21, 13) = {5000, 5000, 5000};
    const Environment before = sky.environment;
    const Suns suns = split_sun(sky.environment);
    ASSERT_EQ(suns.lights.size(), 1u);
    const PunctualLight& sun = suns.lights[0];
    EXPECT_EQ(sun.kind, PunctualLight::Kind::directional);
    EXPECT_EQ(sun.name, "sun 1");
    EXPECT_EQ(suns.moved, SpectrumSum(sun.intensity));
    const glm::dvec3 towards = -sun.direction;
    for (const glm::dvec3& normal :
         {towards, glm::dvec3(0, 0, 1), glm::normalize(towards + glm::dvec3(0.5, -0.5, 0.3))}) {
        const double cosine = glm::dot(towards, normal);
        ASSERT_GT(cosine, 0.3);
        const SpectrumSum moved = irradiance(before, normal) - irradiance(sky.environment, normal);
        for (int c = 0; c < channel_count; ++c)
            // Channels of slightly different direction share one; texels are floats.
            EXPECT_NEAR(moved[c] / (sun.intensity[c] * cosine), 1.0, 2e-3) << c;
    }
    const SpectrumSum facing = irradiance(before, towards) - irradiance(sky.environment, towards);
    for (int c = 0; c < channel_count; ++c)
        EXPECT_NEAR(facing[c] / sun.intensity[c], 1.0, 1e-5) << c;
}

TEST(SplitSun, LeavesNoTexelAboveTheThreshold) {
    Sky sky;
    sky.at(0, 20) = Spectrum(90000.0f);
    sky.at(127, 20) = Spectrum(60000.0f);  // across the seam: one region
    double mean = 0.0;
    for (int row = 0; row < 64; ++row)
        for (int column = 0; column < 128; ++column)
            mean += texel_solid_angle(*sky.image, row) *
                    mean_channel(SpectrumSum(sky.at(column, row))) / (4.0 * pi);
    const Suns suns = split_sun(sky.environment);
    EXPECT_EQ(suns.lights.size(), 1u);
    EXPECT_GT(suns.share, 0.9);
    EXPECT_LT(suns.share, 1.0);
    for (const Spectrum& t : sky.environment.image->texels)
        EXPECT_LE(mean_channel(t), 10.0 * mean * (1.0 + 1e-6));
    EXPECT_GT(sky.environment.image->texels[20 * 128].x, 0.0f);
    // It points between the two, nearer the brighter: azimuth 0.6 of a texel's left half, turned.
    const double azimuth = std::atan2(-suns.lights[0].direction.x, -suns.lights[0].direction.y);
    EXPECT_NEAR(azimuth, 0.4 + 0.1 * 2.0 * pi / 128.0, 0.3 * 2.0 * pi / 128.0);
}

TEST(SplitSun, LeavesSkiesWithoutSunsAlone) {
    Sky sky;
    for (int row = 0; row < 20; ++row)  // half bright, as an overcast sky
        for (int column = 0; column < 128; ++column) sky.at(column, row) *= 5.0f;
    const auto image = sky.environment.image;
    EXPECT_TRUE(split_sun(sky.environment).lights.empty());
    EXPECT_EQ(sky.environment.image, image);
    Environment uniform;
    uniform.kind = Environment::Kind::uniform;
    EXPECT_TRUE(split_sun(uniform).lights.empty());
    Sky black(8, Spectrum(0.0f));
    EXPECT_TRUE(split_sun(black.environment).lights.empty());
}

TEST(SplitSun, ALargeBrightRegionStaysButForItsCore) {
    Sky sky;
    // A window of 0.35 sr, brighter than ten times the mean.
    for (int row = 28; row < 36; ++row)
        for (int column = 40; column < 52; ++column) sky.at(column, row) = Spectrum(500.0f);
    Environment window = sky.environment;
    EXPECT_TRUE(split_sun(window).lights.empty());
    sky.at(45, 31) = Spectrum(500000.0f);
    const Suns suns = split_sun(sky.environment);
    ASSERT_EQ(suns.lights.size(), 1u);
    EXPECT_EQ(sky.environment.image->texels[30 * 128 + 45], Spectrum(500.0f));
    EXPECT_GE(sky.environment.image->texels[31 * 128 + 45].x, 500.0f);
}

TEST(SplitSun, FindsEverySun) {
    Sky sky;
    sky.at(20, 12) = Spectrum(50000.0f);
    sky.at(90, 25) = Spectrum(30000.0f);
    sky.at(60, 50) = Spectrum(50.0f);  // brings too little
    EXPECT_EQ(split_sun(sky.environment).lights.size(), 2u);
}

}  // namespace
}  // namespace transillum
