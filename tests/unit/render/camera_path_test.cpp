#include <transillum/base/error.h>
#include <transillum/render/camera_path.h>

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

namespace {

using namespace transillum;

class CameraPathFile : public testing::Test {
protected:
    ~CameraPathFile() override { std::filesystem::remove(file_); }

    CameraPath read(const std::string& text) const {
        std::ofstream(file_) << text;
        return read_camera_path(file_);
    }
    [[nodiscard]] std::string error_of(const std::string& text) const {
        try {
            static_cast<void>(read(text));
        } catch (const InputError& e) {
            return e.what();
        }
        return "accepted";
    }

    std::filesystem::path file_ =
        std::filesystem::path(testing::TempDir()) /
        (std::string("path-") + testing::UnitTest::GetInstance()->current_test_info()->name() +
         ".path");
};

TEST_F(CameraPathFile, IsLinearBetweenKeyFrames) {
    const CameraPath path = read(
        "# a walk\n"
        "1 0 0 0  0 0 -1  0 1 0  40\n"
        "\n"
        "3 4 2 0  4 2 -2  0 1 0  60  # there\n");
    ASSERT_EQ(path.size(), 2u);
    const Camera half = camera_at(path, 2.0);
    EXPECT_EQ(half.eye, glm::dvec3(2, 1, 0));
    EXPECT_EQ(half.look_at, glm::dvec3(2, 1, -1.5));
    EXPECT_EQ(half.up, glm::dvec3(0, 1, 0));
    EXPECT_EQ(half.vertical_fov, 50.0);
    EXPECT_EQ(camera_at(path, -5.0).eye, glm::dvec3(0));
    EXPECT_EQ(camera_at(path, 1.0).eye, glm::dvec3(0));
    EXPECT_EQ(camera_at(path, 3.0).eye, glm::dvec3(4, 2, 0));
    EXPECT_EQ(camera_at(path, 9.0).vertical_fov, 60.0);
}

TEST_F(CameraPathFile, ErrorsNameTheLine) {
    const std::string good = "0 0 0 0 0 0 -1 0 1 0 45\n";
    const auto has = [&](const std::string& text, const std::string& part) {
        const std::string error = error_of(text);
        EXPECT_NE(error.find(part), std::string::npos) << error;
    };
    has(good + "1 2 3\n", ":2: 3 numbers; accepted: 11");
    has(good + "1 0 0 0 0 0 -1 0 1 0 45 7\n", ":2: 12 numbers");
    has("0 0 0 x 0 0 -1 0 1 0 45\n", ":1: 'x'; accepted: a finite number");
    has("0 0 0 nan 0 0 -1 0 1 0 45\n", "'nan'");
    has(good + "\n" + good, ":3: a time of");
    has("0 0 0 0 0 0 -1 0 1 0 180\n", "a field of view of 180");
    has("0 0 0 0 0 0 -1 0 0 1 45\n", "span no frame");
    has("# nothing\n", "no key frame");
    EXPECT_THROW(static_cast<void>(read_camera_path("/no/such.path")), IoError);
}

}  // namespace
