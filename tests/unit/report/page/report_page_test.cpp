#include "runtime/report/page/report_page.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <memory>
#include <string>

#include "runtime/report/page/report_sections.h"

namespace gazeloop::report::page {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

time::Stamp measured(std::int64_t ns) { return {ns, time::StampKind::Measured}; }

/// Frames whose every stamp is noise: the least that can be compressed.
SessionSummary noisy_session(std::uint64_t frames) {
    auto log = std::make_unique<FrameLog>(latency::SummaryConfig{.period_ns = 11'111'111});
    std::uint64_t seed = 7;
    const auto noise = [&seed](unsigned bits) {
        seed = seed * 6'364'136'223'846'793'005U + 1'442'695'040'888'963'407U;
        return static_cast<std::int64_t>(seed >> (64U - bits));
    };
    constexpr unsigned kAge = 26;  // up to 67 ms
    constexpr unsigned kStage = 23;
    for (std::uint64_t index = 0; index < frames; ++index) {
        frame::FrameRecord record;
        record.index = index;
        const std::int64_t begin = static_cast<std::int64_t>(index) * 11'111'111 + noise(kStage);
        record.stamps = {.wake_up = measured(begin),
                         .begin = {},
                         .latch = measured(begin + noise(kStage)),
                         .filtered = measured(begin + noise(kStage)),
                         .submit = measured(begin + noise(kStage)),
                         .end_frame = measured(begin + noise(kStage)),
                         .gpu_begin = measured(begin + noise(kStage)),
                         .gpu_end = measured(begin + noise(kStage)),
                         .present = {},
                         .display = measured(begin + noise(kAge)),
                         .shown = {}};
        for (gaze::FoveaPoint& eye : record.fovea.eyes) {
            eye.state = gaze::FoveaState::Tracking;
            eye.sampled = measured(begin - noise(kAge));
            eye.ready = measured(begin - noise(kStage));
            eye.arrived = measured(begin - noise(kStage));
            eye.uncertainty_ns = noise(kStage);
        }
        log->on_frame(record);
    }
    log->finish();
    return {.report = {}, .frames = std::move(log), .trace = {}, .end = {}};
}

std::string page_of(const SessionSummary& session, const latency::LatencyBudget* budget,
                    std::vector<PageSection> sections = {}) {
    const session::SessionInfo info;
    const EventLine events;
    const Percentiles percentiles;
    return report_page({.session = session,
                        .info = info,
                        .events = events,
                        .percentiles = percentiles,
                        .file = "a<b>\"&'.gaze",
                        .budget = budget,
                        .why = {"Because of <the> tracker."},
                        .sections = std::move(sections)});
}

TEST(ReportPage, ShowsTextsOfOthersAsTheyAre) {
    const SessionSummary session = noisy_session(3);
    const std::string page = page_of(session, nullptr,
                                     {{.id = "prediction",
                                       .title = "Prediction {{file}} <i>",
                                       .paragraphs = {"5 < 6 & \xff\xfe"},
                                       .heads = {"part", "least, ms"},
                                       .rows = {{"</script>", "23.00"}, {}},
                                       .lines = "a  <b>\n  c"}});
    EXPECT_THAT(page, HasSubstr("a&lt;b&gt;&quot;&amp;&apos;.gaze"));
    EXPECT_THAT(page, HasSubstr("Because of &lt;the&gt; tracker."));
    EXPECT_THAT(page, HasSubstr("Prediction {{file}} &lt;i&gt;"));
    EXPECT_THAT(page, HasSubstr("5 &lt; 6 &amp; \xff\xfe"));
    EXPECT_THAT(page, HasSubstr("&lt;/script&gt;"));
    EXPECT_THAT(page, HasSubstr("<td>23.00</td>"));
    EXPECT_THAT(page, HasSubstr("<pre>a  &lt;b&gt;\n  c</pre>"));
    EXPECT_THAT(page, Not(HasSubstr("a<b>")));
}

TEST(ReportPage, HasAPlaceForThePredictionAndForWhatATerminalShows) {
    PredictionTable prediction;
    prediction.rows = {{"gaze age at display", {"23.00", ">=40.00", "-", "-", "-", "-", "-"}}};
    prediction.notes = {"Outside: p99."};
    const PageSection section = section_of(prediction);
    EXPECT_EQ(section.paragraphs, prediction.notes);
    EXPECT_EQ(section.heads.size(), 1 + PredictionTable::kHeads.size());
    ASSERT_EQ(section.rows.size(), 1U);
    EXPECT_EQ(section.rows[0], (std::vector<std::string>{"gaze age at display", "23.00", ">=40.00",
                                                         "-", "-", "-", "-", "-"}));
    EXPECT_EQ(section_of_lines("probe", "Probe", "\n\n a\n b\n").lines, " a\n b");
    EXPECT_EQ(section_of_lines("probe", "Probe", "\n").lines, "");
    EXPECT_EQ(section_of_lines("probe", "Probe", "").lines, "");
}

TEST(ReportPage, FlagsWhatIsBelow0) {
    const std::string page = page_of(noisy_session(50), nullptr);
    EXPECT_THAT(page, HasSubstr("Below 0: submit in "));
    EXPECT_THAT(page, Not(HasSubstr("Below 0: scan to row")));
}

TEST(ReportPage, SaysWhetherABudgetIsInForce) {
    const SessionSummary session = noisy_session(50);
    const latency::LatencyBudget budget{
        .name = "of a test", .description = {}, .source = {}, .total_ns = 40'000'000};
    EXPECT_THAT(page_of(session, nullptr), HasSubstr("No budget is in force."));
    const std::string page = page_of(session, &budget);
    EXPECT_THAT(page, HasSubstr("each limit of the budget of a test"));
    EXPECT_THAT(page, HasSubstr("<td>40.00 ms</td>"));
}

TEST(ReportPage, StaysBelow5MegabytesWhateverItHolds) {
    for (const std::uint64_t frames : {60'000U, 250'000U}) {
        EXPECT_LT(page_of(noisy_session(frames), nullptr).size(), 5'000'000U) << frames;
    }
}

}  // namespace
}  // namespace gazeloop::report::page
