#include <transillum/base/error.h>
#include <transillum/render/image.h>

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <limits>

#include <unistd.h>

namespace transillum {
namespace {

namespace fs = std::filesystem;

class ImageFiles : public ::testing::Test {
protected:
    void SetUp() override {
        const auto* test = ::testing::UnitTest::GetInstance()->current_test_info();
        folder_ = fs::path(::testing::TempDir()) /
                  (std::string("transillum-") + test->name() + "-" + std::to_string(getpid()));
        fs::create_directories(folder_);
    }
    void TearDown() override { fs::remove_all(folder_); }

    [[nodiscard]] std::size_t entries() const {
        return static_cast<std::size_t>(
            std::distance(fs::directory_iterator(folder_), fs::directory_iterator()));
    }
    fs::path folder_;
};

Image gradient(int width, int height) {
    Image image{width, height, {}, {}};
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            image.pixels.emplace_back(0.001f * static_cast<float>(x + 1),
                                      3.7f * static_cast<float>(y), 1e4f / 3.0f);
    return image;
}

TEST_F(ImageFiles, ExrKeepsEveryBitAndTheMask) {
    Image image = gradient(7, 5);
    for (int i = 0; i < 35; ++i) image.emitter_mask.push_back(static_cast<float>(i % 3) / 3.0f);
    write_image(image, folder_ / "a.exr");
    const Image again = read_image(folder_ / "a.exr");
    EXPECT_EQ(again.width, 7);
    EXPECT_EQ(again.height, 5);
    EXPECT_EQ(again.pixels, image.pixels);
    EXPECT_EQ(again.emitter_mask, image.emitter_mask);
    EXPECT_EQ(entries(), 1u);
}

TEST_F(ImageFiles, ExrWithoutMaskHasNone) {
    write_image(gradient(3, 3), folder_ / "a.EXR");
    EXPECT_TRUE(read_image(folder_ / "a.EXR").emitter_mask.empty());
}

TEST_F(ImageFiles, PngHoldsDisplayValues) {
    Image image{
        4, 1, {Spectrum(0.0f), Spectrum(0.18f), Spectrum(0.5f, 0.25f, 0.0f), Spectrum(50.0f)}, {}};
    write_image(image, folder_ / "a.png", {0.0, false});
    const Image again = read_image(folder_ / "a.png");
    ASSERT_EQ(again.pixels.size(), 4u);
    // Half a step of 8 bits where the sRGB curve is steepest in linear terms: 2.4 / 1.055 / 510.
    const float step = 0.0045f;
    for (int i = 0; i < 3; ++i)
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(again.pixels[i][c], image.pixels[i][c], step);
    EXPECT_NEAR(again.pixels[3].x, 1.0f, step);
}

TEST_F(ImageFiles, OverwritesAWholeImageAtOnce) {
    write_image(gradient(7, 5), folder_ / "a.exr");
    write_image(gradient(2, 2), folder_ / "a.exr");
    EXPECT_EQ(read_image(folder_ / "a.exr").width, 2);
    EXPECT_EQ(entries(), 1u);
}

TEST_F(ImageFiles, FailuresLeaveNothingBehind) {
    EXPECT_THROW(write_image(gradient(2, 2), folder_ / "missing" / "a.exr"), IoError);
    EXPECT_THROW(write_image(gradient(2, 2), folder_ / "a.jpg"), UsageError);
    EXPECT_THROW(write_image(gradient(2, 2), folder_ / "a"), UsageError);
    fs::create_directories(folder_ / "taken.png" / "inside");
    EXPECT_THROW(write_image(gradient(2, 2), folder_ / "taken.png"), IoError);
    Image broken = gradient(2, 2);
    broken.at(1, 1).z = std::numeric_limits<float>::infinity();
    EXPECT_THROW(write_image(broken, folder_ / "b.exr"), InputError);
    EXPECT_EQ(entries(), 1u);
}

TEST_F(ImageFiles, ReadingNamesWhatIsWrong) {
    EXPECT_THROW((void)read_image(folder_ / "absent.exr"), IoError);
    std::ofstream(folder_ / "text.exr") << "no image at all";
    EXPECT_THROW((void)read_image(folder_ / "text.exr"), InputError);
    write_image(gradient(64, 64), folder_ / "cut.exr");
    fs::resize_file(folder_ / "cut.exr", fs::file_size(folder_ / "cut.exr") / 2);
    EXPECT_THROW((void)read_image(folder_ / "cut.exr"), InputError);
}

}  // namespace
}  // namespace transillum
