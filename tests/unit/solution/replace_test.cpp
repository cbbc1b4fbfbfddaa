#include "random_solution.h"

#include <transillum/base/error.h>
#include <transillum/solution/load_solution.h>
#include <transillum/solution/save_defects.h>

#include <gmock/gmock.h>

#include <csignal>
#include <fstream>

#include <sys/resource.h>
#include <unistd.h>

namespace transillum::test {

namespace fs = std::filesystem;

namespace {

const Solution& old_solution() {
    static const Solution solution = random_solution({.levels = {1, 1}}, 1);
    return solution;
}

const Solution& new_solution() {
    static const Solution solution = random_solution({.levels = {5, 5}, .light_samples = 0}, 2);
    return solution;
}

template <class E>
void expect_refused(const fs::path& path, const std::string& message) {
    try {
        save_solution(new_solution(), {}, path);
        ADD_FAILURE() << "saved to " << path;
    } catch (const E& error) {
        EXPECT_THAT(error.what(), testing::HasSubstr(message));
        EXPECT_THAT(error.what(), testing::HasSubstr(path.stem().string()));
    }
}

/// No file may grow beyond some bytes: a disk that is full.
class FullDisk {
public:
    explicit FullDisk(rlim_t bytes) : handler_(std::signal(SIGXFSZ, SIG_IGN)) {
        getrlimit(RLIMIT_FSIZE, &before_);
        const rlimit limit{bytes, before_.rlim_max};
        setrlimit(RLIMIT_FSIZE, &limit);
    }
    FullDisk(const FullDisk&) = delete;
    FullDisk& operator=(const FullDisk&) = delete;
    ~FullDisk() {
        setrlimit(RLIMIT_FSIZE, &before_);
        std::signal(SIGXFSZ, handler_);
    }

private:
    rlimit before_{};
    void (*handler_)(int);
};

void touch(const fs::path& path) {
    std::ofstream(path) << "mine";
}

}  // namespace

TEST(Replace, AnOlderSolutionGivesWay) {
    const auto folder = fresh_folder();
    save_solution(old_solution(), {}, folder / "room.vtm");
    save_solution(new_solution(), {}, folder / "room.vtm");
    expect_equal(new_solution(), load_solution(folder / "room.vtm"));
    // The new one has no light samples; nothing of the old one is left, no temporary folder either.
    EXPECT_EQ(files_below(folder).size(), 6u);
    EXPECT_FALSE(fs::exists(folder / "room" / "incoming.vtp"));
}

TEST(Replace, FullDiskLeavesTheOlderSolutionWhole) {
    const auto folder = fresh_folder();
    save_solution(old_solution(), {}, folder / "room.vtm");
    const auto before = files_below(folder);
    for (const rlim_t bytes : {0, 100, 5000, 60000}) {
        const FullDisk disk(bytes);
        expect_refused<IoError>(folder / "room.vtm", "cannot write: File too large");
    }
    EXPECT_EQ(files_below(folder), before);
}

TEST(Replace, FullDiskLeavesNothingBehind) {
    const auto folder = fresh_folder();
    const FullDisk disk(100);
    expect_refused<IoError>(folder / "room.vtm", "cannot write: File too large");
    EXPECT_TRUE(fs::is_empty(folder));
}

TEST(Replace, FullDiskLeavesTheOlderDefectsWhole) {
    const auto folder = fresh_folder();
    const fs::path path = folder / "leaks.vtp";
    save_leaks({}, path);
    const auto before = files_below(folder);
    const Leak leak{"lamp", std::vector<glm::dvec3>(2, glm::dvec3(1.0)), 1.0, 1.0, false};
    {
        const FullDisk disk(100);
        EXPECT_THROW(save_leaks({leak}, path), IoError);
    }
    EXPECT_EQ(files_below(folder), before);
    save_leaks({leak}, path);
    EXPECT_EQ(files_below(folder).size(), 1u);
    EXPECT_NE(files_below(folder), before);
    EXPECT_THROW(save_leaks({leak}, folder / "no" / "leaks.vtp"), IoError);
}

TEST(Replace, MissingParent) {
    const auto folder = fresh_folder();
    expect_refused<IoError>(folder / "no" / "room.vtm", "No such file or directory");
    EXPECT_TRUE(fs::is_empty(folder));
}

TEST(Replace, ParentIsAFile) {
    const auto folder = fresh_folder();
    touch(folder / "file");
    expect_refused<IoError>(folder / "file" / "room.vtm", "Not a directory");
}

TEST(Replace, FolderOfTheIndexName) {
    const auto folder = fresh_folder();
    fs::create_directory(folder / "room.vtm");
    expect_refused<IoError>(folder / "room.vtm", "is a folder");
    EXPECT_EQ(files_below(folder).size(), 1u);
}

TEST(Replace, FileOfTheFolderName) {
    const auto folder = fresh_folder();
    touch(folder / "room");
    expect_refused<IoError>(folder / "room.vtm", "is in the way");
    EXPECT_EQ(files_below(folder).at("room"), "mine");
}

TEST(Replace, FolderWithFilesOfTheUsersOwnIsKept) {
    const auto folder = fresh_folder();
    fs::create_directory(folder / "room");
    touch(folder / "room" / "room.obj");
    expect_refused<IoError>(folder / "room.vtm", "holds 'room.obj'");
    EXPECT_EQ(files_below(folder).size(), 2u);
}

TEST(Replace, UnwritableFolder) {
    if (geteuid() == 0) GTEST_SKIP() << "nothing is unwritable for root";
    const auto folder = fresh_folder();
    fs::permissions(folder, fs::perms::owner_write, fs::perm_options::remove);
    expect_refused<IoError>(folder / "room.vtm", "Permission denied");
    fs::permissions(folder, fs::perms::owner_write, fs::perm_options::add);
}

TEST(Replace, OtherExtensionsAreRefused) {
    const auto folder = fresh_folder();
    for (const char* name : {"room.vtp", "room", ".vtm", "room.vtm.gz", "ro\nom.vtm"}) {
        expect_refused<UsageError>(folder / name, "NAME.vtm");
    }
    EXPECT_TRUE(fs::is_empty(folder));
}

TEST(Replace, RelativePathWithoutFolder) {
    const auto before = fs::current_path();
    fs::current_path(fresh_folder());
    save_solution(old_solution(), {}, "room.vtm");
    expect_equal(old_solution(), load_solution("room.vtm"));
    fs::current_path(before);
}

}  // namespace transillum::test
