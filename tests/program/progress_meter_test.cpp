#include "cli/progress_meter.h"

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

namespace transillum::cli {

namespace {

using testing::HasSubstr;
using testing::Not;

Progress transport(std::uint64_t done) {
    Progress p;
    p.phase = "transport";
    p.done = done;
    p.total = 200;
    return p;
}

TEST(ProgressMeter, RoundsPercentDown) {
    ProgressMeter meter;
    EXPECT_EQ(meter.read(transport(1), 0.0).percent(), 0);
    EXPECT_EQ(meter.read(transport(199), 1.0).percent(), 99);
    EXPECT_FALSE(meter.read(transport(199), 1.0).ends);
    EXPECT_EQ(meter.read(transport(200), 1.0).percent(), 100);
    EXPECT_TRUE(meter.read(transport(200), 1.0).ends);
}

// Of work that takes equally long at each step, the rest is known exactly after two of them; also
// where a run goes on from an earlier one, whose time it doesn't know.
TEST(ProgressMeter, TellsTheTimeThatIsLeft) {
    for (const std::uint64_t before : {0u, 100u}) {
        ProgressMeter meter;
        EXPECT_FALSE(meter.read(transport(before + 1), 7.0).remaining);
        for (const std::uint64_t done : {2u, 40u, 99u}) {
            const ProgressReading r =
                meter.read(transport(before + done), 7.0 + 0.5 * (static_cast<double>(done) - 1));
            ASSERT_TRUE(r.remaining);
            EXPECT_NEAR(*r.remaining, 0.5 * static_cast<double>(200 - before - done), 1e-9);
        }
    }
}

TEST(ProgressMeter, BeginsAnewWithAPhase) {
    ProgressMeter meter;
    (void)meter.read(transport(50), 3.0);
    Progress render;
    render.phase = "render";
    render.done = 1;
    const ProgressReading r = meter.read(render, 10.0);
    EXPECT_EQ(r.elapsed, 0.0);
    EXPECT_FALSE(r.remaining);
    EXPECT_EQ(plain_line(r), "render      1  elapsed 0:00");
}

TEST(ProgressMeter, FitsItsBarIntoTheLine) {
    ProgressMeter meter;
    (void)meter.read(transport(1), 0.0);
    const ProgressReading r = meter.read(transport(100), 9.9);
    EXPECT_EQ(plain_line(r), "transport   100 of 200  50 %  elapsed 0:10  remaining 0:10");
    EXPECT_THAT(bar_line(r, 120), HasSubstr("[============            ]  100 of 200"));
    EXPECT_THAT(bar_line(r, 60), Not(HasSubstr("[")));
    for (int width = 1; width < 130; ++width)
        EXPECT_LE(bar_line(r, width).size(), static_cast<std::size_t>(width));
}

TEST(ProgressMeter, LeavesOutOfJsonWhatIsNotKnown) {
    ProgressMeter meter;
    Progress p = transport(1);
    p.may_end_sooner = true;
    auto json = nlohmann::json::parse(json_line(meter.read(p, 0.0)));
    EXPECT_EQ(json["percent"], 0);
    EXPECT_EQ(json["may_end_sooner"], true);
    EXPECT_FALSE(json.contains("remaining") || json.contains("error"));
    EXPECT_EQ(json_message("note", "a \"b\"\xff"),
              "{\"event\":\"note\",\"message\":\"a \\\"b\\\"\xef\xbf\xbd\"}");
}

TEST(Duration, IsWrittenAsClocksDo) {
    EXPECT_EQ(format_duration(0.4), "0:00");
    EXPECT_EQ(format_duration(65.0), "1:05");
    EXPECT_EQ(format_duration(3600.0), "1:00:00");
}

}  // namespace

}  // namespace transillum::cli
