#include <transillum/base/error.h>
#include <transillum/render/image.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace transillum {
namespace {

Image grey_image(int width, int height, float value) {
    return {width,
            height,
            std::vector<Spectrum>(static_cast<std::size_t>(width) * height, Spectrum(value)),
            {}};
}

TEST(CompareImages, EqualImagesDoNotDiffer) {
    const Image image = grey_image(3, 2, 0.7f);
    const ImageDifference d = compare_images(image, image);
    EXPECT_EQ(d.bias, 0.0);
    EXPECT_EQ(d.relative_rmse, 0.0);
    EXPECT_EQ(d.largest, 0.0);
    EXPECT_EQ(d.compared, 6u);
    EXPECT_EQ(d.left_out, 0u);
}

TEST(CompareImages, MeasuresRelativeToTheReference) {
    Image a = grey_image(2, 2, 2.0f);
    const Image b = grey_image(2, 2, 2.0f);
    a.at(0, 0) = Spectrum(4.0f);
    a.at(1, 1) = Spectrum(1.0f);
    const ImageDifference d = compare_images(a, b);
    EXPECT_NEAR(d.bias, (2.0 - 1.0) / 4.0 / 2.0, 1e-7);
    EXPECT_NEAR(d.relative_rmse, std::sqrt((4.0 + 1.0) / 4.0) / 2.0, 1e-7);
    EXPECT_NEAR(d.largest, 1.0, 1e-7);
}

TEST(CompareImages, LeavesOutEmittersAndTheirNeighboursOfBothImages) {
    Image a = grey_image(8, 4, 1.0f), b = a;
    a.emitter_mask.assign(32, 0.0f);
    b.emitter_mask.assign(32, 0.0f);
    a.emitter_mask[0] = 0.25f;         // the corner (0, 0): 4 pixels
    b.emitter_mask[2 * 8 + 6] = 1.0f;  // (6, 2): 9 pixels
    a.at(1, 1) = b.at(5, 3) = Spectrum(100.0f);
    const ImageDifference d = compare_images(a, b);
    EXPECT_EQ(d.left_out, 13u);
    EXPECT_EQ(d.compared, 19u);
    EXPECT_EQ(d.largest, 0.0);
    a.at(2, 0) = Spectrum(2.0f);
    EXPECT_NEAR(compare_images(a, b).largest, 1.0, 1e-7);
}

TEST(CompareImages, LightWhereTheReferenceIsBlackIsInfinitelyWrong) {
    EXPECT_TRUE(std::isinf(compare_images(grey_image(2, 2, 1.0f), grey_image(2, 2, 0.0f)).bias));
    EXPECT_EQ(compare_images(grey_image(2, 2, 0.0f), grey_image(2, 2, 0.0f)).bias, 0.0);
}

TEST(CompareImages, RefusesWhatCannotBeCompared) {
    Image a = grey_image(2, 2, 1.0f);
    EXPECT_THROW((void)compare_images(a, grey_image(2, 3, 1.0f)), InputError);
    Image all_emitters = a;
    all_emitters.emitter_mask.assign(4, 1.0f);
    EXPECT_THROW((void)compare_images(a, all_emitters), InputError);
    Image broken = a;
    broken.at(1, 0).y = std::numeric_limits<float>::quiet_NaN();
    EXPECT_THAT(
        [&] { (void)compare_images(a, broken); },
        testing::ThrowsMessage<InputError>(testing::HasSubstr("second image: pixel (1, 0)")));
}

}  // namespace
}  // namespace transillum
