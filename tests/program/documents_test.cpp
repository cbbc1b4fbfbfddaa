// What the program says of itself: help, manual pages, completion.
#include "program/program.h"

#include <gmock/gmock.h>

#include <sstream>
#include <vector>

namespace transillum {

namespace {

using testing::HasSubstr;
using testing::IsSupersetOf;

class Documents : public Program {
protected:
    [[nodiscard]] std::vector<std::string> subcommands() const {
        // Of the synopsis of subcommands: lines of the last part of the help.
        std::istringstream help(run("--help").out);
        std::vector<std::string> names;
        bool listed = false;
        for (std::string line; std::getline(help, line);) {
            if (listed && line.starts_with("  ") && line[2] != ' ')
                names.push_back(line.substr(2, line.find(' ', 2) - 2));
            listed = listed || line.starts_with("Subcommands:");
        }
        return names;
    }
    /// Words of bash for the last of these.
    [[nodiscard]] std::string complete(const std::string& words) const {
        const Outcome o = shell(
            "export TRANSILLUM; bash -c 'source <($TRANSILLUM completion bash); "
            "COMP_WORDS=(transillum " +
            words +
            "); COMP_CWORD=$((${#COMP_WORDS[@]} - 1)); _transillum; echo \"${COMPREPLY[*]}\"'");
        EXPECT_EQ(o.err, "");
        return o.out;
    }
};

TEST_F(Documents, ShowAnExampleOfEverySubcommand) {
    const auto names = subcommands();
    ASSERT_THAT(names, IsSupersetOf({"bake", "render", "export", "manual"}));
    for (const std::string& name : names) {
        const Outcome o = run(name + " --help");
        EXPECT_EQ(o.exit_code, 0);
        EXPECT_THAT(o.out, HasSubstr("transillum " + name + " ")) << "no example";
    }
}

TEST_F(Documents, AreManualPagesWithEveryOption) {
    ASSERT_EQ(run("manual man").exit_code, 0);
    for (const std::string& name : subcommands()) {
        const std::string page = read("man/transillum-" + name + ".1");
        EXPECT_TRUE(page.starts_with(".TH transillum\\-" + name + " 1 ")) << page;
        EXPECT_THAT(read("man/transillum.1"), HasSubstr("transillum\\-" + name));
    }
    const std::string bake = read("man/transillum-bake.1");
    for (const char* option : {"\\-\\-target\\-error", "\\-\\-light\\-samples", "auto|hemicube"})
        EXPECT_THAT(bake, HasSubstr(option));
    // groff warns of what it does not know.
    if (shell("command -v groff").exit_code != 0) GTEST_SKIP() << "no groff";
    for (const std::string& page : listing("man")) {
        const Outcome o = shell("groff -man -Tascii -ww -z man/" + page);
        EXPECT_EQ(o.err, "") << page;
    }
}

TEST_F(Documents, CompleteSubcommandsOptionsWordsAndFiles) {
    EXPECT_EQ(complete("exp"), "export\n");
    EXPECT_EQ(complete("bake --first-shot h"), "hemicube\n");
    EXPECT_EQ(complete("bake room.obj --light-s"), "--light-samples\n");
    EXPECT_EQ(complete("bake --progress ba"), "bar\n");
    EXPECT_EQ(complete("--progress ba"), "bar\n");
    EXPECT_EQ(complete("render --light-s"), "\n");
    EXPECT_EQ(complete("render --log-f"), "--log-file\n");
    write("room.vtm", "");
    EXPECT_EQ(complete("render roo"), "room.vtm\n");
    const Outcome fish = run("completion fish");
    EXPECT_THAT(fish.out, HasSubstr("__fish_seen_subcommand_from bake' -l light-samples -r -d"));
    EXPECT_EQ(run("completion tcsh").exit_code, 2);
}

}  // namespace

}  // namespace transillum
