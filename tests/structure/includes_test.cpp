// The layering that the folders promise, held against the sources themselves.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <regex>
#include <string>
#include <vector>

namespace {

namespace fs = std::filesystem;

constexpr std::array<const char*, 10> stages{"base",       "scene",      "repair",    "geometry",
                                             "visibility", "first_shot", "transport", "solution",
                                             "render",     "cli"};

std::ptrdiff_t rank(const std::string& stage) {
    return std::ranges::find(stages, stage) - stages.begin();
}

struct Include {
    std::string file;   ///< relative to the repository
    std::string stage;  ///< of that file
    bool is_public;
    std::string included;  ///< without brackets or quotes
    bool in_brackets;
};

std::string where(const Include& i) {
    return i.file + " includes " + i.included;
}

void read_includes(const fs::path& folder, bool is_public, std::vector<Include>& includes) {
    const std::regex directive(R"re(^\s*#\s*include\s*(<|")([^>"]+)[>"].*)re");
    for (const auto& entry : fs::recursive_directory_iterator(folder)) {
        const std::string extension = entry.path().extension().string();
        if (extension != ".h" && extension != ".cpp") continue;
        const std::string file = fs::relative(entry.path(), TRANSILLUM_SOURCE_DIR).string();
        const std::string stage = fs::relative(entry.path(), folder).begin()->string();
        std::ifstream in(entry.path());
        std::smatch m;
        for (std::string line; std::getline(in, line);)
            if (std::regex_match(line, m, directive))
                includes.push_back({file, stage, is_public, m[2], m[1] == "<"});
    }
}

const std::vector<Include>& all_includes() {
    static const std::vector<Include> includes = [] {
        const fs::path top(TRANSILLUM_SOURCE_DIR);
        std::vector<Include> read;
        read_includes(top / "include" / "transillum", true, read);
        read_includes(top / "src", false, read);
        return read;
    }();
    return includes;
}

/// The stage an include reaches into; empty for other libraries and for a file's own folder.
std::string stage_reached(const Include& i) {
    std::string path = i.included;
    if (path.starts_with("transillum/"))
        path.erase(0, std::string("transillum/").size());
    else if (i.in_brackets)
        return {};
    const std::string first = path.substr(0, path.find('/'));
    return rank(first) < std::ssize(stages) && first != path ? first : std::string();
}

TEST(Structure, EveryFileBelongsToAStage) {
    for (const Include& i : all_includes()) EXPECT_LT(rank(i.stage), std::ssize(stages)) << i.file;
}

TEST(Structure, StagesIncludeOnlyEarlierOnes) {
    int across = 0;
    for (const Include& i : all_includes()) {
        const std::string reached = stage_reached(i);
        if (reached.empty()) continue;
        EXPECT_LE(rank(reached), rank(i.stage)) << where(i);
        across += reached != i.stage;
    }
    EXPECT_GT(across, 0) << "no include was recognized: this test saw nothing";
}

TEST(Structure, AStageUsesOthersByTheirPublicHeaders) {
    for (const Include& i : all_includes()) {
        if (i.in_brackets) continue;
        const std::string reached = stage_reached(i);
        EXPECT_TRUE(reached.empty() || reached == i.stage) << where(i);
    }
}

TEST(Structure, PublicHeadersNeedNothingButGlm) {
    const std::regex standard("[a-z_0-9]+");
    int glm = 0;
    for (const Include& i : all_includes()) {
        if (!i.is_public) continue;
        EXPECT_TRUE(i.in_brackets) << where(i);
        const bool is_glm = i.included.starts_with("glm/");
        EXPECT_TRUE(is_glm || i.included.starts_with("transillum/") ||
                    std::regex_match(i.included, standard))
            << where(i);
        glm += is_glm;
    }
    EXPECT_GT(glm, 0) << "no include was recognized: this test saw nothing";
}

struct Home {
    const char* name;
    const char* pattern;  ///< of its headers
    std::vector<std::string> stages;
};

void PrintTo(const Home& home, std::ostream* out) {
    *out << home.name;
}

class LibraryHome : public testing::TestWithParam<Home> {};

TEST_P(LibraryHome, IsIncludedNowhereElse) {
    const std::regex pattern(GetParam().pattern);
    int found = 0;
    for (const Include& i : all_includes()) {
        if (!i.in_brackets || !std::regex_match(i.included, pattern)) continue;
        ++found;
        EXPECT_NE(std::ranges::count(GetParam().stages, i.stage), 0) << where(i);
    }
    EXPECT_GT(found, 0) << "the library is not used any more; leave it out of the build";
}

INSTANTIATE_TEST_SUITE_P(Structure, LibraryHome,
                         testing::Values(Home{"CGAL", "CGAL/.*", {"repair"}},
                                         Home{"OpenMesh", "OpenMesh/.*", {"repair", "geometry"}},
                                         Home{"Embree", "embree3?/.*", {"visibility"}},
                                         Home{"VTK", "vtk.*", {"solution"}},
                                         Home{"OpenImageIO", "OpenImageIO/.*", {"scene", "render"}},
                                         Home{"TBB", "(oneapi/)?tbb/.*", {"base"}},
                                         Home{"CLI11", "CLI/.*", {"cli"}},
                                         Home{"spdlog", "spdlog/.*", {"cli"}},
                                         Home{"httplib", "httplib\\.h", {"cli"}}),
                         [](const auto& info) { return std::string(info.param.name); });

}  // namespace
