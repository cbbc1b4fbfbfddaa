// Whatever happens to a file's bytes, it is refused with a typed error, or what it gives is sound.
// Runs with the address and undefined-behaviour sanitizers on.
#include "unit/scene/damaged_samples.h"
#include "unit/scene/scene_files.h"

#include <random>

namespace transillum {

namespace {

void damage(std::string& bytes, std::mt19937& random) {
    const auto below = [&](std::size_t n) { return static_cast<std::size_t>(random()) % n; };
    const std::size_t at = below(bytes.size());
    switch (below(5)) {
        case 0:
            bytes[at] = static_cast<char>(below(256));
            break;
        case 1:
            bytes[at] = static_cast<char>(bytes[at] ^ 1 << below(8));
            break;
        case 2:
            bytes.erase(at, 1 + below(8));
            break;
        case 3:
            bytes.insert(at, 1 + below(8), bytes[below(bytes.size())]);
            break;
        default:
            bytes[at] = "0123456789-.eE/ \n{}[]\","[below(23)];
            break;
    }
    if (bytes.empty()) bytes.assign(1, ' ');
}

void expect_sound(const Scene& scene) {
    EXPECT_FALSE(scene.polygons.empty());
    for (const glm::dvec3& p : scene.positions) EXPECT_TRUE(is_finite(p));
    for (const std::uint32_t c : scene.corners) EXPECT_LT(c, scene.positions.size());
    for (const Polygon& p : scene.polygons) {
        EXPECT_GE(p.corner_count, 3u);
        EXPECT_LE(std::size_t{p.first_corner} + p.corner_count, scene.corners.size());
        EXPECT_LT(p.material, scene.materials.size());
        EXPECT_LT(p.object, scene.objects.size());
    }
    for (const Material& m : scene.materials) {
        for (int c = 0; c < channel_count; ++c) {
            EXPECT_TRUE(m.diffuse[c] >= 0.0f && m.diffuse[c] <= 1.0f);
            EXPECT_TRUE(m.specular[c] >= 0.0f && m.specular[c] <= 1.0f);
            EXPECT_TRUE(m.emission[c] >= 0.0f && std::isfinite(m.emission[c]));
        }
    }
    EXPECT_TRUE(scene.uvs.empty() || scene.uvs.size() == scene.corners.size());
}

class DamagedFiles : public SceneFiles, public testing::WithParamInterface<Sample> {
protected:
    /// Whether the sample is refused; as it should be, if so.
    bool is_refused(const Sample& sample) {
        for (const auto& [name, bytes] : sample.beside) write(name, bytes);
        try {
            expect_sound(load(sample.file, sample.bytes));
            return false;
        } catch (const InputError& error) {
            const std::string message = error.what();
            EXPECT_EQ(message.find('\n'), std::string::npos) << message;
            EXPECT_NE(message.find(folder_.string()), std::string::npos) << message;
            EXPECT_LT(message.size(), 1000u);
            return true;
        }
    }
};

TEST_P(DamagedFiles, AreWholeAtFirst) {
    EXPECT_FALSE(is_refused(GetParam()));
}

TEST_P(DamagedFiles, AreRefusedOrSound) {
    std::mt19937 random(1);
    int refused = 0;
    constexpr int trials = 400;
    for (int trial = 0; trial < trials; ++trial) {
        Sample sample = GetParam();
        for (int i = 0; i <= trial % 4; ++i) damage(sample.target(), random);
        refused += is_refused(sample);
    }
    // Both outcomes occur: damage to a coordinate's last digits leaves a file as good as before.
    EXPECT_GT(refused, 0);
    EXPECT_LT(refused, trials);
}

TEST_P(DamagedFiles, AreRefusedOrSoundWhereverTheyEnd) {
    const std::size_t size = GetParam().target().size();
    // Of the long file every seventh byte, which falls on every kind of place.
    const std::size_t step = size > 3000 ? 7 : 1;
    int refused = 0;
    for (std::size_t end = 0; end < size; end += step) {
        Sample sample = GetParam();
        sample.target().resize(end);
        refused += is_refused(sample);
    }
    EXPECT_GT(refused, 0);
}

TEST_P(DamagedFiles, OfOneByteOverAndOverAreRefused) {
    for (const char byte : {'\0', ' ', '\n', '1', '-', '{', '[', '"', '\xff', '#', '/', 'f'})
        for (const std::size_t size : {1u, 20u, 83u, 84u, 134u, 5000u}) {
            Sample sample = GetParam();
            if (sample.damaged >= 0) continue;
            sample.bytes.assign(size, byte);
            EXPECT_TRUE(is_refused(sample)) << size << " of " << static_cast<int>(byte);
        }
}

TEST_P(DamagedFiles, MayBeFoldersOrEmptyOrAbsent) {
    const std::filesystem::path file = folder_ / GetParam().file;
    EXPECT_THROW((void)load_scene(file, {}, monitor_), IoError);
    std::filesystem::create_directory(file);
    EXPECT_THROW((void)load_scene(file, {}, monitor_), IoError);
    std::filesystem::remove(file);
    EXPECT_THROW((void)load(GetParam().file, ""), InputError);
}

INSTANTIATE_TEST_SUITE_P(All, DamagedFiles, testing::ValuesIn(samples()),
                         [](const auto& info) { return info.param.name; });

using DamagedContainers = DamagedFiles;

/// What the container says of its own size does not give the damage away.
TEST_P(DamagedContainers, AreRefusedWithLengthsPutRight) {
    const std::string& whole = GetParam().bytes;
    const auto put = [](std::string& bytes, std::size_t at, std::size_t value) {
        if (at + 4 <= bytes.size())
            bytes.replace(at, 4, bytes_of(static_cast<std::uint32_t>(value)));
    };
    std::uint32_t json_size = 0;
    std::memcpy(&json_size, whole.data() + 12, 4);
    const std::size_t binary = 20 + json_size;
    for (std::size_t end = 20; end < whole.size(); ++end) {
        Sample sample = GetParam();
        sample.bytes.resize(end);
        put(sample.bytes, 8, end);
        put(sample.bytes, 12, std::min<std::size_t>(json_size, end - 20));
        if (end >= binary + 8) put(sample.bytes, binary, end - binary - 8);
        // The padding at the end may go.
        EXPECT_TRUE(is_refused(sample) || end + 3 >= whole.size()) << end;
    }
}

INSTANTIATE_TEST_SUITE_P(All, DamagedContainers, testing::Values(samples().back()),
                         [](const auto& info) { return info.param.name; });

TEST(RealDataDamaged, AreRefusedOrSound) {
    const std::filesystem::path broken =
        std::filesystem::path(TRANSILLUM_TEST_DATA) / "meshes/broken";
    if (!std::filesystem::exists(broken)) GTEST_SKIP() << "no meshes in " << broken;
    for (const auto& entry : std::filesystem::directory_iterator(broken)) {
        Monitor silent;
        EXPECT_THROW((void)load_scene(entry.path(), {}, silent), InputError) << entry.path();
    }
}

}  // namespace

}  // namespace transillum
