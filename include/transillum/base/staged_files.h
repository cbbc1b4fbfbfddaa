/// Files that come to their places all together, or not at all.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace transillum {

/// A fresh folder beside a path, removed with all that is left in it.
class TemporaryFolder {
public:
    /// \throws IoError naming `path` where its folder cannot be written to.
    explicit TemporaryFolder(const std::filesystem::path& path);
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;
    ~TemporaryFolder();
    [[nodiscard]] std::filesystem::path operator/(const std::filesystem::path& name) const {
        return folder_ / name;
    }

private:
    std::filesystem::path folder_;
};

/// Writes a whole file. \throws IoError naming `target`, what the file is going to be.
void write_bytes(std::string_view bytes, const std::filesystem::path& file,
                 const std::filesystem::path& target);

/// A main file and others beside it. They are written elsewhere first, so that nothing that is half
/// written is ever in place, and nothing is left where it fails.
class StagedFiles {
public:
    /// \throws IoError where the folder of `main` cannot be written to or `main` is a folder.
    explicit StagedFiles(std::filesystem::path main);

    /// Where to write what will be the file of that name beside the main one.
    [[nodiscard]] std::filesystem::path stage(const std::string& name);
    void write(const std::string& name, std::string_view bytes);
    void write_main(std::string_view bytes);
    [[nodiscard]] const std::filesystem::path& main() const { return main_; }

    /// Replaces what was in their places, the main file last.
    /// \throws IoError, and everything is as it was before.
    void put_in_place();

private:
    std::filesystem::path main_;
    TemporaryFolder folder_;
    std::vector<std::string> names_;
};

}  // namespace transillum
