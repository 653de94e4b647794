// Eye gaze of an OpenXR runtime leads the foveae.
#include "tests/openxr/eye_gaze.h"

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <ranges>

#include "drivers/trace/native_trace.h"
#include "runtime/gaze/direction.h"

namespace gazeloop::tests {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

TEST_F(EyeGaze, ArrivesWithItsTimeAndItsHead) {
    const ProgramResult result = run("");
    ASSERT_EQ(result.exit_code, 0) << result.err;
    expect_no_validation_messages(result);
    const session::SessionFile session = recorded();
    ASSERT_GT(session.samples.size(), 40U);
    std::uint64_t sequence = 0;
    for (const auto& [frame, sample] : session.samples) {
        EXPECT_EQ(sample.sequence, ++sequence);
        ASSERT_EQ(sample.sampled.kind, time::StampKind::Measured);
        EXPECT_TRUE(sample.head.has_value());
        // The file is read for the latch's time, so that the age is known exactly.
        const std::int64_t age_ns = session.frames[frame].frame.stamps.latch.ns - sample.sampled.ns;
        EXPECT_GE(age_ns, kDelayNs - 1000);
        EXPECT_LE(age_ns, kDelayNs + std::llround(1e9 / kRateHz) + 1000);
    }
    for (const char* gate : {"extension listed: yes", "system supports it: yes",
                             "action bound: yes", "session focused: yes", "action active: yes",
                             "pose valid: yes", "sample time known: yes"}) {
        EXPECT_THAT(tracker_events(session), testing::Contains(HasSubstr(gate)));
        EXPECT_THAT(result.err, HasSubstr(gate));
    }
    const ProgramResult replayed = run_gazeloop({"replay", EyeGaze::session(), "--hash"});
    EXPECT_EQ(replayed.exit_code, 0) << replayed.err;
    EXPECT_THAT(replayed.out, HasSubstr("foveae bit-equal in 80 of 80 frames"));
}

// Else the first frame after it would find the gaze of before, as much as a queue holds.
TEST_F(EyeGaze, IsTakenWhileTheRuntimeWantsNoFrames) {
    const ProgramResult result = run("xrWaitFrame@20=pause");
    ASSERT_EQ(result.exit_code, 0) << result.err;
    expect_no_validation_messages(result);
    const session::SessionFile session = recorded();
    std::map<std::uint64_t, std::size_t> samples_of_frame;
    for (const auto& [frame, sample] : session.samples) {
        EXPECT_TRUE(sample.head.has_value());
        ++samples_of_frame[frame];
    }
    // One a frame, but for the pause: it is asked for 20 times in 100 ms, a new one at 120 Hz.
    EXPECT_EQ(std::ranges::count_if(samples_of_frame, [](const auto& of) { return of.second > 1; }),
              1);
    EXPECT_GE(std::ranges::max(std::views::values(samples_of_frame)), 6U);
    const ProgramResult replayed = run_gazeloop({"replay", EyeGaze::session(), "--hash"});
    EXPECT_EQ(replayed.exit_code, 0) << replayed.err;
    EXPECT_THAT(replayed.out, HasSubstr("foveae bit-equal in 80 of 80 frames"));
}

// The same gaze by two ways: one ray from the runtime, and a trace that has each eye's own ray to
// the same points, replayed. The foveae must be the same for the same sample.
TEST_F(EyeGaze, LeadsWhereAReplayOfTheSameTraceDoes) {
    ASSERT_EQ(run("", {"--set", "gaze.fixation_from_depth=false"}).exit_code, 0);
    const session::SessionFile live = recorded();
    const gaze::PerEye<gaze::EyeRay>& first = live.samples.front().sample.eyes;
    ASSERT_LT(first[0].origin_m.x, first[1].origin_m.x);
    EXPECT_NEAR(glm::length(first[1].origin_m - first[0].origin_m), 0.063, 0.01);

    gaze::GazeTrace trace;
    for (std::size_t i = 0; i < kSamples; ++i) {
        gaze::GazeSample sample;
        sample.sequence = i;
        sample.device_ns = sample_ns(i);
        for (std::size_t e = 0; e < gaze::kEyeCount; ++e) {
            gaze::EyeRay& ray = sample.eyes[e];
            ray.origin_m = first[e].origin_m;
            ray.direction = glm::normalize(kDistanceM * direction_of(i) - ray.origin_m);
            ray.valid = true;
        }
        trace.samples.push_back(sample);
    }
    const std::string csv = folder_.file("trace.csv");
    value_or_throw(drivers::write_native_trace(trace, csv));
    const std::string replay_session = folder_.file("replay.gaze");
    ASSERT_EQ(run_gazeloop({"replay", csv, "--target", "headless", "--set", "render.scale=0.05",
                            "--seconds", "5", "--record", replay_session})
                  .exit_code,
              0);
    const session::SessionFile replay = value_or_throw(session::read_session(replay_session));

    std::size_t compared = 0;
    for (const session::RecordedFrame& frame : live.frames) {
        const gaze::PerEye<gaze::FoveaPoint>& foveae = frame.frame.fovea.eyes;
        const auto sample = std::ranges::find(live.samples, foveae[0].sample_sequence,
                                              [](const auto& one) { return one.sample.sequence; });
        if (sample == live.samples.end()) {
            continue;
        }
        const std::size_t line = line_of(live, sample->sample);
        const auto same =
            std::ranges::find_if(replay.frames, [&](const session::RecordedFrame& other) {
                const gaze::FoveaPoint& fovea = other.frame.fovea.eyes[0];
                return fovea.state == gaze::FoveaState::Tracking && fovea.sample_sequence == line;
            });
        for (std::size_t e = 0; e < gaze::kEyeCount; ++e) {
            const gaze::EyeRay& ray = sample->sample.eyes[e];
            EXPECT_LT(angle_deg(ray.direction, trace.samples[line].eyes[e].direction), 1e-3);
            if (same == replay.frames.end()) {
                continue;  // the replay's frames lie otherwise; it saw another sample
            }
            // The replay's head stands still, the runtime's moves: compared in the head.
            EXPECT_LT(angle_deg(ray.direction, same->frame.fovea.eyes[e].direction), 1e-3);
            // And the live fovea is that ray, from the head at the sample's time into the view.
            const gaze::Pose& then = *sample->sample.head;
            const gaze::EyeView& view = frame.frame.views[e];
            const gaze::Pose view_in_head =
                gaze::compose(gaze::inverse(frame.frame.head), view.pose);
            const glm::dvec3 point_m =
                gaze::transform_point(then, view_in_head.position_m + kDistanceM * ray.direction);
            const gaze::PixelPosition expected =
                gaze::project(gaze::transform_point(gaze::inverse(view.pose), point_m), view);
            EXPECT_NEAR(foveae[e].position.x_px, expected.x_px, 0.01);
            EXPECT_NEAR(foveae[e].position.y_px, expected.y_px, 0.01);
            ++compared;
        }
    }
    EXPECT_GT(compared, 10U);
}

// What the eyes look at is not where the setting has it: the error stays under what is stated.
TEST_F(EyeGaze, StatesHowFarOffTheEyesMayBe) {
    ASSERT_EQ(run("", {"--set", "gaze.fixation_distance_m=0.8", "--set",
                       "gaze.fixation_from_depth=false"})
                  .exit_code,
              0);
    const session::SessionFile session = recorded();
    for (const auto& [frame, sample] : session.samples) {
        ASSERT_TRUE(sample.parallax_rad.has_value());
        const glm::dvec3 to = direction_of(line_of(session, sample));
        double worst_deg = 0.0;
        for (const double depth_m : {0.5, 0.6, 1.0, 3.0, 1e6}) {
            for (const gaze::EyeRay& ray : sample.eyes) {
                worst_deg =
                    std::max(worst_deg,
                             angle_deg(ray.direction, glm::normalize(depth_m * to - ray.origin_m)));
            }
        }
        EXPECT_LE(worst_deg, glm::degrees(*sample.parallax_rad));
        EXPECT_GE(worst_deg, 0.9 * glm::degrees(*sample.parallax_rad));
    }
    EXPECT_EQ(session.frames.back().frame.fovea.eyes[0].parallax_rad,
              session.samples.back().sample.parallax_rad);
}

/// The wearer looks at the floor where nothing stands, and slowly from one side to the other.
class EyeGazeOnTheFloor : public EyeGaze {
  protected:
    static constexpr double kFloorM = -1.4;    ///< of the scene, below the world's origin
    static constexpr double kAssumedM = 0.75;  ///< where nothing is
    static constexpr double kHalfBetweenEyesM = 0.0315;

    void SetUp() override {
        std::ostringstream lines;
        for (std::size_t i = 0; i < kSamples; ++i) {
            const double t = static_cast<double>(i) / kRateHz;
            lines << t << ' ' << 0.45 + 0.05 * std::sin(t) << " -0.8 -1\n";
        }
        gaze_file_ = folder_.write("gaze.txt", lines.str());
    }

    ProgramResult look(const std::vector<std::string>& more) {
        std::vector<std::string> words{"--set", "render.scale=0.25", "--set",
                                       fmt::format("gaze.fixation_distance_m={}", kAssumedM)};
        words.insert(words.end(), more.begin(), more.end());
        return run("", words);
    }

    struct Look {
        double meets_m;  ///< where both eyes' rays come nearest, from their middle
        double floor_m;  ///< where the gaze meets the floor, likewise
        double parallax_deg;
    };

    /// Of every sample of a recording, but for those while it all begins.
    [[nodiscard]] std::vector<Look> looks() const {
        std::vector<Look> all;
        for (const auto& [frame, sample] : recorded().samples) {
            if (frame < 30 || !sample.eyes[0].valid || !sample.head) {
                continue;
            }
            const glm::dvec3 middle_m = (sample.eyes[0].origin_m + sample.eyes[1].origin_m) / 2.0;
            const glm::dvec3 aside_m = sample.eyes[1].origin_m - sample.eyes[0].origin_m;
            const glm::dvec3& left = sample.eyes[0].direction;
            const glm::dvec3& right = sample.eyes[1].direction;
            const double cosine = glm::dot(left, right);
            const double along = (glm::dot(aside_m, left) - glm::dot(aside_m, right) * cosine) /
                                 (1.0 - cosine * cosine);
            const glm::dvec3 meeting_m = sample.eyes[0].origin_m + along * left;
            const glm::dvec3 direction =
                sample.head->orientation * glm::normalize(meeting_m - middle_m);
            const glm::dvec3 from_m = gaze::transform_point(*sample.head, middle_m);
            all.push_back({glm::length(meeting_m - middle_m), (kFloorM - from_m.y) / direction.y,
                           glm::degrees(sample.parallax_rad.value_or(180.0))});
        }
        return all;
    }
};

// The eyes' rays meet at what is looked at.
TEST_F(EyeGazeOnTheFloor, MeetsWhereTheLastFramesDepthSays) {
    for (const char* method : {"kfr", "acuity"}) {
        const ProgramResult result = look({"--method", method});
        ASSERT_EQ(result.exit_code, 0) << result.err;
        expect_no_validation_messages(result);
        EXPECT_THAT(result.err, HasSubstr("they meet where the last frame's depth says, else at"));
        const std::vector<Look> all = looks();
        ASSERT_GT(all.size(), 30U);
        for (const Look& look : all) {
            EXPECT_NEAR(1.0 / look.meets_m, 1.0 / look.floor_m, 0.01);
            EXPECT_LT(look.parallax_deg, 0.1);
            // The floor is where the gaze meets it to within what is stated and the samples' size.
            const double off_rad =
                std::abs(1.0 / look.meets_m - 1.0 / look.floor_m) * kHalfBetweenEyesM;
            EXPECT_LT(glm::degrees(off_rad), look.parallax_deg + 0.02);
        }
        // What was found stands in the recording: a replay needs no depth.
        const ProgramResult replayed = run_gazeloop({"replay", session(), "--hash"});
        EXPECT_EQ(replayed.exit_code, 0) << replayed.err;
        EXPECT_THAT(replayed.out, HasSubstr("foveae bit-equal in 80 of 80 frames"));
        std::filesystem::remove(session());
    }
}

TEST_F(EyeGazeOnTheFloor, MeetsWhereTheSettingSaysWhenDepthIsNotAsked) {
    for (const std::vector<std::string>& how :
         {std::vector<std::string>{"--set", "gaze.fixation_from_depth=false"},
          {"--method", "full"}}) {
        const ProgramResult result = look(how);
        ASSERT_EQ(result.exit_code, 0) << result.err;
        EXPECT_THAT(result.err, HasSubstr("they meet at 0.75 m"));
        ASSERT_GT(looks().size(), 30U);
        for (const Look& look : looks()) {
            EXPECT_NEAR(look.meets_m, kAssumedM, 1e-6);
            EXPECT_GT(look.parallax_deg, 1.0);
        }
        std::filesystem::remove(session());
    }
}

}  // namespace
}  // namespace gazeloop::tests
