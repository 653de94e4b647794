// A runtime that moves its origin while gaze is held in world: the foveae stay where the gaze is,
// it is said and recorded, and a replay gives the same foveae.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <string>

#include "runtime/session/session_file.h"
#include "tests/support/faults/injected.h"
#include "tests/support/run_program.h"

namespace gazeloop::tests {
namespace {

using ::testing::HasSubstr;

constexpr int kFrames = 40;
constexpr double kRight_deg = 9.0;

struct Recentre {
    const char* name;
    const char* plan;  ///< of the layer
    bool lost;         ///< the gaze, before it: held all the while
    bool announced;
    std::size_t changes;
    const char* event;
};

void PrintTo(const Recentre& recentre, std::ostream* out) { *out << recentre.name; }

class MovedOrigin : public testing::TestWithParam<Recentre> {
  protected:
    /// Both eyes look to the right in the head, whose pose only the runtime knows.
    [[nodiscard]] std::string trace(bool lost) const {
        std::string file = folder_.file("gaze.csv");
        std::ofstream out(file);
        out << "sequence,t_device_ns,t_host_ns,"
               "left_valid,left_x,left_y,left_z,left_origin_x_m,left_origin_y_m,left_origin_z_m,"
               "left_openness,left_confidence,"
               "right_valid,right_x,right_y,right_z,right_origin_x_m,right_origin_y_m,"
               "right_origin_z_m,right_openness,right_confidence,"
               "head_x_m,head_y_m,head_z_m,head_qx,head_qy,head_qz,head_qw\n";
        const double right = glm::radians(kRight_deg);
        for (int i = 0; i < 5000; ++i) {
            const int valid = lost && i > 100 ? 0 : 1;
            out << fmt::format(
                "{0},{1},,{2},{3},0,{4},-0.03,0,0,1,1,{2},{3},0,{4},0.03,0,0,1,1,"
                ",,,,,,\n",
                i, i * 4'000'000LL, valid, std::sin(right), -std::cos(right));
        }
        return file;
    }

    ScratchFolder folder_;
};

TEST_P(MovedOrigin, LeavesTheFoveaeWhereTheGazeIs) {
    const Recentre& recentre = GetParam();
    const std::string session = folder_.file("session.gaze");
    const ProgramResult run = run_gazeloop(
        {"run", "--gaze", "trace:" + trace(recentre.lost), "--frames", std::to_string(kFrames),
         "--target", "openxr", "--set", "render.scale=0.05", "--set", "gaze.hold_ms=4000", "--set",
         "gaze.stale_ms=1000", "--record", session},
        {.environment = openxr_faults(recentre.plan)});
    ASSERT_EQ(run.exit_code, 0) << run.err;

    const auto recorded = session::read_session(session);
    ASSERT_TRUE(recorded.has_value()) << recorded.error().message;
    ASSERT_EQ(recorded->origins.size(), recentre.changes);
    for (const gaze::OriginChange& change : recorded->origins) {
        EXPECT_EQ(change.announced, recentre.announced);
        EXPECT_NEAR(2.0 * std::acos(std::abs(change.new_in_old.orientation.w)), glm::radians(90.0),
                    glm::radians(2.0));
    }
    EXPECT_TRUE(std::ranges::any_of(recorded->events, [&](const session::RecordedEvent& event) {
        return event.text.find(recentre.event) != std::string::npos;
    })) << recentre.event;

    ASSERT_EQ(recorded->frames.size(), static_cast<std::size_t>(kFrames));
    const double right = glm::radians(kRight_deg);
    int seen = 0;
    for (const session::RecordedFrame& frame : recorded->frames) {
        // In the head, since Monado's simulated head wobbles slowly: .06 deg.
        const gaze::EyeView& view = frame.frame.views[0];
        const gaze::FoveaPoint& fovea = frame.frame.fovea.eyes[0];
        if (fovea.state == gaze::FoveaState::Ahead) {
            continue;
        }
        ++seen;
        const glm::dvec3 in_head = glm::conjugate(frame.frame.head.orientation) *
                                   (view.pose.orientation * fovea.direction);
        EXPECT_LT(glm::degrees(std::acos(
                      std::min(1.0, glm::dot(in_head, {std::sin(right), 0.0, -std::cos(right)})))),
                  1.0)
            << "frame " << frame.frame.index;
    }
    EXPECT_GT(seen, kFrames / 2);

    const ProgramResult replay = run_gazeloop({"replay", session});
    EXPECT_EQ(replay.exit_code, 0) << replay.err;
    EXPECT_THAT(replay.out, HasSubstr(fmt::format("bit-equal in {0} of {0} frames", kFrames)));
    // A replay can be recorded, and replayed in turn.
    const std::string again = folder_.file("again.gaze");
    ASSERT_EQ(run_gazeloop({"replay", session, "--record", again}).exit_code, 0);
    const ProgramResult second = run_gazeloop({"replay", again});
    EXPECT_EQ(second.exit_code, 0) << second.out;
    EXPECT_THAT(second.out, HasSubstr(fmt::format("bit-equal in {0} of {0} frames", kFrames)));
}

INSTANTIATE_TEST_SUITE_P(
    OfTheRuntime, MovedOrigin,
    testing::Values(Recentre{"announced", "xrWaitFrame@25=recentre=90", false, true, 1,
                             "the runtime moves its origin: held gaze goes along"},
                    Recentre{"announced_while_held", "xrWaitFrame@25=recentre=90", true, true, 1,
                             "turned by 90.0 deg"},
                    Recentre{"without_its_pose", "xrWaitFrame@25=recentre-unsaid=90", false, false,
                             1, "without saying where to"},
                    Recentre{"without_its_pose_while_held", "xrWaitFrame@25=recentre-unsaid=90",
                             true, false, 1, "held gaze stays in the head"},
                    Recentre{"without_a_word", "xrWaitFrame@25=recentre-silent=90", false, false, 1,
                             "by how the head stands"},
                    Recentre{"without_a_word_while_held", "xrWaitFrame@25=recentre-silent=90", true,
                             false, 1, "by how the head stands"},
                    Recentre{"twice",
                             "xrWaitFrame@25=recentre-silent=90;xrWaitFrame@26=recentre-silent=-90",
                             true, false, 2, "by how the head stands"}),
    [](const auto& instance) { return instance.param.name; });

}  // namespace
}  // namespace gazeloop::tests
