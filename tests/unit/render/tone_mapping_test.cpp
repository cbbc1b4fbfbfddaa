#include "render/tone_mapping.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace transillum {
namespace {

/// As many insides of closed things as walls, into which a trace of light gets.
TEST(SurfaceExposure, GoesByWhatIsLit) {
    const std::vector<Spectrum> lit(100, Spectrum(0.5f));
    std::vector<Spectrum> all = lit;
    all.insert(all.end(), 150, Spectrum(1e-3f));
    all.emplace_back(1000.0f);
    std::vector<float> emits(all.size(), 0.0f);
    emits.back() = 1.0f;
    EXPECT_EQ(surface_exposure_factor(all, emits, {}), surface_exposure_factor(lit, {}, {}));
    EXPECT_NE(exposure_factor(all, emits, {}), surface_exposure_factor(lit, {}, {}));
    EXPECT_EQ(surface_exposure_factor(lit, {}, {}), exposure_factor(lit, {}, {}));
    EXPECT_EQ(surface_exposure_factor(all, emits, {1.0, false}), 2.0f);
}

TEST(ToneMapping, MidTonesStayLinear) {
    const Spectrum c(0.5f, 0.2f, 0.0f);
    EXPECT_EQ(compress_highlights(c), c);
}

TEST(ToneMapping, IsMonotoneSmoothAndBelowOne) {
    const float rounding = 0x1p-22f;
    float before = 0.0f;
    for (float x = 0.001f; x < 20.0f; x *= 1.01f) {
        const float y = compress_highlights(Spectrum(x)).x;
        EXPECT_GE(y, before - rounding);
        EXPECT_LE(y, std::min(x, 1.0f) + rounding);
        EXPECT_LT(y - before, 0.011f * x + 1e-3f);
        before = y;
    }
    EXPECT_GT(before, 0.99f);
}

TEST(ToneMapping, HuesSurviveHighlights) {
    const Spectrum c(8.0f, 4.0f, 1.0f), shown = compress_highlights(c);
    EXPECT_NEAR(shown.x / shown.y, 2.0f, 1e-5f);
    EXPECT_NEAR(shown.x / shown.z, 8.0f, 1e-5f);
}

TEST(ToneMapping, SrgbCurveAndItsInverseAgree) {
    for (int i = 0; i <= 255; ++i) {
        const float encoded = static_cast<float>(i) / 255.0f;
        EXPECT_NEAR(srgb_from_linear(linear_from_srgb(encoded)), encoded, 1e-5f);
    }
    EXPECT_NEAR(srgb_from_linear(0.18f), 0.4613561f, 1e-5f);
    EXPECT_NEAR(srgb_from_linear(7.0f), 1.0f, 1e-6f);
    EXPECT_EQ(srgb_from_linear(-1.0f), 0.0f);
}

TEST(ToneMapping, AutomaticExposureIgnoresBlackPixelsAndEmitters) {
    Image image{10, 1, std::vector<Spectrum>(10, Spectrum(0.0f)), std::vector<float>(10, 0.0f)};
    for (int i = 0; i < 3; ++i) image.pixels[i] = Spectrum(0.09f);
    for (int i = 3; i < 7; ++i) {
        image.pixels[i] = Spectrum(1000.0f);
        image.emitter_mask[i] = 1.0f;
    }
    EXPECT_NEAR(exposure_factor(image, {}), 2.0f, 1e-5f);
    EXPECT_NEAR(exposure_factor(image, {1.0, true}), 4.0f, 1e-5f);
    EXPECT_EQ(exposure_factor(image, {-1.0, false}), 0.5f);
    image.emitter_mask.assign(10, 1.0f);
    EXPECT_NEAR(exposure_factor(image, {}), 0.18f / 1000.0f, 1e-8f);
    image.pixels.assign(10, Spectrum(0.0f));
    EXPECT_EQ(exposure_factor(image, {}), 1.0f);
}

}  // namespace
}  // namespace transillum
