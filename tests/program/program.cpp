#include "program/program.h"

#include <sys/wait.h>

#include <cstdlib>
#include <fstream>
#include <sstream>

namespace transillum {

namespace fs = std::filesystem;

Program::Program() {
    std::string name = testing::TempDir() + "transillum_XXXXXX";
    folder_ = mkdtemp(name.data());
    fs::create_directory(folder_ / "out");
}

Program::~Program() {
    fs::remove_all(folder_);
}

Outcome Program::shell(const std::string& line) const {
    const std::string command = "cd '" + folder_.string() +
                                "' && TRANSILLUM='" TRANSILLUM_PROGRAM "' && { " + line +
                                "; } >stdout 2>stderr </dev/null";
    const int status = std::system(command.c_str());
    return {WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status), read("stdout"),
            read("stderr")};
}

Outcome Program::run(const std::string& arguments) const {
    return shell("\"$TRANSILLUM\" " + arguments);
}

void Program::write(const std::string& name, const std::string& bytes) const {
    std::ofstream(folder_ / name, std::ios::binary) << bytes;
}

std::string Program::read(const std::string& name) const {
    std::ostringstream bytes;
    bytes << std::ifstream(folder_ / name, std::ios::binary).rdbuf();
    return bytes.str();
}

std::set<std::string> Program::listing(const std::string& folder) const {
    std::set<std::string> names;
    for (const auto& entry : fs::directory_iterator(folder_ / folder))
        names.insert(entry.path().filename().string());
    return names;
}

void Program::write_room(const std::string& albedo, const std::string& emission,
                         const std::string& wall_lines) const {
    const auto three = [](const std::string& value) {
        return " " + value + " " + value + " " + value + "\n";
    };
    write("room.mtl", "newmtl wall\nKd" + three(albedo) + wall_lines + "newmtl lamp\nKd" +
                          three(albedo) + "Ke" + three(emission));
    write("room.obj",
          "mtllib room.mtl\n"
          "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\n"
          "usemtl wall\nf 1 5 6 2\nf 1 2 3 4\nf 5 8 7 6\nf 1 4 8 5\nf 2 6 7 3\n"
          "usemtl lamp\nf 4 3 7 8\n");
}

void Program::bake_room(const std::string& name, const std::string& options) const {
    const Outcome o = run("-q bake room.obj -o " + name +
                          " --leaves 100 --iterations 16 --resolution 64 " + options);
    ASSERT_EQ(o.exit_code, 0) << o.err;
}

}  // namespace transillum
