#include "runtime/run/no_effect.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace gazeloop::run {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

/// A headless run on a fixed gaze, with the settings given as the command line gives them.
class NoEffect : public testing::Test {
  protected:
    NoEffect() {
        request_.settings = &settings_;
        request_.gaze = "fixed:0,0";
        EXPECT_TRUE(settings_.set("target.name", "headless", "--target"));
    }
    std::vector<std::string> said(const std::string& key, const std::string& text,
                                  const char* origin = "--set") {
        const auto set = settings_.set(key, text, origin);
        EXPECT_TRUE(set) << set.error().message;
        return without_effect(request_);
    }

    ProgramSettings settings_;
    FrameRunRequest request_;
};

struct Asked {
    const char* key;
    const char* text;
    const char* stands_in_the_way;
    const char* with;
    void (*give)(ProgramSettings&, FrameRunRequest&);  ///< what it has an effect with
};

void PrintTo(const Asked& asked, std::ostream* out) { *out << asked.key; }

template <const char* source>
void gaze(ProgramSettings& /*settings*/, FrameRunRequest& request) {
    request.gaze = source;
}
constexpr char kSim[] = "sim";
constexpr char kHid[] = "hid:/dev/hidraw3";
constexpr char kSteamFrame[] = "steam-frame:/dev/shm/a";

void light_field(ProgramSettings& settings, FrameRunRequest& /*request*/) {
    EXPECT_TRUE(settings.set("render.scene", "views.lightfield", "--scene"));
}
void meshes(ProgramSettings& settings, FrameRunRequest& /*request*/) {
    EXPECT_TRUE(settings.set("render.scene", "gallery", "--scene"));
}
void to_runtime(ProgramSettings& settings, FrameRunRequest& /*request*/) {
    EXPECT_TRUE(settings.set("target.name", "openxr", "--target"));
}

class HasNone : public NoEffect, public testing::WithParamInterface<Asked> {};

TEST_P(HasNone, UntilTheRunIsAnother) {
    const Asked& asked = GetParam();
    EXPECT_THAT(said(asked.key, asked.text, "/etc/gazeloop/config.toml:1"), IsEmpty())
        << "a file is there for other runs too";
    EXPECT_THAT(said(asked.key, asked.text),
                ElementsAre(AllOf(HasSubstr(asked.key), HasSubstr("(--set) has no effect with"),
                                  HasSubstr(asked.stands_in_the_way), HasSubstr(asked.with))));
    if (asked.give != nullptr) {
        asked.give(settings_, request_);
        EXPECT_THAT(without_effect(request_), IsEmpty());
    }
}

INSTANTIATE_TEST_SUITE_P(
    Settings, HasNone,
    testing::Values(
        Asked{"sim.noise_deg", "1", "--gaze fixed:0,0", "--gaze sim", gaze<kSim>},
        Asked{"sim.head.sway_deg", "1", "--gaze fixed:0,0", "--gaze sim", gaze<kSim>},
        Asked{"profile.tracker", "fove0", "--gaze fixed:0,0", "gaze of a tracker", gaze<kSim>},
        Asked{"profile.tracker", "fove0", "--gaze fixed:0,0", "gaze.widen = true",
              [](ProgramSettings& settings, FrameRunRequest&) {
                  EXPECT_TRUE(settings.set("gaze.widen", "true", "--set"));
              }},
        Asked{"hid.eye_distance_m", "0.06", "--gaze fixed:0,0", "--gaze hid", gaze<kHid>},
        Asked{"steam_frame.rays", "before-fusion", "--gaze fixed:0,0", "--gaze steam-frame",
              gaze<kSteamFrame>},
        Asked{"trace.axes", "-x", "--gaze fixed:0,0", "--gaze trace:FILE",
              [](ProgramSettings&, FrameRunRequest& request) { request.reads_trace = true; }},
        Asked{"gaze.fixation_from_depth", "false", "--gaze fixed:0,0", "--gaze openxr",
              [](ProgramSettings&, FrameRunRequest& request) { request.openxr_gaze.emplace(); }},
        Asked{"lightfield.focus_m", "1", "render.scene = raymarch (built-in)", ".lightfield file",
              light_field},
        Asked{"render.specular_filter", "false", "render.scene = raymarch", "gallery", meshes},
        Asked{"render.specular_filter", "false", "render.scene = raymarch", ".glb file",
              [](ProgramSettings&, FrameRunRequest& request) { request.many_pictures = true; }},
        Asked{"openxr.patience_s", "1", "target.name = headless (--target)", "--target openxr",
              to_runtime},
        Asked{"target.validation", "true", "target.name = headless", "--target openxr", to_runtime},
        Asked{"render.depth", "false", "target.name = headless", "--target openxr", to_runtime},
        Asked{
            "virtual_time.gpu_ms", "3", "--clock wall", "--clock virtual",
            [](ProgramSettings&, FrameRunRequest& request) { request.clock = RunClock::Virtual; }},
        Asked{"monitor.window_s", "3", "nobody watching", "--monitor, --monitor-json or --budget",
              [](ProgramSettings&, FrameRunRequest& request) { request.monitor = true; }},
        Asked{"monitor.window_s", "3", "nobody watching", "--budget",
              [](ProgramSettings& settings, FrameRunRequest&) {
                  EXPECT_TRUE(settings.set("profile.budget", "strict", "--budget"));
              }},
        Asked{"monitor.interval_s", "3", "nobody watching", "--monitor-json",
              [](ProgramSettings&, FrameRunRequest& request) { request.monitor_json = 1; }},
        Asked{"kfr3d.growth", "2", "render.method = kfr", "kfr3d",
              [](ProgramSettings&, FrameRunRequest& request) { request.many_pictures = true; }},
        Asked{"layer.mar", "0.03", "this command", "gazeloop layer", nullptr}));

TEST_F(NoEffect, OfTheDetailFilterIsThatOfLightFields) {
    EXPECT_THAT(said("render.footprint", "true"), IsEmpty());
    EXPECT_THAT(said("render.scene", "lightfield", "--scene"),
                ElementsAre(HasSubstr("render.footprint = true (--set) has no effect with "
                                      "render.scene = lightfield (--scene)")));
}

TEST_F(NoEffect, OfTheMonitorsLinesIsSaidOfThePanelAlone) {
    request_.monitor = true;
    EXPECT_THAT(said("monitor.interval_s", "3"), ElementsAre(HasSubstr("--monitor alone")));
}

TEST_F(NoEffect, OfARecordingsGazeIsSaidOfAReplay) {
    request_.gaze.clear();
    request_.clock = RunClock::Recorded;
    EXPECT_THAT(said("sim.seed", "3", "--seed"),
                ElementsAre(HasSubstr("sim.seed = 3 (--seed) has no effect with a recording's")));
}

}  // namespace
}  // namespace gazeloop::run
