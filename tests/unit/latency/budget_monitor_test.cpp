#include "runtime/latency/budget_monitor.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <deque>
#include <limits>
#include <random>
#include <vector>

#include "tests/support/allocation_counter.h"
#include "tests/unit/latency/example_frame.h"

namespace gazeloop::latency {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

constexpr std::int64_t kSecond = 1'000'000'000;
constexpr std::size_t kGpuPart = kFirstStagePart + static_cast<std::size_t>(Stage::Gpu);

LatencyBudget budget_of(std::int64_t total_ms) {
    return {.name = "test", .description = {}, .source = {}, .total_ns = total_ms * kMs};
}

/// A frame of a 100 Hz loop whose gaze is so old at the display, all of it in the wait.
FrameAccount frame_of_age(std::uint64_t index, std::optional<std::int64_t> age_ns,
                          gaze::FoveaState state = gaze::FoveaState::Tracking) {
    FrameAccount account;
    account.stamps = example_frame(index).stamps;
    account.state = state;
    if (age_ns) {
        account.age.at_display = {*age_ns, time::StampKind::Predicted};
        account.age.stages[static_cast<std::size_t>(Stage::Wait)] = account.age.at_display;
        account.age.unaccounted = {0, time::StampKind::Predicted};
    }
    return account;
}

/// A monitor with the events that it has told.
struct Watched {
    Watched(const std::optional<LatencyBudget>& budget, std::int64_t window_ns)
        : monitor(budget, window_ns) {}

    void add(std::optional<std::int64_t> age_ms,
             gaze::FoveaState state = gaze::FoveaState::Tracking) {
        add_ns(age_ms ? std::optional(*age_ms * kMs) : std::nullopt, state);
    }
    void add_ns(std::optional<std::int64_t> age_ns,
                gaze::FoveaState state = gaze::FoveaState::Tracking) {
        add(frame_of_age(next, age_ns, state));
    }
    void add(const FrameAccount& account) {
        monitor.add(account, next, kExamplePeriodNs, [this](const BudgetEvent& event) {
            events.push_back(event);
            frames.push_back(next);
        });
        ++next;
    }
    [[nodiscard]] MonitorPart age() const { return monitor.snapshot().parts[kAgePart]; }

    BudgetMonitor monitor;
    std::uint64_t next = 0;
    std::vector<BudgetEvent> events;
    std::vector<std::uint64_t> frames;  ///< at which
};

TEST(BudgetMonitor, KnowsNothingBeforeTheFirstFrame) {
    const BudgetMonitor monitor(budget_of(10), kSecond);
    const MonitorSnapshot snapshot = monitor.snapshot();
    EXPECT_EQ(snapshot.frames, 0U);
    EXPECT_EQ(snapshot.window_frames, 0U);
    EXPECT_EQ(snapshot.window_ns, 0);
    EXPECT_FALSE(snapshot.time.known());
    EXPECT_EQ(snapshot.share_by_kind_percent, std::nullopt);
    EXPECT_EQ(snapshot.parts[kAgePart].p50_ns, std::nullopt);
    EXPECT_EQ(snapshot.parts[kAgePart].limit_ns, 10 * kMs);
    EXPECT_EQ(snapshot.parts[kGpuPart].limit_ns, std::nullopt);
}

TEST(BudgetMonitor, KeepsAFixedStreamWithinItsLimit) {
    Watched watched(budget_of(16), kSecond);
    for (int i = 0; i < 500; ++i) {
        watched.add(16);
    }
    const MonitorPart age = watched.age();
    EXPECT_EQ(age.p50_ns, 16 * kMs);
    EXPECT_EQ(age.p95_ns, 16 * kMs);
    EXPECT_EQ(age.p99_ns, 16 * kMs);
    EXPECT_EQ(age.known, 101U) << "one second of 100 Hz, both ends";
    EXPECT_EQ(age.all_known, 500U);
    EXPECT_EQ(age.violations, 0U) << "a limit that is met is kept";
    EXPECT_TRUE(watched.events.empty());
    const MonitorSnapshot snapshot = watched.monitor.snapshot();
    EXPECT_EQ(snapshot.window_ns, kSecond);
    EXPECT_EQ(snapshot.frame, 499U);
    EXPECT_FALSE(snapshot.window_cut);
}

TEST(BudgetMonitor, BreaksAtOnceWhereAllFramesAreAbove) {
    Watched watched(budget_of(15), kSecond);
    for (int i = 0; i < 500; ++i) {
        watched.add(16);
    }
    ASSERT_EQ(watched.events.size(), 1U);
    EXPECT_EQ(watched.frames[0], BudgetMonitor::kFewest - 1) << "as soon as there is a percentile";
    EXPECT_TRUE(watched.events[0].broken);
    EXPECT_EQ(watched.events[0].p95_ns, 16 * kMs);
    EXPECT_EQ(watched.events[0].limit_ns, 15 * kMs);
    EXPECT_EQ(watched.events[0].part, kAgePart);
    EXPECT_EQ(watched.events[0].time, example_frame(19).stamps.end_frame);
    const MonitorPart age = watched.age();
    EXPECT_TRUE(age.broken);
    EXPECT_EQ(age.violations, 500U);
    EXPECT_EQ(age.longest_run_frames, 500U);
    EXPECT_EQ(age.longest_run_ns, 500 * kExamplePeriodNs);
}

TEST(BudgetMonitor, BreaksWhereADriftingStreamHasSixFramesOfAHundredAbove) {
    // .1 ms more with each frame: frame 101 is the first above 20 ms.
    Watched watched(budget_of(20), kSecond);
    for (std::int64_t i = 0; i < 300; ++i) {
        watched.add_ns(10 * kMs + i * kMs / 10);
    }
    ASSERT_EQ(watched.frames.size(), 1U);
    // Of 101 frames, the percentile is the 96th, so the sixth one above moves it there.
    EXPECT_EQ(watched.frames[0], 106U);
    EXPECT_EQ(watched.events[0].p95_ns, 20 * kMs + kMs / 10);
    EXPECT_EQ(watched.age().violations, 199U);
}

TEST(BudgetMonitor, RecoversOnceAWholeWindowIsWithin) {
    Watched watched(budget_of(20), kSecond);
    for (int i = 0; i < 200; ++i) {
        watched.add(30);
    }
    for (int i = 0; i < 400; ++i) {
        watched.add(10);
    }
    ASSERT_EQ(watched.events.size(), 2U);
    EXPECT_FALSE(watched.events[1].broken);
    // The percentile is within from the 96th good frame on (index 295), and for a second from then.
    EXPECT_EQ(watched.frames[1], 395U);
    EXPECT_EQ(watched.events[1].lasted_ns, (395 - 19) * kExamplePeriodNs);
    EXPECT_FALSE(watched.age().broken);
}

TEST(BudgetMonitor, DoesNotChatterAtTheLimit) {
    Watched watched(budget_of(20), kSecond);
    // Above and below by turns: the percentile is above all the time.
    for (int i = 0; i < 1000; ++i) {
        watched.add(i % 2 == 0 ? 19 : 21);
    }
    EXPECT_EQ(watched.events.size(), 1U);
    EXPECT_EQ(watched.age().violations, 500U);
    EXPECT_EQ(watched.age().longest_run_frames, 1U);
    EXPECT_EQ(watched.age().longest_run_ns, kExamplePeriodNs);
    // Six late frames each 1.5 s: the percentile goes above and comes back each time.
    for (int i = 0; i < 3000; ++i) {
        watched.add(i % 150 < 6 ? 21 : 19);
    }
    EXPECT_EQ(watched.events.size(), 1U) << "never within for a whole second";
}

TEST(BudgetMonitor, CountsUnknownAgesApart) {
    Watched watched(budget_of(20), kSecond);
    for (int i = 0; i < 300; ++i) {
        watched.add(std::nullopt);
    }
    EXPECT_TRUE(watched.events.empty());
    MonitorPart age = watched.age();
    EXPECT_EQ(age.all_known, 0U);
    EXPECT_EQ(age.all_unknown, 300U);
    EXPECT_EQ(age.unknown, 101U);
    EXPECT_EQ(age.p50_ns, std::nullopt);
    EXPECT_EQ(watched.monitor.snapshot().share_by_kind_percent, std::nullopt);

    // Once broken, frames that know nothing do not make it kept.
    for (int i = 0; i < 100; ++i) {
        watched.add(30);
    }
    for (int i = 0; i < 1000; ++i) {
        watched.add(std::nullopt);
    }
    ASSERT_EQ(watched.events.size(), 1U);
    EXPECT_TRUE(watched.age().broken);
    // And neither end a run nor count in it.
    watched.add(30);
    age = watched.age();
    EXPECT_EQ(age.violations, 101U);
    EXPECT_EQ(age.longest_run_frames, 101U);
    EXPECT_EQ(age.longest_run_ns, 1101 * kExamplePeriodNs);
}

TEST(BudgetMonitor, JudgesOnlyFramesWithFreshGaze) {
    Watched watched(budget_of(20), kSecond);
    for (int i = 0; i < 50; ++i) {
        watched.add(10);
    }
    for (int i = 0; i < 50; ++i) {
        watched.add(300, gaze::FoveaState::Held);
    }
    watched.add(21);
    watched.add(300, gaze::FoveaState::Returning);
    watched.add(21);
    watched.add(15, gaze::FoveaState::OtherEye);
    EXPECT_TRUE(watched.events.empty());
    const MonitorSnapshot snapshot = watched.monitor.snapshot();
    const MonitorPart& age = snapshot.parts[kAgePart];
    EXPECT_EQ(age.all_known, 53U);
    EXPECT_EQ(age.violations, 2U);
    EXPECT_EQ(age.longest_run_frames, 1U) << "lost gaze ends a run";
    EXPECT_EQ(snapshot.with_gaze, 53U);
    EXPECT_EQ(snapshot.frames, 104U);
    EXPECT_EQ(snapshot.state, gaze::FoveaState::OtherEye);
    EXPECT_THAT(snapshot.by_state, ElementsAre(49U, 1U, 50U, 1U, 0U)) << "of the window";
}

TEST(BudgetMonitor, HoldsTheFewestThatAPercentileNeedsWhateverTheWindow) {
    Watched watched(budget_of(20), 0);
    for (std::int64_t i = 1; i <= 100; ++i) {
        watched.add(i <= 50 ? 10 : 30);
        EXPECT_EQ(watched.age().known, static_cast<std::uint64_t>(std::min<std::int64_t>(i, 20)));
    }
    ASSERT_EQ(watched.frames.size(), 1U);
    EXPECT_EQ(watched.frames[0], 51U) << "the second of the last twenty";
    for (int i = 0; i < 50; ++i) {
        watched.add(10);
    }
    ASSERT_EQ(watched.frames.size(), 2U);
    EXPECT_EQ(watched.frames[1], 100U + 18 + 19) << "within since the 19th, and for twenty frames";
}

TEST(BudgetMonitor, SaysWhereAHugeWindowIsCut) {
    Watched watched(budget_of(20), std::numeric_limits<std::int64_t>::max());
    for (std::size_t i = 0; i < BudgetMonitor::kMost; ++i) {
        watched.add(10);
    }
    EXPECT_FALSE(watched.monitor.snapshot().window_cut);
    for (int i = 0; i < 100; ++i) {
        watched.add(10);
    }
    const MonitorSnapshot snapshot = watched.monitor.snapshot();
    EXPECT_TRUE(snapshot.window_cut);
    EXPECT_EQ(snapshot.window_frames, BudgetMonitor::kMost);
    EXPECT_EQ(snapshot.parts[kAgePart].all_known, BudgetMonitor::kMost + 100);
}

TEST(BudgetMonitor, TakesExtremes) {
    constexpr std::int64_t kMin = std::numeric_limits<std::int64_t>::min();
    constexpr std::int64_t kMax = std::numeric_limits<std::int64_t>::max();
    Watched watched(budget_of(20), kSecond);
    for (const std::int64_t at : {kMin, kMax, std::int64_t{0}, kMin, kMax}) {
        FrameAccount account = frame_of_age(0, at);
        account.stamps.wake_up = {at, time::StampKind::Measured};
        account.age.stages[0] = {kMin, time::StampKind::Measured};
        account.age.unaccounted = {kMin, time::StampKind::Measured};
        watched.add(account);
    }
    const MonitorSnapshot snapshot = watched.monitor.snapshot();
    EXPECT_EQ(snapshot.time.ns, kMax) << "time does not go back";
    EXPECT_EQ(snapshot.window_ns, kMax);
    EXPECT_EQ(snapshot.parts[kAgePart].violations, 2U);
    ASSERT_TRUE(snapshot.share_by_kind_percent.has_value());
    for (const double percent : *snapshot.share_by_kind_percent) {
        EXPECT_GE(percent, 0.0);
        EXPECT_LE(percent, 100.0);
    }
}

TEST(BudgetMonitor, WatchesStagesByTheAccountOfTheSummary) {
    LatencyBudget budget = budget_of(17);
    budget.stages_ns[static_cast<std::size_t>(Stage::Gpu)] = 3 * kMs;
    Watched watched(budget, kSecond);
    for (std::uint64_t index = 0; index < 100; ++index) {
        watched.add(account_of({example_frame(index), example_gpu(index)}, 0, {}));
    }
    ASSERT_EQ(watched.events.size(), 1U) << "16 ms in all are allowed, 4 on the GPU are not";
    EXPECT_EQ(watched.events[0].part, kGpuPart);
    const MonitorSnapshot snapshot = watched.monitor.snapshot();
    EXPECT_EQ(snapshot.parts[kAgePart].p95_ns, 16 * kMs);
    EXPECT_EQ(snapshot.parts[kGpuPart].p95_ns, 4 * kMs);
    EXPECT_EQ(snapshot.parts[kGpuPart].violations, 100U);
    EXPECT_EQ(snapshot.parts[kUnaccountedPart].p95_ns, 0);
    const auto& share = snapshot.share_by_kind_percent;
    ASSERT_TRUE(share.has_value());
    EXPECT_NEAR((*share)[static_cast<std::size_t>(time::StampKind::Profile)], 100.0 * 3 / 16, 1e-9);
    EXPECT_NEAR((*share)[static_cast<std::size_t>(time::StampKind::Measured)], 100.0 * 7 / 16,
                1e-9);
}

TEST(BudgetMonitor, WatchesWithoutABudget) {
    Watched watched(std::nullopt, kSecond);
    for (int i = 0; i < 200; ++i) {
        watched.add(500);
    }
    EXPECT_TRUE(watched.events.empty());
    EXPECT_EQ(watched.age().p99_ns, 500 * kMs);
    EXPECT_EQ(watched.age().violations, 0U);
}

/// Held against the plain definition on random streams: percentiles, counts and shares.
TEST(BudgetMonitor, IsExactOverItsWindow) {
    std::mt19937_64 random(11);
    for (const std::int64_t window_ns : {0 * kSecond, kSecond / 3, kSecond, 5 * kSecond}) {
        Watched watched(budget_of(20), window_ns);
        std::deque<std::pair<std::int64_t, FrameAccount>> window;
        for (int i = 0; i < 1500; ++i) {
            const bool known = random() % 5 != 0;
            const auto state = static_cast<gaze::FoveaState>(random() % 3);
            const FrameAccount account =
                frame_of_age(watched.next,
                             known ? std::optional(static_cast<std::int64_t>(random() % 40) * kMs)
                                   : std::nullopt,
                             state);
            window.emplace_back(account.stamps.wake_up.ns, account);
            while (window.size() > BudgetMonitor::kFewest &&
                   window.back().first - window.front().first > window_ns) {
                window.pop_front();
            }
            watched.add(account);
            std::vector<std::int64_t> ages;
            std::uint64_t unknown = 0;
            for (const auto& [at, one] : window) {
                if (one.with_gaze() && one.age.at_display.known()) {
                    ages.push_back(one.age.at_display.ns);
                } else if (one.with_gaze()) {
                    ++unknown;
                }
            }
            std::ranges::sort(ages);
            const MonitorPart age = watched.age();
            ASSERT_EQ(age.known, ages.size()) << i;
            ASSERT_EQ(age.unknown, unknown) << i;
            ASSERT_EQ(age.p95_ns, ages.size() < 20
                                      ? std::nullopt
                                      : std::optional(ages[(ages.size() * 95 + 99) / 100 - 1]));
        }
    }
}

TEST(BudgetMonitor, AllocatesNothingLater) {
    // The longest window that may be set, at 120 Hz, holds fewer frames than there is room for.
    static_assert(30 * 120 < BudgetMonitor::kMost);
    for (const std::int64_t window_ns : {kSecond / 2, 30 * kSecond}) {
        BudgetMonitor monitor(budget_of(10), window_ns);
        std::uint64_t told = 0;
        std::size_t length = 0;
        const std::size_t before = tests::allocations_of_this_thread();
        // Frames are 10 ms apart: the window moves on.
        const auto frames = static_cast<std::uint64_t>(window_ns / kExamplePeriodNs) + 500;
        for (std::uint64_t index = 0; index < frames; ++index) {
            const FrameAccount account =
                account_of({example_frame(index), example_gpu(index)}, 0, {.switching_ns = kMs});
            monitor.add(account, index, kExamplePeriodNs, [&](const BudgetEvent& event) {
                ++told;
                length += text_of(event, "test").view().size();
            });
            length += monitor.snapshot().window_frames;
        }
        EXPECT_EQ(tests::allocations_of_this_thread(), before);
        EXPECT_EQ(told, 1U);
        EXPECT_GT(length, 0U);
        EXPECT_FALSE(monitor.snapshot().window_cut);
        EXPECT_EQ(monitor.snapshot().window_frames,
                  static_cast<std::uint64_t>(window_ns / kExamplePeriodNs) + 1);
    }
}

TEST(BudgetEvents, SayWhatIsAboveWhich) {
    const BudgetEvent broken{.time = {},
                             .part = kGpuPart,
                             .broken = true,
                             .p95_ns = 7'310'000,
                             .limit_ns = 5 * kMs,
                             .frames = 450,
                             .window_ns = 5 * kSecond};
    EXPECT_EQ(text_of(broken, "strict").view(),
              "gpu above the allowed 5.00 ms: p95 7.31 ms (450 frames of the last 5.0 s; budget "
              "strict)");
    EXPECT_EQ(broken.kind().name, "budget-broken");
    BudgetEvent kept = broken;
    kept.broken = false;
    kept.p95_ns = 4 * kMs;
    kept.lasted_ns = 12 * kSecond;
    EXPECT_EQ(text_of(kept, "strict").view(),
              "gpu within the allowed 5.00 ms: p95 4.00 ms, after 12.0 s (450 frames of the last "
              "5.0 s; budget strict)");
    EXPECT_EQ(kept.kind().name, "budget-kept");
    BudgetEvent extreme = kept;
    extreme.p95_ns = extreme.lasted_ns = extreme.window_ns = extreme.limit_ns =
        std::numeric_limits<std::int64_t>::min();
    extreme.frames = std::numeric_limits<std::uint64_t>::max();
    extreme.part = kAgePart;
    const auto text = text_of(extreme, std::string(500, 'x'));
    EXPECT_LE(text.view().size(), 240U);
    EXPECT_THAT(std::string(text.view()), HasSubstr("xxx"));
}

}  // namespace
}  // namespace gazeloop::latency
