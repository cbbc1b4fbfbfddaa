/// Runs the program as a user does, in a fresh folder that is removed afterwards.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <set>
#include <string>

namespace transillum {

struct Outcome {
    int exit_code;  ///< 128 + number where a signal ended it
    std::string out, err;
};

class Program : public testing::Test {
protected:
    Program();
    ~Program() override;

    /// `arguments` as typed into a shell.
    Outcome run(const std::string& arguments) const;
    /// A line of shell, in the folder; the program is $TRANSILLUM.
    Outcome shell(const std::string& line) const;

    void write(const std::string& name, const std::string& bytes) const;
    [[nodiscard]] std::string read(const std::string& name) const;
    /// Names in a folder, hidden ones too.
    [[nodiscard]] std::set<std::string> listing(const std::string& folder) const;

    /// A closed white unit cube whose ceiling emits: room.obj, room.mtl.
    /// \param wall_lines more statements of the walls' material.
    void write_room(const std::string& albedo, const std::string& emission,
                    const std::string& wall_lines = {}) const;
    /// A coarse solution of that room.
    void bake_room(const std::string& name, const std::string& options = {}) const;

    std::filesystem::path folder_;
};

}  // namespace transillum
