// Eye gaze of an OpenXR runtime. Monado lists the extension and has no eye tracker: a layer between
// the program and Monado supplies the gaze, from a file (tests/support/openxr_layer). The
// validation layer stands above both, and sees every call of the program.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <iomanip>
#include <map>
#include <nlohmann/json.hpp>
#include <numbers>
#include <ranges>
#include <sstream>

#include "drivers/trace/native_trace.h"
#include "runtime/gaze/direction.h"
#include "runtime/session/session_file.h"
#include "tests/support/faults/injected.h"
#include "tests/support/openxr_validation.h"
#include "tests/support/run_program.h"

namespace gazeloop::tests {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

constexpr double kRateHz = 120.0;
constexpr std::size_t kSamples = 6000;  // 50 s: no run lasts as long
constexpr std::int64_t kMs = 1'000'000;
/// How old the layer's gaze is at the least: kDelay in eye_gaze.cpp.
constexpr std::int64_t kDelayNs = 5 * kMs;
constexpr double kDistanceM = 1.5;  ///< the setting gaze.fixation_distance_m

std::int64_t sample_ns(std::size_t i) {
    return std::llround(static_cast<double>(i) / kRateHz * 1e9);
}

/// Where the wearer looks from between the eyes: a slow curve, no two places the same.
glm::dvec3 direction_of(std::size_t i) {
    const double t = static_cast<double>(i) / kRateHz * 2.0 * std::numbers::pi;
    const double azimuth = glm::radians(12.0 * std::sin(t / 1.7));
    const double elevation = glm::radians(6.0 * std::cos(t / 2.3));
    return {std::sin(azimuth) * std::cos(elevation), std::sin(elevation),
            -std::cos(azimuth) * std::cos(elevation)};
}

/// The layers with validation first, which is nearest to the program.
Environment gaze_layers(const std::string& plan, const std::string& gaze_file,
                        const std::string& validation_file) {
    Environment environment{
        {"XR_API_LAYER_PATH",
         faults_folder() + "/openxr:/usr/share/openxr/1/api_layers/explicit.d"},
        {"XR_ENABLE_API_LAYERS", "XR_APILAYER_LUNARG_core_validation:XR_APILAYER_GAZELOOP_faults"},
        {"GAZELOOP_OPENXR_FAULTS", plan},
        {"GAZELOOP_OPENXR_GAZE", gaze_file}};
    for (const auto& variable : openxr_validation_to(validation_file)) {
        environment.push_back(variable);
    }
    return environment;
}

class EyeGaze : public testing::Test {
  protected:
    void SetUp() override {
        std::ostringstream lines;
        lines << std::setprecision(17);
        for (std::size_t i = 0; i < kSamples; ++i) {
            const glm::dvec3 to = direction_of(i);
            lines << static_cast<double>(sample_ns(i)) * 1e-9 << ' ' << to.x << ' ' << to.y << ' '
                  << to.z << '\n';
        }
        gaze_file_ = folder_.write("gaze.txt", lines.str());
    }

    /// A recorded run of 80 frames with the layer's gaze.
    ProgramResult run(const std::string& plan, const std::vector<std::string>& more = {}) {
        std::vector<std::string> words{"run",
                                       "--gaze",
                                       "openxr",
                                       "--frames",
                                       "80",
                                       "--record",
                                       session(),
                                       "--set",
                                       "render.scale=0.05",
                                       "--set",
                                       "vulkan.validation=true",
                                       "--set",
                                       "gaze.hold_ms=100000"};
        words.insert(words.end(), more.begin(), more.end());
        return run_gazeloop(words,
                            {.environment = gaze_layers(plan, gaze_file_, validation_file())});
    }

    void expect_no_validation_messages(const ProgramResult& result) const {
        EXPECT_THAT(result.out + result.err, HasSubstr(kOpenXrValidationIsOn));
        EXPECT_EQ(openxr_validation_messages(validation_file()), "");
        EXPECT_THAT(result.err, Not(HasSubstr("Vulkan validation")));
    }

    [[nodiscard]] session::SessionFile recorded() const {
        return value_or_throw(session::read_session(session()));
    }
    [[nodiscard]] std::string session() const { return folder_.file("session.gaze"); }
    [[nodiscard]] std::string validation_file() const { return folder_.file("validation.txt"); }

    ScratchFolder folder_;
    std::string gaze_file_;
};

/// Which line of the file a sample is, by the runtime's clock, whose first reading is line 0.
std::size_t line_of(const session::SessionFile& session, const gaze::GazeSample& sample) {
    const auto first = std::ranges::find_if(
        session.samples, [](const auto& one) { return one.sample.eyes[0].valid; });
    return static_cast<std::size_t>(std::llround(
        static_cast<double>(sample.device_ns - first->sample.device_ns) * 1e-9 * kRateHz));
}

std::vector<std::string> tracker_events(const session::SessionFile& session) {
    std::vector<std::string> texts;
    for (const session::RecordedEvent& event : session.events) {
        if (event.kind == "tracker") {
            texts.push_back(event.text);
        }
    }
    return texts;
}

double angle_deg(const glm::dvec3& a, const glm::dvec3& b) {
    return glm::degrees(std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b)));
}

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

struct Gate {
    const char* name;
    const char* plan;   ///< in force from about the 20th frame on, for 20 frames
    const char* event;  ///< what the session says of it
    bool lost;          ///< the fovea does not follow the eyes then
    bool age_known = true;
};

void PrintTo(const Gate& gate, std::ostream* out) { *out << gate.name; }

class ShutGate : public EyeGaze, public testing::WithParamInterface<Gate> {};

TEST_P(ShutGate, IsSaidAndTheRunGoesOn) {
    const Gate& gate = GetParam();
    const ProgramResult result = run(gate.plan);
    ASSERT_EQ(result.exit_code, 0) << result.err;
    expect_no_validation_messages(result);
    const session::SessionFile session = recorded();
    EXPECT_THAT(tracker_events(session), testing::Contains(HasSubstr(gate.event)));
    EXPECT_THAT(result.err, HasSubstr(gate.event));

    const auto state_of = [&](std::size_t frame) {
        return session.frames[frame].frame.fovea.eyes[0].state;
    };
    ASSERT_EQ(session.frames.size(), 80U);
    EXPECT_EQ(state_of(15), gaze::FoveaState::Tracking);
    EXPECT_EQ(state_of(79), gaze::FoveaState::Tracking);
    std::size_t lost = 0;
    std::size_t ageless = 0;
    for (const session::RecordedFrame& frame : session.frames) {
        const gaze::FoveaPoint& fovea = frame.frame.fovea.eyes[0];
        lost += fovea.state == gaze::FoveaState::Held ? 1 : 0;
        ageless += fovea.state == gaze::FoveaState::Tracking && !fovea.sampled.known() ? 1 : 0;
    }
    if (gate.lost) {
        EXPECT_EQ(lost, 20U) << "the policy takes over with the first frame and lets go after 20";
    } else {
        EXPECT_EQ(lost, 0U);
    }
    EXPECT_EQ(ageless, gate.age_known ? 0U : 20U);
    for (const auto& [frame, sample] : session.samples) {
        for (const gaze::EyeRay& ray : sample.eyes) {
            EXPECT_TRUE(gaze::is_finite(ray.direction));
        }
    }
    EXPECT_EQ(run_gazeloop({"replay", EyeGaze::session()}).exit_code, 0);
}

INSTANTIATE_TEST_SUITE_P(
    Gates, ShutGate,
    testing::Values(
        Gate{"unfocused", "xrSyncActions@20+20=XR_SESSION_NOT_FOCUSED", "session focused: no",
             true},
        Gate{"inactive", "xrGetActionStatePose@20+20=inactive", "action active: no", true},
        Gate{"unseen", "gaze@20+20=unseen", "pose valid: no (the eyes are not seen)", true},
        Gate{"sub_nominal", "gaze@20+20=sub-nominal", "pose valid: no (sub-nominal", true},
        Gate{"no_number", "gaze@20+20=nan-pose", "pose valid: no (what the runtime gives is no",
             true},
        Gate{"no_rotation", "gaze@20+20=zero-pose", "pose valid: no (what the runtime gives is no",
             true},
        Gate{"not_located", "gaze@20+20=XR_ERROR_TIME_INVALID",
             "pose valid: no (the runtime has none for this time", true},
        Gate{"no_time_to_ask_for", "xrConvertTimespecTimeToTimeKHR@20+20=XR_ERROR_RUNTIME_FAILURE",
             "pose valid: no (the runtime has none for this time", true},
        Gate{"negative_time", "gaze@20+20=negative-time",
             "sample time known: no (the gaze's time is none of now", false, false},
        Gate{"absurd_time", "gaze@20+20=absurd-time",
             "sample time known: no (the gaze's time is none of now", false, false},
        Gate{"no_time", "gaze@20+20=no-time", "sample time known: no (the runtime gives no time",
             false, false},
        Gate{"predicted", "gaze@20+20=asked-time", "sample time known: no (the runtime predicts",
             false, false},
        Gate{"ahead", "gaze@20+20=ahead", "sample time known: no (the gaze's time lies ahead",
             false, false},
        Gate{"unbound", "xrGetCurrentInteractionProfile@1+9999=unbound", "action bound: no",
             false}),
    [](const auto& instance) { return instance.param.name; });

// Times that never move on: the gaze is followed, its age is unknown.
TEST_F(EyeGaze, WhoseTimeStandsStillHasNone) {
    ASSERT_EQ(run("gaze@1+999=still-time").exit_code, 0);
    const session::SessionFile session = recorded();
    EXPECT_THAT(tracker_events(session),
                testing::Contains(HasSubstr("the gaze moves, its time stands still")));
    const gaze::FoveaPoint& last = session.frames.back().frame.fovea.eyes[0];
    EXPECT_EQ(last.state, gaze::FoveaState::Tracking);
    EXPECT_FALSE(last.sampled.known());
}

TEST_F(EyeGaze, WithoutTimesHasNoAge) {
    const ProgramResult result = run("gaze@1+999=no-time", {"--json", folder_.file("out.json")});
    ASSERT_EQ(result.exit_code, 0) << result.err;
    EXPECT_THAT(result.out, HasSubstr("gaze age at latch       unknown"));
    EXPECT_THAT(result.out, Not(HasSubstr("gaze age at latch       measured")));
    for (const auto& [frame, sample] : recorded().samples) {
        EXPECT_FALSE(sample.sampled.known());
        EXPECT_EQ(sample.arrived.kind, time::StampKind::Measured);
    }
}

// Who wants sub-nominal gaze can have it.
TEST_F(EyeGaze, CountsSubNominalGazeForWhoAsksForIt) {
    ASSERT_EQ(run("gaze@1+999=sub-nominal", {"--set", "gaze.minimum_confidence=0"}).exit_code, 0);
    EXPECT_EQ(recorded().frames.back().frame.fovea.eyes[0].state, gaze::FoveaState::Tracking);
}

TEST_F(EyeGaze, MayEndTheSession) {
    const ProgramResult result = run("gaze@20=XR_ERROR_SESSION_LOST");
    EXPECT_EQ(result.exit_code, 5) << result.err;
    EXPECT_THAT(result.err, HasSubstr("xrLocateSpace: XR_ERROR_SESSION_LOST"));
    EXPECT_TRUE(recorded().closed_cleanly);
}

/// What `gazeloop devices --json` says of the OpenXR runtime.
class EyeGazeDevices : public EyeGaze {
  protected:
    nlohmann::json list(const Environment& environment, int exit_code) {
        const ProgramResult result =
            run_gazeloop({"devices", "--seconds", "1", "--json"}, {.environment = environment});
        EXPECT_EQ(result.exit_code, exit_code) << result.err << result.out;
        const auto all = nlohmann::json::parse(result.out);
        const auto openxr = std::ranges::find_if(
            all, [](const nlohmann::json& one) { return one["source"] == "openxr"; });
        EXPECT_NE(openxr, all.end());
        return *openxr;
    }
    [[nodiscard]] Environment layers(const std::string& plan) const {
        return gaze_layers(plan, gaze_file_, validation_file());
    }
    /// true, false or null for each gate, in their order.
    static std::vector<nlohmann::json> open(const nlohmann::json& device) {
        std::vector<nlohmann::json> gates;
        for (const nlohmann::json& gate : device["gates"]) {
            gates.push_back(gate["open"]);
        }
        return gates;
    }
};

TEST_F(EyeGazeDevices, ListsEveryGateAndListens) {
    const nlohmann::json device = list(layers(""), 0);
    EXPECT_EQ(open(device), std::vector<nlohmann::json>(7, true)) << device.dump(2);
    EXPECT_GT(device["samples_with_gaze"], 0);
    EXPECT_EQ(device["samples_with_time"], device["samples_with_gaze"]);
    EXPECT_TRUE(device["problems"].empty()) << device.dump(2);
    EXPECT_EQ(openxr_validation_messages(validation_file()), "");
}

TEST_F(EyeGazeDevices, SaysWhichGateIsShutAndWhatOpensIt) {
    const nlohmann::json none;
    const nlohmann::json real = list({}, 4);
    EXPECT_EQ(open(real), (std::vector<nlohmann::json>{true, false, none, none, none, none, none}));
    EXPECT_THAT(real["problems"].dump(), HasSubstr("use a headset with an eye tracker"));
    const nlohmann::json inactive = list(layers("xrGetActionStatePose@1+999999=inactive"), 4);
    EXPECT_EQ(open(inactive),
              (std::vector<nlohmann::json>{true, true, true, true, false, none, none}));
    EXPECT_THAT(inactive["problems"].dump(), HasSubstr("allow eye tracking for this program"));
    const nlohmann::json timeless = list(layers("gaze@1+999999=XR_ERROR_TIME_INVALID"), 4);
    EXPECT_EQ(open(timeless),
              (std::vector<nlohmann::json>{true, true, true, true, true, false, none}));
    EXPECT_THAT(timeless["problems"].dump(),
                testing::AllOf(HasSubstr("restart the runtime"), Not(HasSubstr("calibrate"))));
    const nlohmann::json ageless = list(layers("gaze@1+999999=no-time"), 0);
    EXPECT_EQ(open(ageless),
              (std::vector<nlohmann::json>{true, true, true, true, true, true, false}));
    EXPECT_EQ(ageless["samples_with_time"], 0);
    EXPECT_GT(ageless["samples_with_gaze"], 0);
}

TEST_F(EyeGazeDevices, AreLookedAtByTheDoctorAsFarAsHeSees) {
    const ProgramResult result = run_gazeloop({"doctor"}, {.environment = layers("")});
    for (const char* gate : {"extension listed: yes", "system supports it: yes",
                             "action bound: yes (XR_SUCCESS)", "gazeloop devices"}) {
        EXPECT_THAT(result.out, HasSubstr(gate));
    }
}

/// Asked for by name and not to be had: refused before anything is recorded.
class NoEyeGaze : public EyeGaze {
  protected:
    void expect_refusal(const Environment& environment, const char* says, const char* remedy) {
        const ProgramResult result =
            run_gazeloop({"run", "--gaze", "openxr", "--frames", "3", "--set", "render.scale=0.05",
                          "--record", session()},
                         {.environment = environment});
        EXPECT_EQ(result.exit_code, 4) << result.err;
        EXPECT_THAT(result.err, HasSubstr(says));
        EXPECT_THAT(result.err, HasSubstr(remedy));
        EXPECT_FALSE(std::filesystem::exists(session()));
    }
    [[nodiscard]] Environment layers(const std::string& plan) const {
        return gaze_layers(plan, gaze_file_, validation_file());
    }
};

TEST_F(NoEyeGaze, OfTheRealRuntime) {
    expect_refusal({}, "system supports it: no (supportsEyeGazeInteraction is false)",
                   "use a headset with an eye tracker");
}

TEST_F(NoEyeGaze, BySystem) {
    expect_refusal(layers("xrGetSystemProperties@1+9=no-eye-gaze"), "system supports it: no",
                   "use a headset with an eye tracker");
    EXPECT_EQ(openxr_validation_messages(validation_file()), "");
}

TEST_F(NoEyeGaze, ByBinding) {
    expect_refusal(layers("xrSuggestInteractionProfileBindings@1=XR_ERROR_PATH_UNSUPPORTED"),
                   "action bound: no (XR_ERROR_PATH_UNSUPPORTED)", "see in the runtime's settings");
}

TEST_F(NoEyeGaze, ByExtension) {
    // The program takes the Monado of its cache folder: this one has the real one's in its place.
    const auto cache_of = [](const char* variable, const char* below) {
        const char* const value = std::getenv(variable);
        return value != nullptr ? value + std::string(below) : std::string();
    };
    std::string cache = cache_of("GAZELOOP_CACHE", "");
    cache = cache.empty() ? cache_of("XDG_CACHE_HOME", "/gazeloop") : cache;
    cache = cache.empty() ? cache_of("HOME", "/.cache/gazeloop") : cache;
    const std::string manifests = folder_.file("monado/share/openxr/1");
    std::filesystem::create_directories(manifests);
    std::ofstream(manifests + "/openxr_monado.json")
        << R"({"file_format_version": "1.0.0", "runtime": {"name": "Monado", "library_path": ")"
        << faults_folder() << R"(/libgazeloop_runtime_without_eye_gaze.so"}})";
    expect_refusal({{"GAZELOOP_CACHE", folder_.file("")},
                    {"XR_RUNTIME_JSON", manifests + "/openxr_monado.json"},
                    {"GAZELOOP_REAL_RUNTIME", cache + "/monado/lib/libopenxr_monado.so"}},
                   "extension listed: no (XR_EXT_eye_gaze_interaction is not offered)",
                   "use a runtime that knows eye gaze");
}

TEST_F(NoEyeGaze, OffScreenOrInVirtualTime) {
    for (const std::vector<std::string>& how :
         {std::vector<std::string>{"--target", "headless"}, {"--clock", "virtual"}}) {
        std::vector<std::string> words{"run", "--gaze", "openxr", "--frames", "3"};
        words.insert(words.end(), how.begin(), how.end());
        const ProgramResult result = run_gazeloop(words);
        EXPECT_EQ(result.exit_code, 2) << result.err;
        EXPECT_THAT(result.err, HasSubstr("--target openxr and --clock wall"));
    }
}

}  // namespace
}  // namespace gazeloop::tests
