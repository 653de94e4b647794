#include "runtime/report/page/frame_plots.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <limits>

#include "runtime/report/page/distribution.h"
#include "runtime/report/page/event_line.h"
#include "runtime/report/page/violations.h"
#include "runtime/report/row_names.h"
#include "runtime/time/span.h"

namespace gazeloop::report::page {
namespace {

constexpr std::int64_t kPeriod = 11'111'111;
constexpr std::int64_t kMs = 1'000'000;

time::Stamp measured(std::int64_t ns) { return {ns, time::StampKind::Measured}; }

frame::FrameRecord frame_of(std::uint64_t index, std::int64_t age_ns) {
    frame::FrameRecord record;
    record.index = index;
    record.period_ns = kPeriod;
    const std::int64_t wake_up = 5'000 * kMs + static_cast<std::int64_t>(index) * kPeriod;
    record.stamps.wake_up = measured(wake_up);
    record.stamps.latch = measured(wake_up + kMs);
    record.stamps.submit = measured(wake_up + 2 * kMs);
    record.stamps.gpu_end = measured(wake_up + 5 * kMs);
    record.stamps.end_frame = measured(wake_up + 6 * kMs);
    record.stamps.display = measured(wake_up + 20 * kMs);
    for (gaze::FoveaPoint& eye : record.fovea.eyes) {
        eye.state = gaze::FoveaState::Tracking;
        eye.sampled = measured(time::saturated(static_cast<__int128>(wake_up) + 20 * kMs - age_ns));
        eye.arrived = measured(wake_up);
    }
    return record;
}

/// As old as `age_of(frame)` says.
template <typename Age>
std::unique_ptr<FrameLog> log_of(std::uint64_t frames, const Age& age_of) {
    auto log = std::make_unique<FrameLog>(latency::SummaryConfig{.period_ns = kPeriod});
    for (std::uint64_t index = 0; index < frames; ++index) {
        log->on_frame(frame_of(index, age_of(index)));
    }
    log->finish();
    return log;
}

TEST(FramePlots, HoldEveryFrameWhereThereIsRoom) {
    const auto log = log_of(1000, [](std::uint64_t) { return 30 * kMs; });
    const FramePlots plots = frame_plots(*log, {}, {});
    EXPECT_EQ(plots.all.bins, 1000U);
    EXPECT_TRUE(plots.spans.empty());
    EXPECT_TRUE(plots.time_known);
    EXPECT_EQ(plots.end, 999 * kPeriod / 10'000);
}

TEST(FramePlots, StayWithinTheirRoomWhateverTheLength) {
    // The worst case: nothing to compress.
    std::uint64_t seed = 1;
    const auto log = log_of(20'000, [&seed](std::uint64_t) {
        seed = seed * 6'364'136'223'846'793'005U + 1'442'695'040'888'963'407U;
        return static_cast<std::int64_t>(seed >> 24U);  // up to 18 minutes
    });
    const PlotRoom room{.all = 40'000, .single = 8'000};
    const std::vector<std::size_t> worst = log->worst(10);
    const FramePlots plots = frame_plots(*log, {}, worst, room);
    EXPECT_LE(plots.all.data.size(), room.all);
    EXPECT_LE(plots.single.data.size(), room.single);
    EXPECT_LT(plots.all.bins, 20'000U);
    EXPECT_GT(plots.all.data.size(), room.all / 2);  // the room is used
    ASSERT_FALSE(plots.spans.empty());
    EXPECT_LE(plots.spans.front().first, plots.spans.front().end);
    EXPECT_TRUE(std::ranges::any_of(plots.spans, [&](const RowSpan& span) {
        return span.first <= worst.front() && worst.front() < span.end;
    }));
    for (std::size_t i = 1; i < plots.spans.size(); ++i) {
        EXPECT_GT(plots.spans[i].first, plots.spans[i - 1].end);
    }
}

TEST(FramePlots, StandForAnythingThatARecordingMayHold) {
    constexpr std::int64_t kMost = std::numeric_limits<std::int64_t>::max();
    FrameLog log(latency::SummaryConfig{.period_ns = kPeriod});
    frame::FrameRecord record = frame_of(std::numeric_limits<std::uint64_t>::max() - 1, 30 * kMs);
    record.stamps.wake_up = measured(-kMost);
    log.on_frame(record);
    record = frame_of(std::numeric_limits<std::uint64_t>::max(), -kMost);
    record.stamps.wake_up = measured(kMost);
    log.on_frame(record);
    log.finish();
    const FramePlots plots = frame_plots(log, {}, {});
    EXPECT_EQ(plots.all.bins, 2U);
    EXPECT_GE(plots.end, 0);
    const std::array<const DurationColumn*, 1> ages{&log.at(kGazeAgeAtDisplay.key)};
    EXPECT_EQ(distributions(ages).front().known, ages.front()->known());
}

TEST(FramePlots, SayThatNoTimeIsKnown) {
    FrameLog log(latency::SummaryConfig{});
    frame::FrameRecord record;
    log.on_frame(record);
    record.index = 1;
    log.on_frame(record);
    log.finish();
    const FramePlots plots = frame_plots(log, {}, {});
    EXPECT_FALSE(plots.time_known);
    EXPECT_EQ(plots.end, 1);
    EXPECT_EQ(first_wake_up_ns(log), std::nullopt);
}

TEST(FramePlots, AreEmptyWithoutFrames) {
    FrameLog log(latency::SummaryConfig{});
    log.finish();
    const FramePlots plots = frame_plots(log, {}, {});
    EXPECT_EQ(plots.rows, 0U);
    EXPECT_EQ(plots.all.bins, 0U);
}

TEST(Distribution, CountsEachFrameOnce) {
    const auto log = log_of(2000, [](std::uint64_t index) {
        return index == 7 ? 900 * kMs : static_cast<std::int64_t>(20 + index % 10) * kMs;
    });
    const std::array<const DurationColumn*, 1> ages{&log->at(kGazeAgeAtDisplay.key)};
    const Distribution one = distributions(ages).front();
    EXPECT_EQ(one.above, 1U);  // the one that lies far off does not flatten the others
    EXPECT_EQ(one.first, 20 * kMs);
    EXPECT_EQ(one.known, 2000U);
    std::uint64_t sum = one.above;
    for (const std::uint64_t frames : one.frames) {
        sum += frames;
    }
    EXPECT_EQ(sum, 2000U);
    EXPECT_LE(one.frames.size(), 61U);
}

TEST(Distribution, IsEmptyWhereNothingIsKnown) {
    FrameLog log(latency::SummaryConfig{});
    log.finish();
    const std::array<const DurationColumn*, 1> ages{&log.at(kGazeAgeAtDisplay.key)};
    EXPECT_TRUE(distributions(ages).front().frames.empty());
}

TEST(Violations, FindRunsAndTheirWorstFrame) {
    const auto log = log_of(100, [](std::uint64_t index) {
        return index >= 10 && index < 14 ? (40 + static_cast<std::int64_t>(index)) * kMs
               : index == 50             ? 41 * kMs
                                         : 30 * kMs;
    });
    const latency::LatencyBudget budget{
        .name = "b", .description = {}, .source = {}, .total_ns = 40 * kMs};
    const std::vector<Violations> all = violations(*log, &budget, 10);
    ASSERT_EQ(all.size(), 2U);
    EXPECT_EQ(all[0].frames, 0U);  // none was shown late
    EXPECT_EQ(all[0].known, 100U);
    const Violations& age = all[1];
    EXPECT_EQ(age.known, 100U);
    EXPECT_EQ(age.frames, 5U);
    EXPECT_EQ(age.all_runs, 2U);
    EXPECT_EQ(age.runs.front().first, 10U);
    EXPECT_EQ(age.runs.front().last, 13U);
    EXPECT_EQ(age.runs.front().frames, 4U);
    EXPECT_EQ(age.runs.front().worst, 53 * kMs);
    EXPECT_EQ(age.runs.front().worst_row, 13U);
    EXPECT_EQ(violations(*log, &budget, 1)[1].runs.size(), 1U);
    EXPECT_EQ(violations(*log, nullptr, 10).size(), 1U);
}

TEST(EventLine, KeepsEveryTimeAndTheFirstTexts) {
    EventLine events;
    for (int i = 0; i < 150; ++i) {
        events.on_event(measured(i), "gaze", "held");
    }
    events.on_event({}, "gaze", "at an unknown time");
    events.on_event({}, "long", std::string(10'000, 'x'));
    for (int i = 0; i < 100; ++i) {
        events.on_event(measured(i), "kind-" + std::to_string(i), "");
    }
    const EventLine::Kind& gaze = events.kinds().front();
    EXPECT_EQ(gaze.times, 151U);
    EXPECT_EQ(gaze.ns.size(), 150U);
    EXPECT_EQ(gaze.texts.size(), EventLine::kMostTexts);
    EXPECT_EQ(events.kinds().size(), EventLine::kMostKinds);
    EXPECT_EQ(events.others(), 38U);
    EXPECT_LT(events.kinds()[1].texts.front().text.size(), 600U);
}

}  // namespace
}  // namespace gazeloop::report::page
