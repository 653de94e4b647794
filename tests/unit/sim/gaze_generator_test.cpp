#include "sim/gaze_generator.h"

#include <gtest/gtest.h>

#include <sstream>
#include <string>

#include "drivers/trace/native_trace.h"

namespace gazeloop::sim {
namespace {

std::string text_of(const gaze::GazeTrace& trace) {
    std::ostringstream out;
    drivers::write_native_trace(trace, out);
    return out.str();
}

TEST(GazeGenerator, IsTheSameForTheSameSeedOnly) {
    const auto text = [](std::uint64_t seed) {
        return text_of(generate_gaze({.seed = seed}, 5.0));
    };
    EXPECT_EQ(text(3), text(3));
    EXPECT_NE(text(3), text(4));
    EXPECT_NE(text(0), text(1));
    EXPECT_NE(text(~std::uint64_t{0}), text(0));
}

TEST(GazeGenerator, GivesAPrefixForLessTime) {
    const gaze::GazeTrace longer = generate_gaze({}, 10.0);
    const gaze::GazeTrace shorter = generate_gaze({}, 4.0);
    ASSERT_EQ(shorter.samples.size(), 480U);
    ASSERT_EQ(longer.samples.size(), 1200U);
    EXPECT_EQ(shorter.samples.back().eyes[0].direction, longer.samples[479].eyes[0].direction);
    EXPECT_EQ(generate_gaze({}, 1e-9).samples.size(), 1U);
}

TEST(GazeGenerator, TellsArrivalsOfATrackerThatHasADelay) {
    EXPECT_FALSE(generate_gaze({}, 1.0).samples.front().arrived.known());
    const gaze::GazeTrace late = generate_gaze({.tracker = {.delay_ms = 20.0}}, 1.0);
    EXPECT_EQ(late.samples.front().arrived.ns, 20'000'000);
}

}  // namespace
}  // namespace gazeloop::sim
