// What is told of the work: progress, messages, the log.
#include "program/program.h"

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include <sstream>

namespace transillum {

namespace {

using testing::HasSubstr;
using testing::Not;

class Messages : public Program {
protected:
    Outcome bake(const std::string& options) const {
        write_room("0.5", "1");
        return run("bake room.obj -o room.vtm --leaves 200 --iterations 128 --resolution 64 " +
                   options);
    }
};

TEST_F(Messages, AsJsonAreAnObjectALine) {
    const Outcome o = bake("--progress json");
    ASSERT_EQ(o.exit_code, 0) << o.err;
    std::istringstream lines(o.err);
    int notes = 0;
    nlohmann::json last;
    for (std::string line; std::getline(lines, line);) {
        const auto json = nlohmann::json::parse(line);
        notes += json.at("event") == "note" ? 1 : 0;
        if (json.at("event") == "progress") last = json;
    }
    EXPECT_GT(notes, 0);
    EXPECT_EQ(last.at("phase"), "transport");
    EXPECT_EQ(last.at("done"), 128);
    EXPECT_EQ(last.at("percent"), 100);
    EXPECT_GT(last.at("error").get<double>(), 0.0);
    const Outcome failed = run("--progress json bake none.obj -o none.vtm");
    EXPECT_EQ(failed.exit_code, 4);
    EXPECT_EQ(nlohmann::json::parse(failed.err).at("event"), "error");
    const Outcome quiet = bake("--progress json --quiet --again");
    EXPECT_THAT(quiet.err, HasSubstr("\"percent\":100"));
    EXPECT_THAT(quiet.err, Not(HasSubstr("\"note\"")));
}

TEST_F(Messages, AreLinesWhereThereIsNoTerminal) {
    const Outcome o = bake("");
    EXPECT_THAT(o.err, HasSubstr("transport   128 of 128  100 %"));
    EXPECT_THAT(o.err, Not(HasSubstr("\r")));
    EXPECT_THAT(o.err, Not(HasSubstr(" s in all")));
    EXPECT_THAT(bake("--verbose --again").err,
                testing::AllOf(HasSubstr("\ntransport: "), HasSubstr(" s in all")));
    EXPECT_EQ(bake("--quiet --again").err, "");
    EXPECT_THAT(bake("--progress none --again").err, Not(HasSubstr("128 of 128")));
    EXPECT_THAT(bake("--progress bar --again").err, HasSubstr("=]  128 of 128  100 %"));
}

TEST_F(Messages, SayThatACameraSeesNothing) {
    ASSERT_EQ(bake("").exit_code, 0);
    const std::string look = "render room.vtm -o room.png --size 8x8 --eye 0,0,100 --look-at ";
    const Outcome away = run(look + "0,0,200");
    EXPECT_EQ(away.exit_code, 0);
    EXPECT_THAT(away.err, HasSubstr("the picture is black: from eye 0,0,100"));
    EXPECT_FALSE(read("room.png").empty());
}

TEST_F(Messages, AreKeptInTheLogWhateverIsShown) {
    ASSERT_EQ(bake("--quiet --log-file bake.log").exit_code, 0);
    const std::string log = read("bake.log");
    for (const char* part : {"bake room.obj", "note ", "transport   128 of 128", "in all"})
        EXPECT_THAT(log, HasSubstr(part));
    // What fails is in it, too, after what was there.
    EXPECT_EQ(run("render none.vtm -o a.png --log-file bake.log").exit_code, 4);
    EXPECT_TRUE(read("bake.log").starts_with(log));
    EXPECT_THAT(read("bake.log"), HasSubstr("none.vtm"));
    EXPECT_EQ(run("info none.vtm --log-file info.log").exit_code, 4);
    EXPECT_THAT(read("info.log"), testing::AllOf(HasSubstr("command "), HasSubstr("error ")));
    const Outcome nowhere = bake("--log-file missing.dir/../room.obj/bake.log");
    EXPECT_EQ(nowhere.exit_code, 4);
    EXPECT_THAT(nowhere.err, HasSubstr("bake.log"));
}

}  // namespace

}  // namespace transillum
