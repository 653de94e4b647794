#include "runtime/run/tracker_figures.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace gazeloop::run {
namespace {

using report::GazeOrigin;

const std::vector<NamedValue> kSettings{{"profile.tracker", "generic"},
                                        {"sim.delay_ms", "7.5"},
                                        {"sim.jitter_ms", "0.5"},
                                        {"sim.rate_hz", "200"}};

TEST(TrackerFigures, OfASimulatedTrackerAreItsTerms) {
    const latency::TrackerFigures figures = tracker_figures(kSettings, GazeOrigin::Simulated);
    EXPECT_EQ(figures.delay_ns, 7'500'000);
    EXPECT_EQ(figures.uncertainty_ns, 0);
    EXPECT_EQ(figures.jitter_ns, 500'000);
    EXPECT_EQ(figures.rate_hz, 200.0);
}

TEST(TrackerFigures, OfOthersAreTheProfiles) {
    for (const GazeOrigin origin :
         {GazeOrigin::Tracker, GazeOrigin::Trace, GazeOrigin::Runtime, GazeOrigin::Unknown}) {
        const latency::TrackerFigures figures = tracker_figures(kSettings, origin);
        EXPECT_EQ(figures.delay_ns, 15'000'000);
        EXPECT_EQ(figures.uncertainty_ns, 15'000'000);
        EXPECT_EQ(figures.jitter_ns, 500'000);
        EXPECT_EQ(figures.rate_hz, 120.0);
    }
}

TEST(TrackerFigures, OfFixedGazeAreNothing) {
    const latency::TrackerFigures figures = tracker_figures(kSettings, GazeOrigin::Fixed);
    EXPECT_EQ(figures.delay_ns, 0);
    EXPECT_TRUE(std::isinf(figures.rate_hz.value_or(0.0)));
}

TEST(TrackerFigures, AreUnknownWhereNobodyStatesThem) {
    for (const GazeOrigin origin : {GazeOrigin::Tracker, GazeOrigin::Simulated}) {
        EXPECT_FALSE(tracker_figures({}, origin).delay_ns);
        EXPECT_FALSE(tracker_figures({}, origin).rate_hz);
    }
    const std::vector<NamedValue> gone{{"profile.tracker", "/nowhere/tracker.toml"}};
    EXPECT_FALSE(tracker_figures(gone, GazeOrigin::Tracker).delay_ns);
    const std::vector<NamedValue> odd{{"sim.delay_ms", "many"}, {"sim.rate_hz", "nan"}};
    EXPECT_FALSE(tracker_figures(odd, GazeOrigin::Simulated).delay_ns);
    EXPECT_FALSE(tracker_figures(odd, GazeOrigin::Simulated).rate_hz);
}

}  // namespace
}  // namespace gazeloop::run
