#include "runtime/session/session_meta.h"

#include <gtest/gtest.h>

namespace gazeloop::session {
namespace {

TEST(SessionMeta, ComesBackFromItsRows) {
    SessionMeta meta{.program = "gazeloop 0.1.0",
                     .command_line = "gazeloop run --gaze sim",
                     .started_utc = "2025-01-31T12:34:56Z",
                     .clock = latency::LoopClock::Virtual,
                     .target = "headless",
                     .target_format = "R8G8B8A8Srgb",
                     .runtime_metrics = "/tmp/metrics.pb"};
    meta.display.name = "fove0";
    meta.display.refresh_hz = 1e9 / 14'285'714.0;
    meta.display.illumination = display::Illumination::Rolling;
    meta.display.scan_out_ns = 7'000'000;
    meta.display.switching_ns = 0;
    meta.display.assumed = {"photons.scan_out_ms", "photons.switching_ms"};
    const SessionMeta read = meta_of(rows_of(meta));
    EXPECT_EQ(read.program, meta.program);
    EXPECT_EQ(read.command_line, meta.command_line);
    EXPECT_EQ(read.started_utc, meta.started_utc);
    EXPECT_EQ(read.clock, meta.clock);
    EXPECT_EQ(read.target, meta.target);
    EXPECT_EQ(read.target_format, meta.target_format);
    EXPECT_EQ(read.runtime_metrics, meta.runtime_metrics);
    EXPECT_EQ(read.display.name, meta.display.name);
    EXPECT_EQ(read.display.period_ns(), 14'285'714);
    EXPECT_EQ(read.display.illumination, meta.display.illumination);
    EXPECT_EQ(read.display.persistence_ns, std::nullopt);
    EXPECT_EQ(read.display.scan_out_ns, meta.display.scan_out_ns);
    EXPECT_EQ(read.display.switching_ns, 0) << "0 is known";
    EXPECT_EQ(read.display.assumed, meta.display.assumed);
}

TEST(SessionMeta, KeepsNoRowForWhatIsUnknown) {
    const std::vector<NamedValue> rows = rows_of({});
    ASSERT_EQ(rows.size(), 1U);
    EXPECT_EQ(rows[0].name, "clock");
    const SessionMeta read = meta_of({});
    EXPECT_EQ(read.clock, latency::LoopClock::Wall);
    EXPECT_EQ(read.display.refresh_hz, 0.0);
    EXPECT_EQ(read.display.illumination, std::nullopt);
    EXPECT_TRUE(read.display.assumed.empty());
}

TEST(SessionMeta, TakesNothingFromRowsThatAreNoNumbersOrNames) {
    const std::vector<NamedValue> rows{{"display_period_ns", "soon"},
                                       {"display_switching_ns", ""},
                                       {"display_illumination", "dim"},
                                       {"moon", "full"}};
    const SessionMeta read = meta_of(rows);
    EXPECT_EQ(read.display.refresh_hz, 0.0);
    EXPECT_EQ(read.display.switching_ns, std::nullopt);
    EXPECT_EQ(read.display.illumination, std::nullopt);
}

}  // namespace
}  // namespace gazeloop::session
