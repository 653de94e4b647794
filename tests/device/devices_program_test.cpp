// The program as its users run it, on an emulated device.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <nlohmann/json.hpp>
#include <optional>
#include <stop_token>
#include <thread>

#include "runtime/session/session_file.h"
#include "runtime/time/clock.h"
#include "sim/virtual_tracker.h"
#include "tests/device/emulated_tracker.h"
#include "tests/device/standstill.h"
#include "tests/support/background_process.h"
#include "tests/support/run_program.h"

namespace gazeloop::tests {
namespace {

/// Sends a report every 5 ms, while it exists.
class Sending {
  public:
    explicit Sending(const EmulatedTracker& tracker)
        : thread_([&tracker](const std::stop_token& stop) {
              gaze::GazeSample sample;
              for (gaze::EyeRay& ray : sample.eyes) {
                  ray.valid = true;
              }
              const std::int64_t begin_ns = time::monotonic_ns();
              for (std::int64_t i = 0; !stop.stop_requested(); ++i) {
                  time::sleep_until_ns(begin_ns + i * 5'000'000);
                  // Nobody may read yet, or any more.
                  (void)tracker.try_send(
                      sim::virtual_tracker_report(sample, static_cast<std::uint64_t>(i) * 5000));
              }
          }) {}

  private:
    std::jthread thread_;
};

class DevicesProgram : public testing::Test {
  protected:
    void SetUp() override {
        const auto descriptor = sim::virtual_tracker_descriptor();
        tracker_.emplace(std::vector<std::uint8_t>(descriptor.begin(), descriptor.end()));
        ASSERT_TRUE(tracker_->possible())
            << "run by ctest, which preloads libumockdev-preload.so.0";
        for (const std::uint8_t id : std::initializer_list<std::uint8_t>{0x11, 0x12, 0x13}) {
            auto feature = *sim::virtual_tracker_feature(id, 200);
            if (id == 0x11) {
                feature[1] = 3;  // its quality
            }
            tracker_->set_feature(id, feature);
        }
    }

    std::optional<EmulatedTracker> tracker_;
    ScratchFolder folder_;
};

TEST_F(DevicesProgram, SaysWhyThereIsNoGaze) {
    const ProgramResult none = run_gazeloop({"devices"});
    EXPECT_EQ(none.exit_code, 4) << none.err;
    EXPECT_NE(none.out.find("No eye tracker was found"), std::string::npos) << none.out;
    tracker_->plug_in();
    const ProgramResult silent = run_gazeloop({"devices", "--seconds", "0.2"});
    EXPECT_EQ(silent.exit_code, 4) << silent.err;
    for (const char* part : {"opened, no report in ", "not worn", "less than its descriptor"}) {
        EXPECT_NE(silent.out.find(part), std::string::npos) << part << '\n' << silent.out;
    }
    EXPECT_NE(silent.out.find("not tried on hardware"), std::string::npos) << silent.out;
}

// What was not listened to is not called silent.
TEST_F(DevicesProgram, ThatIsInterruptedSaysSo) {
    tracker_->plug_in();
    BackgroundProcess program(
        {.command = {GAZELOOP_BINARY_DIR "/gazeloop", "devices", "--seconds", "60"},
         .environment = {},
         .output_file = folder_.file("out")});
    // Asked for its features: it is being listened to.
    for (int i = 0; i < 6000 && tracker_->asked() == 0; ++i) {
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    ASSERT_GT(tracker_->asked(), 0);
    program.signal(SIGINT);
    EXPECT_EQ(program.wait(std::chrono::seconds(30)), 130) << program.output();
    EXPECT_NE(program.output().find("interrupted"), std::string::npos) << program.output();
    for (const char* part : {"no report in", "cannot be read"}) {
        EXPECT_EQ(program.output().find(part), std::string::npos) << program.output();
    }
}

TEST_F(DevicesProgram, ListsWhatATrackerStatesAndDoes) {
    tracker_->plug_in();
    const Sending sending(*tracker_);
    const ProgramResult result = run_gazeloop({"devices", "--seconds", "1", "--json"});
    ASSERT_EQ(result.exit_code, 0) << result.err << result.out;
    const auto list = nlohmann::json::parse(result.out);
    ASSERT_EQ(list.size(), 2U);
    EXPECT_EQ(list[1]["source"], "openxr");
    EXPECT_EQ(list[0]["path"], "/dev/hidraw0");
    EXPECT_EQ(list[0]["status"], "ready");
    EXPECT_EQ(list[0]["stated_hz"], 200);
    EXPECT_DOUBLE_EQ(list[0]["screen_width_m"], sim::kVirtualScreenWidth_m);
    EXPECT_DOUBLE_EQ(list[0]["maximum_distance_m"], 0.9);
    EXPECT_DOUBLE_EQ(list[0]["maximum_screen_width_m"], 0.6);
    EXPECT_DOUBLE_EQ(list[0]["maximum_screen_height_m"], 0.34);
    EXPECT_EQ(list[0]["quality"], 3);
    EXPECT_GT(list[0]["samples_with_gaze"], 0);
    const auto& clock = list[0]["clock"];
    ASSERT_TRUE(clock.is_object()) << list.dump(2);
    EXPECT_TRUE(clock["verdict"].is_string() && clock["trouble"].is_string());
    EXPECT_TRUE(clock["steps"].is_number_unsigned());
    for (const char* key :
         {"uncertainty_ns", "host_minus_device_ns", "skew_ppm", "mean_jitter_ns"}) {
        ASSERT_TRUE(clock.contains(key)) << clock.dump();
        EXPECT_EQ(clock[key].is_null(), clock["verdict"] == "unusable") << key << clock.dump();
    }
    EXPECT_EQ(list[0]["display_serial"].is_null(), list[0]["display_manufacturer"].is_null());
    EXPECT_FALSE(list[0]["tried_on_hardware"]);
    EXPECT_TRUE(list[0]["problems"].empty()) << list.dump(2);
    const ProgramResult text = run_gazeloop({"devices", "--seconds", "0.5"});
    for (const char* part : {"gaze in 100 %", "distance  0.45 to 0.90 m, best 0.60 m",
                             "screen    up to 600 x 340 mm", "quality   3 on a scale of its own"}) {
        EXPECT_NE(text.out.find(part), std::string::npos) << part << '\n' << text.out;
    }
    const ProgramResult live = run_gazeloop({"devices", "--watch", "--seconds", "1"});
    EXPECT_EQ(live.exit_code, 0) << live.err;
    EXPECT_NE(live.out.find("\nplugged in: "), std::string::npos) << live.out;
}

TEST_F(DevicesProgram, ListsWhatATrackerDoesNotAnswer) {
    tracker_->leave_unanswered(0x12, std::chrono::milliseconds(2000));
    tracker_->plug_in();
    const Sending sending(*tracker_);
    const ProgramResult result = run_gazeloop({"devices", "--seconds", "0.3", "--json"});
    ASSERT_EQ(result.exit_code, 0) << result.err << result.out;
    const auto tracker = nlohmann::json::parse(result.out).at(0);
    EXPECT_EQ(tracker["unanswered_feature_reports"], nlohmann::json({0x12}));
    EXPECT_EQ(tracker["stated_hz"], 200) << "the others are answered";
    EXPECT_NE(tracker["remarks"].dump().find("feature report 0x12: no answer in "),
              std::string::npos)
        << tracker.dump(2);
}

// No frame waits for it, and its gaze is used before the kernel has given up.
TEST_F(DevicesProgram, RunsOnWhileATrackerThatWasPluggedInDoesNotAnswer) {
    const std::string session = folder_.file("session.gaze");
    tracker_->leave_unanswered(0x12, std::chrono::milliseconds(3000));
    ProgramOptions options;
    options.trigger = "no HID eye tracker is plugged in";
    std::optional<Sending> sending;
    options.on_trigger = [&](int) {
        tracker_->plug_in();
        sending.emplace(*tracker_);
    };
    const ProgramResult result =
        run_gazeloop({"run", "--gaze", "hid", "--target", "headless", "--seconds", "6", "--record",
                      session, "--set", "render.scale=0.05"},
                     options);
    sending.reset();
    ASSERT_EQ(result.exit_code, 0) << result.err;
    const session::SessionFile file = value_or_throw(session::read_session(session));
    ASSERT_GT(file.frames.size(), 100U);
    for (std::size_t i = 1; i < file.frames.size(); ++i) {
        // The request takes 3 s, and nothing else that holds a loop up does.
        ASSERT_LT(file.frames[i].frame.stamps.latch.ns - file.frames[i - 1].frame.stamps.latch.ns,
                  2'500'000'000);
    }
    const auto given_up = std::ranges::find_if(file.events, [](const auto& event) {
        return event.text.starts_with("feature report 0x12: no answer");
    });
    ASSERT_NE(given_up, file.events.end());
    EXPECT_TRUE(std::ranges::any_of(file.samples, [&](const auto& recorded) {
        return recorded.sample.eyes[0].valid && recorded.sample.arrived.ns < given_up->time.ns;
    }));
}

TEST_F(DevicesProgram, RunsOnThroughPluggingInAndPullingOut) {
    const std::string session = folder_.file("session.gaze");
    ProgramOptions options;
    options.trigger = "no HID eye tracker is plugged in";
    options.timeout = std::chrono::seconds(200);
    std::thread hands;
    options.on_trigger = [&](int) {
        hands = std::thread([&] {
            for (int round = 0; round < 2; ++round) {
                tracker_->plug_in();
                {
                    const Sending sending(*tracker_);
                    std::this_thread::sleep_for(std::chrono::milliseconds(1500));
                }
                tracker_->unplug();
                std::this_thread::sleep_for(std::chrono::milliseconds(700));
            }
        });
    };
    const ProgramResult result =
        run_gazeloop({"run", "--gaze", "hid", "--target", "headless", "--seconds", "6", "--record",
                      session, "--set", "render.scale=0.05"},
                     options);
    if (hands.joinable()) {
        hands.join();
    }
    ASSERT_EQ(result.exit_code, 0) << result.err;
    const session::SessionFile file = value_or_throw(session::read_session(session));
    int plugged = 0;
    int gone = 0;
    for (const auto& event : file.events) {
        plugged += event.kind == "tracker" && event.text.starts_with("plugged in") ? 1 : 0;
        gone += event.kind == "tracker" && event.text.starts_with("gone") ? 1 : 0;
    }
    EXPECT_EQ(plugged, 2);
    EXPECT_EQ(gone, 2);
    expect_no_standstill_at(file, "plugged in");
    expect_no_standstill_at(file, "gone");
    bool any_tracking = false;
    for (const auto& frame : file.frames) {
        any_tracking =
            any_tracking || frame.frame.fovea.eyes[0].state == gaze::FoveaState::Tracking;
    }
    EXPECT_TRUE(any_tracking);
    // Each loss reached the loop as a sample, and the frame that took it did not track.
    int losses = 0;
    for (const auto& recorded : file.samples) {
        const gaze::GazeSample& sample = recorded.sample;
        if (!sample.eyes[0].valid && !sample.sampled.known()) {
            ++losses;
            ASSERT_LT(recorded.frame, file.frames.size());
            const auto& frame = file.frames[recorded.frame].frame;
            EXPECT_EQ(frame.index, recorded.frame);
            EXPECT_NE(frame.fovea.eyes[0].state, gaze::FoveaState::Tracking);
        }
    }
    EXPECT_EQ(losses, 2);
}

}  // namespace
}  // namespace gazeloop::tests
