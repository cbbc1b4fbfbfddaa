// The scenes that the scripts under data/scripts write, and the spectra beside them.
#include "unit/scene/scene_files.h"

#include <glm/geometric.hpp>

#include <array>
#include <map>
#include <set>
#include <sstream>
#include <utility>

namespace transillum {

namespace {

const std::string data = TRANSILLUM_SOURCE_DIR "/data/";

std::string text_of(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

class PaperScenes : public SceneFiles {
protected:
    /// Writes a scene twice and loads it.
    Scene generate(const std::string& script, const std::string& name,
                   const std::string& options = {}) {
        for (const char* folder : {"one", "two"}) {
            const std::string command = TRANSILLUM_PYTHON " -B " + data + "scripts/" + script +
                                        " " + options + " " + (folder_ / folder).string() +
                                        " > /dev/null";
            EXPECT_EQ(std::system(command.c_str()), 0) << command;
        }
        for (const char* extension : {".obj", ".mtl"}) {
            const std::string first = text_of(folder_ / "one" / (name + extension));
            EXPECT_FALSE(first.empty()) << name << extension;
            EXPECT_TRUE(first == text_of(folder_ / "two" / (name + extension))) << extension;
        }
        Scene scene = load_scene(folder_ / "one" / (name + ".obj"), {}, monitor_);
        EXPECT_TRUE(monitor_.warnings.empty()) << monitor_.warnings[0];
        return scene;
    }
    void SetUp() override {
        if (std::string(TRANSILLUM_PYTHON).empty()) GTEST_SKIP() << "no python3";
    }
};

std::size_t triangle_count(const Scene& scene) {
    std::size_t count = 0;
    for (const Polygon& p : scene.polygons) count += p.corner_count - 2;
    return count;
}

double largest_albedo(const Scene& scene) {
    float largest = 0.0f;
    for (const Material& m : scene.materials) largest = std::max(largest, max_channel(m.albedo()));
    return static_cast<double>(largest);
}

/// Objects that have an edge whose sides don't match, or a volume that is not positive.
std::set<std::string> unsound_objects(const Scene& scene) {
    std::map<std::array<std::uint32_t, 3>, int> edges;  // object and corners
    std::vector<double> volume(scene.objects.size(), 0.0);
    for (std::size_t p = 0; p < scene.polygons.size(); ++p) {
        const std::uint32_t object = scene.polygons[p].object;
        const auto points = corners_of(scene, p);
        const std::uint32_t* corners = &scene.corners[scene.polygons[p].first_corner];
        for (std::size_t i = 0; i < points.size(); ++i) {
            const std::uint32_t a = corners[i], b = corners[(i + 1) % points.size()];
            edges[{object, std::min(a, b), std::max(a, b)}] += a < b ? 1 : -1;
            if (i >= 2) volume[object] += glm::dot(points[0], glm::cross(points[i - 1], points[i]));
        }
    }
    std::set<std::string> unsound;
    for (const auto& [edge, balance] : edges)
        if (balance != 0) unsound.insert(scene.objects[edge[0]]);
    for (std::size_t object = 0; object < volume.size(); ++object)
        if (volume[object] <= 0.0) unsound.insert(scene.objects[object]);
    return unsound;
}

bool crosses(const glm::dvec3& from, const glm::dvec3& to, const glm::dvec3& a, const glm::dvec3& b,
             const glm::dvec3& c) {
    const glm::dvec3 d = to - from, normal = glm::cross(b - a, c - a);
    const double along = glm::dot(d, normal);
    if (along == 0.0) return false;
    const double t = glm::dot(a - from, normal) / along;
    const glm::dvec3 p = from + t * d;
    return t >= 0.0 && t <= 1.0 && glm::dot(glm::cross(b - a, p - a), normal) >= 0.0 &&
           glm::dot(glm::cross(c - b, p - b), normal) >= 0.0 &&
           glm::dot(glm::cross(a - c, p - c), normal) >= 0.0;
}

/// The object that a straight line runs into, or nothing.
std::string obstacle(const Scene& scene, const glm::dvec3& from, const glm::dvec3& to) {
    for (std::size_t p = 0; p < scene.polygons.size(); ++p) {
        const auto c = corners_of(scene, p);
        for (std::size_t i = 1; i + 1 < c.size(); ++i)
            if (crosses(from, to, c[0], c[i], c[i + 1]))
                return scene.objects[scene.polygons[p].object];
    }
    return {};
}

const Material& material(const Scene& scene, const std::string& name) {
    return *std::ranges::find(scene.materials, name, &Material::name);
}

/// The numbers of a table, without its comments and titles.
std::vector<std::vector<double>> table(const std::string& name) {
    std::istringstream lines(text_of(data + "spectra/" + name));
    std::vector<std::vector<double>> rows;
    for (std::string line; std::getline(lines, line);) {
        if (line.empty() || line[0] < '0' || line[0] > '9') continue;
        std::istringstream words(line);
        rows.emplace_back();
        for (std::string word; std::getline(words, word, ',');)
            rows.back().push_back(std::stod(word));
    }
    return rows;
}

TEST_F(PaperScenes, HaveASierpinskiSetOf4479Patches) {
    const Scene scene = generate("sierpinski.py", "sierpinski");
    EXPECT_EQ(triangle_count(scene), 4479u);
    EXPECT_EQ(scene.cameras.at(0).name, "front");
    // Seen from inside, the room is wound outwards to itself; the luminaire is open.
    EXPECT_EQ(unsound_objects(scene), (std::set<std::string>{"room", "luminaire"}));
    const Material& set = material(scene, "set");
    EXPECT_EQ(set.diffuse, Spectrum(0.06f, 0.03f, 0.09f)) << "at 700, 552, 400 nm";
    EXPECT_EQ(set.specular, Spectrum(0.8f));
    EXPECT_EQ(set.shininess, 3.0f);
}

TEST_F(PaperScenes, HaveClosedChickens) {
    const Scene scene = generate("cornell_chickens.py", "cornell_chickens");
    EXPECT_EQ(unsound_objects(scene), (std::set<std::string>{"room", "light"}));
    EXPECT_GT(triangle_count(scene), 7000u);
    EXPECT_LT(triangle_count(scene), 12000u);
    EXPECT_EQ(material(scene, "egg").albedo(), Spectrum(0.9f));
    for (const Material& m : scene.materials) {
        const float shine = m.emits() ? 0.0f : 10.0f;
        EXPECT_EQ(m.shininess, shine) << m.name;
    }
}

TEST_F(PaperScenes, HaveASoundHouseOf31000Polygons) {
    const Scene scene = generate("house.py", "house");
    EXPECT_NEAR(static_cast<double>(scene.polygons.size()), 31000.0, 0.02 * 31000.0);
    EXPECT_TRUE(unsound_objects(scene).empty()) << *unsound_objects(scene).begin();
    EXPECT_LE(largest_albedo(scene), 0.85);
    EXPECT_GE(scene.cameras.size(), 4u);
}

TEST_F(PaperScenes, HaveAWalkThroughDoors) {
    const Scene scene = generate("house.py", "house");
    std::istringstream lines(text_of(folder_ / "one" / "house.path"));
    std::vector<glm::dvec3> eyes;
    double before = -1.0;
    for (std::string line; std::getline(lines, line);) {
        if (line.starts_with('#')) continue;
        std::istringstream numbers(line);
        std::array<double, 11> key{};
        for (double& n : key) ASSERT_TRUE(numbers >> n) << line;
        EXPECT_GT(key[0], before);
        before = key[0];
        eyes.emplace_back(key[1], key[2], key[3]);
    }
    ASSERT_GE(eyes.size(), 5u);
    for (std::size_t i = 1; i < eyes.size(); ++i)
        EXPECT_EQ(obstacle(scene, eyes[i - 1], eyes[i]), "") << i;
}

TEST(Spectra, HoldTheObserverAndTheBox) {
    const auto observer = table("cie1931.csv");
    ASSERT_EQ(observer.size(), 81u);
    // The three functions of the 1931 observer have one integral, 106.857 nm.
    for (const std::size_t function : {1u, 2u, 3u}) {
        double integral = 0.0;
        for (const auto& row : observer) integral += 5.0 * row.at(function);
        EXPECT_NEAR(integral, 106.857, 0.001);
    }
    const auto box = table("cornell_reflectance.csv");
    ASSERT_EQ(box.size(), 76u);
    for (std::size_t i = 0; i < box.size(); ++i) {
        EXPECT_EQ(box[i].at(0), 400.0 + 4.0 * static_cast<double>(i));
        for (const std::size_t paint : {1u, 2u, 3u}) {
            EXPECT_GT(box[i].at(paint), 0.0);
            EXPECT_LT(box[i].at(paint), 0.8);
        }
    }
    EXPECT_EQ(table("cornell_light.csv").back(), (std::vector<double>{700.0, 18.4}));
}

}  // namespace

}  // namespace transillum
