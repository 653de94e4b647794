// What may stand between a program and a runtime's eye gaze is said, gate by gate.
#include "tests/openxr/eye_gaze.h"

#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <ranges>

#include "runtime/gaze/direction.h"

namespace gazeloop::tests {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

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
