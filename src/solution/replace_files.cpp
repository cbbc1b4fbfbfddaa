#include "replace_files.h"

#include <transillum/base/error.h>
#include <transillum/base/staged_files.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <fstream>
#include <string_view>
#include <system_error>

namespace transillum {

namespace fs = std::filesystem;

namespace {

constexpr std::array<std::string_view, 7> known_files{
    "radiance.vtp", "incoming.vtp", "lights.vtp", "environment.vtp",
    "surface.vtp",  "sums.vtp",     "run.json"};

bool is_known(std::string_view name) {
    return std::find(known_files.begin(), known_files.end(), name) != known_files.end() ||
           (name.starts_with("texture-") && name.ends_with(".vti")) ||
           (name.starts_with("emitter-") && name.ends_with(".vtp")) ||
           (name.starts_with("bands-") && name.ends_with(".vtp"));
}

[[noreturn]] void fail(const fs::path& path, const std::string& what, int error) {
    throw IoError(path.string(), what + ": " + std::generic_category().message(error));
}

/// A folder of the user's own must never be swept away with a solution.
void check_in_the_way(const fs::path& index, const fs::path& folder) {
    if (fs::is_directory(index)) throw IoError(index.string(), "is a folder, not a file");
    const fs::file_status status = fs::status(folder);
    if (!fs::exists(status)) return;
    if (!fs::is_directory(status)) {
        throw IoError(folder.string(), "is in the way: the solution needs a folder of that name");
    }
    for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
        const std::string name = entry.path().filename().string();
        if (!is_known(name)) {
            throw IoError(folder.string(), "holds '" + name +
                                               "', which is no part of a solution; choose another "
                                               "name or another place");
        }
    }
}

void move_to(const fs::path& from, const fs::path& to) {
    std::error_code error;
    fs::rename(from, to, error);
    if (error) fail(to, "cannot be put in place", error.value());
}

/// The three renames; each step undoes those before it when it fails.
void swap_in(const TemporaryFolder& temporary, const fs::path& index, const fs::path& folder) {
    std::error_code ignored;
    const bool replaces = fs::exists(fs::symlink_status(folder));
    if (replaces) move_to(folder, temporary / "old");
    try {
        move_to(temporary / "new", folder);
        try {
            move_to(temporary / "index", index);
        } catch (...) {
            fs::rename(folder, temporary / "new", ignored);
            throw;
        }
    } catch (...) {
        if (replaces) fs::rename(temporary / "old", folder, ignored);
        throw;
    }
}

}  // namespace

void replace_files(const SolutionFiles& files, const fs::path& path) try {
    const fs::path folder = fs::path(path).replace_extension();
    check_in_the_way(path, folder);
    const TemporaryFolder temporary(path);
    fs::create_directory(temporary / "new");
    for (const auto& [name, bytes] : files.pieces) {
        write_bytes(bytes, temporary / "new" / name, folder / name);
    }
    write_bytes(files.index, temporary / "index", path);
    swap_in(temporary, path, folder);
} catch (const fs::filesystem_error& error) {
    fail(path, "cannot write", error.code().value());
}

std::string read_bytes(const fs::path& path) {
    if (fs::is_directory(path)) fail(path, "cannot be read", EISDIR);
    errno = 0;
    std::ifstream in(path, std::ios::binary);
    std::string bytes;
    if (in) {
        std::error_code unknown;
        const auto size = fs::file_size(path, unknown);
        if (!unknown) bytes.resize(size);
        in.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
        bytes.resize(static_cast<std::size_t>(in.gcount()));
        in.clear(in.rdstate() & ~(std::ios::failbit | std::ios::eofbit));
    }
    if (!in) fail(path, "cannot be read", errno != 0 ? errno : EIO);
    return bytes;
}

}  // namespace transillum
