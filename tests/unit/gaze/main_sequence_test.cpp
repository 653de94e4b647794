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

}  // namespace
}  // namespace gazeloop::gaze
