#include <transillum/base/error.h>
#include <transillum/base/staged_files.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <fstream>
#include <system_error>
#include <utility>

namespace transillum {

namespace fs = std::filesystem;

namespace {

[[noreturn]] void fail(const fs::path& path, const std::string& what, int error) {
    throw IoError(path.string(), what + ": " + std::generic_category().message(error));
}

fs::path folder_of(const fs::path& path) {
    return path.has_parent_path() ? path.parent_path() : fs::path(".");
}

/// What was in a file's place, until all are in theirs.
struct Replaced {
    fs::path place, kept;
    bool existed = false;
};

void undo(const std::vector<Replaced>& replaced) {
    std::error_code ignored;
    for (const Replaced& r : replaced) {
        if (r.existed) {
            fs::rename(r.kept, r.place, ignored);
        } else {
            fs::remove(r.place, ignored);
        }
    }
}

}  // namespace

TemporaryFolder::TemporaryFolder(const fs::path& path) {
    std::string pattern = (folder_of(path) / ".transillum.XXXXXX").string();
    if (mkdtemp(pattern.data()) == nullptr) fail(path, "cannot write into its folder", errno);
    folder_ = pattern;
}

TemporaryFolder::~TemporaryFolder() {
    std::error_code ignored;
    fs::remove_all(folder_, ignored);
}

void write_bytes(std::string_view bytes, const fs::path& file, const fs::path& target) {
    errno = 0;
    std::ofstream out(file, std::ios::binary);
    out.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    out.close();
    if (!out) fail(target, "cannot write", errno);
}

StagedFiles::StagedFiles(fs::path main) : main_(std::move(main)), folder_(main_) {}

fs::path StagedFiles::stage(const std::string& name) {
    names_.push_back(name);
    return folder_ / name;
}

void StagedFiles::write(const std::string& name, std::string_view bytes) {
    write_bytes(bytes, stage(name), folder_of(main_) / name);
}

void StagedFiles::write_main(std::string_view bytes) {
    write(main_.filename().string(), bytes);
}

void StagedFiles::put_in_place() {
    const std::string main = main_.filename().string();
    std::stable_partition(names_.begin(), names_.end(),
                          [&](const std::string& name) { return name != main; });
    std::vector<Replaced> replaced;
    for (const std::string& name : names_) {
        const fs::path place = folder_of(main_) / name;
        std::error_code error;
        Replaced r{place, folder_ / ("old." + name), fs::exists(fs::symlink_status(place, error))};
        error.clear();
        if (fs::is_directory(place)) error = std::make_error_code(std::errc::is_a_directory);
        if (!error && r.existed) fs::rename(place, r.kept, error);
        const bool moved = !error;
        if (!error) fs::rename(folder_ / name, place, error);
        if (!error) {
            replaced.push_back(std::move(r));
            continue;
        }
        std::error_code ignored;
        if (moved && r.existed) fs::rename(r.kept, place, ignored);
        undo(replaced);
        fail(place, "cannot be put in place", error.value());
    }
    names_.clear();
}

}  // namespace transillum
