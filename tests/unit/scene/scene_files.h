/// Small scene files, written, loaded and looked at by the tests.
#pragma once

#include <transillum/base/error.h>
#include <transillum/base/monitor.h>
#include <transillum/scene/load_scene.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

namespace transillum {

class RecordingMonitor : public Monitor {
public:
    void warn(const std::string& text) override { warnings.push_back(text); }
    void note(const std::string& text) override { notes.push_back(text); }
    [[nodiscard]] static bool any_names(const std::vector<std::string>& texts,
                                        const std::string& part) {
        return std::ranges::any_of(
            texts, [&](const std::string& t) { return t.find(part) != std::string::npos; });
    }
    std::vector<std::string> warnings, notes;
};

/// A fresh folder for each test, removed after it.
class SceneFiles : public testing::Test {
protected:
    SceneFiles() {
        const testing::TestInfo* info = testing::UnitTest::GetInstance()->current_test_info();
        std::string name = testing::TempDir() + "transillum_XXXXXX";
        folder_ = mkdtemp(name.data());
        EXPECT_TRUE(std::filesystem::is_directory(folder_)) << info->name();
    }
    ~SceneFiles() override { std::filesystem::remove_all(folder_); }

    std::filesystem::path write(const std::string& name, const std::string& bytes) const {
        std::ofstream(folder_ / name, std::ios::binary) << bytes;
        return folder_ / name;
    }
    Scene load(const std::string& name, const std::string& bytes, const LoadOptions& options = {}) {
        return load_scene(write(name, bytes), options, monitor_);
    }
    /// Expects an InputError of one line that contains every part.
    void expect_refused(const std::string& name, const std::string& bytes,
                        const std::vector<std::string>& parts) {
        try {
            load(name, bytes);
        } catch (const InputError& error) {
            const std::string message = error.what();
            EXPECT_EQ(message.find('\n'), std::string::npos) << message;
            for (const std::string& part : parts)
                EXPECT_NE(message.find(part), std::string::npos) << message;
            return;
        }
        ADD_FAILURE() << name << " was accepted; should have said " << parts.front();
    }
    /// Expects every proper beginning of a file to be refused, down to one byte.
    void expect_no_beginning_loads(const std::string& name, const std::string& bytes) {
        for (std::size_t size = 1; size < bytes.size(); ++size)
            EXPECT_THROW(load(name, bytes.substr(0, size)), InputError)
                << size << " of " << bytes.size() << " bytes";
    }

    std::filesystem::path folder_;
    RecordingMonitor monitor_;
};

template <class T>
std::string bytes_of(T value, bool big_endian = false) {
    std::string bytes(sizeof value, '\0');
    std::memcpy(bytes.data(), &value, sizeof value);
    if (big_endian) std::ranges::reverse(bytes);
    return bytes;
}

inline std::vector<glm::dvec3> corners_of(const Scene& scene, std::size_t polygon) {
    std::vector<glm::dvec3> corners;
    const Polygon& p = scene.polygons.at(polygon);
    for (std::uint32_t i = 0; i < p.corner_count; ++i)
        corners.push_back(scene.positions.at(scene.corners.at(p.first_corner + i)));
    return corners;
}

}  // namespace transillum
