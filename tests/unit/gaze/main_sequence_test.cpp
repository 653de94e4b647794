#include "runtime/gaze/main_sequence.h"

#include <gtest/gtest.h>

#include <cmath>

namespace gazeloop::gaze {
namespace {

TEST(MainSequence, HasThePublishedFigures) {
    EXPECT_NEAR(main_sequence(6.47).peak_deg_per_s, 596.0 * (1.0 - std::exp(-1.0)), 1e-9);
    EXPECT_NEAR(main_sequence(10.0).duration_s, 0.0413, 1e-12);
    EXPECT_NEAR(main_sequence(180.0).peak_deg_per_s, 596.0, 1e-6);
    EXPECT_GT(main_sequence(1e-12).peak_deg_per_s, 0.0);
}

TEST(SaccadeCourse, PeaksEarlyWhereItLeans) {
    const auto peak_at = [](const SaccadeCourse& course) {
        constexpr int kSteps = 1000;
        double fastest = 0.0;
        double at = 0.0;
        for (int i = 0; i < kSteps; ++i) {
            const double from = static_cast<double>(i) / kSteps;
            const double moved = course.progress(course.duration_s() * (from + 1.0 / kSteps)) -
                                 course.progress(course.duration_s() * from);
            EXPECT_GE(moved, 0.0) << "never back";
            if (moved > fastest) {
                fastest = moved;
                at = from;
            }
        }
        return at;
    };
    for (const double amplitude_deg : {2.0, 10.0, 40.0}) {
        EXPECT_NEAR(peak_at(SaccadeCourse(amplitude_deg, 1.0)), 0.5, 0.002);
        EXPECT_NEAR(peak_at(SaccadeCourse(amplitude_deg, 1.0, 0.3)), 0.385, 0.02);
        EXPECT_EQ(SaccadeCourse(amplitude_deg, 1.0, 0.3).progress(1.0), 1.0);
    }
}

}  // namespace
}  // namespace gazeloop::gaze
