// The program as its users run it, on an emulated PlayStation VR2.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <nlohmann/json.hpp>
#include <stop_token>
#include <thread>

#include "runtime/latency/clock.h"
#include "runtime/session/session_file.h"
#include "sim/gaze_generator.h"
#include "sim/psvr2_packet.h"
#include "tests/device/emulated_psvr2.h"
#include "tests/support/run_program.h"

namespace gazeloop::tests {
namespace {

/// Sends simulated gaze at 120 Hz, while it exists.
class Sending {
  public:
    explicit Sending(EmulatedPsvr2& headset)
        : thread_([&headset](const std::stop_token& stop) {
              constexpr double kLap_s = 5.0;
              sim::GazeSimulation simulation;
              simulation.tracker.rate_hz = 120.0;
              const drivers::Trace trace = sim::generate_gaze(simulation, kLap_s);
              const std::int64_t begin_ns = latency::monotonic_ns();
              for (std::uint32_t i = 0; !stop.stop_requested(); ++i) {
                  latency::sleep_until_ns(begin_ns + i * 8'333'333LL);
                  gaze::GazeSample sample = trace.samples[i % trace.samples.size()];
                  sample.eyes[0].origin_m = {-0.031, 0.0, 0.0};
                  sample.eyes[1].origin_m = {0.031, 0.0, 0.0};
                  if (headset.seen().listening > 0) {  // it keeps nothing for later
                      headset.send(sim::psvr2_packet(sample, std::uint64_t{i} * 8333, i));
                  }
              }
          }) {}

  private:
    std::jthread thread_;
};

class Psvr2Program : public testing::Test {
  protected:
    void SetUp() override {
        headset_.emplace();
        ASSERT_TRUE(headset_->possible())
            << "run by ctest, which preloads libumockdev-preload.so.0";
    }

    std::optional<EmulatedPsvr2> headset_;
    ScratchFolder folder_;
};

TEST_F(Psvr2Program, IsListedWithWhatItDoes) {
    headset_->plug_in();
    const ProgramResult silent = run_gazeloop({"devices", "--seconds", "0.2"});
    EXPECT_EQ(silent.exit_code, 4) << silent.err;
    EXPECT_NE(silent.out.find("PlayStation VR2 (054c:0cde)"), std::string::npos) << silent.out;
    EXPECT_NE(silent.out.find("it sends nothing"), std::string::npos) << silent.out;
    EXPECT_NE(silent.out.find("not tried on hardware"), std::string::npos) << silent.out;

    const Sending sending(*headset_);
    const ProgramResult result = run_gazeloop({"devices", "--seconds", "1.5", "--json"});
    ASSERT_EQ(result.exit_code, 0) << result.err << result.out;
    const auto list = nlohmann::json::parse(result.out);
    const auto found =
        std::ranges::find_if(list, [](const auto& entry) { return entry["source"] == "psvr2"; });
    ASSERT_NE(found, list.end()) << list.dump(2);
    const nlohmann::json& headset = *found;
    EXPECT_EQ(headset["path"], headset_->node());
    EXPECT_FALSE(headset["tried_on_hardware"]);
    EXPECT_GT(headset["samples_with_gaze"], 0);
    EXPECT_EQ(headset["reports_damaged"], 0);
    EXPECT_TRUE(headset["clock"].is_object());
    EXPECT_TRUE(headset["problems"].empty()) << list.dump(2);
    EXPECT_EQ(headset["pupils_mm"], (nlohmann::json{3.5, 3.5}));
    const ProgramResult text = run_gazeloop({"devices", "--seconds", "0.5"});
    EXPECT_NE(text.out.find("pupils    3.5 mm left, 3.5 mm right"), std::string::npos) << text.out;
    EXPECT_EQ(silent.out.find("pupils"), std::string::npos) << silent.out;
    const ProgramResult live = run_gazeloop({"devices", "--watch", "--seconds", "1"});
    EXPECT_EQ(live.exit_code, 0) << live.err;
    EXPECT_NE(live.out.find("plugged in: PlayStation VR2"), std::string::npos) << live.out;
}

TEST_F(Psvr2Program, BringsItsTrackersProfileUnlessAnotherIsChosen) {
    const auto tracker = [](std::vector<std::string> arguments) {
        arguments.insert(arguments.begin(), {"run", "--gaze", "psvr2", "--print-config"});
        const ProgramResult result = run_gazeloop(arguments);
        const std::size_t begin = result.out.find("profile.tracker");
        return result.out.substr(begin, result.out.find('\n', begin) - begin);
    };
    EXPECT_NE(tracker({}).find("psvr2"), std::string::npos) << tracker({});
    EXPECT_EQ(tracker({"--tracker", "fove0"}).find("psvr2"), std::string::npos);
}

TEST_F(Psvr2Program, SaysWhoHasIt) {
    headset_->plug_in();
    headset_->set_fault(EmulatedPsvr2::Fault::ClaimedElsewhere);
    const ProgramResult result = run_gazeloop({"devices", "--seconds", "0.2"});
    EXPECT_EQ(result.exit_code, 4);
    EXPECT_NE(result.out.find("another program uses its gaze interface"), std::string::npos)
        << result.out;
}

TEST_F(Psvr2Program, RunsOnThroughPluggingInAndPullingOut) {
    const std::string session = folder_.file("session.gaze");
    ProgramOptions options;
    options.trigger = "no PlayStation VR2 is plugged in";
    options.timeout = std::chrono::seconds(200);
    std::thread hands;
    options.on_trigger = [&](int) {
        hands = std::thread([&] {
            for (int round = 0; round < 2; ++round) {
                headset_->plug_in();
                {
                    const Sending sending(*headset_);
                    std::this_thread::sleep_for(std::chrono::milliseconds(1000));
                    if (round == 1) {
                        headset_->halt();
                        std::this_thread::sleep_for(std::chrono::milliseconds(500));
                    }
                }
                headset_->unplug();
                std::this_thread::sleep_for(std::chrono::milliseconds(700));
            }
        });
    };
    const ProgramResult result =
        run_gazeloop({"run", "--gaze", "psvr2", "--target", "headless", "--seconds", "6",
                      "--record", session, "--set", "render.scale=0.05"},
                     options);
    if (hands.joinable()) {
        hands.join();
    }
    ASSERT_EQ(result.exit_code, 0) << result.err;
    EXPECT_NE(result.err.find("not tried on hardware"), std::string::npos) << result.err;
    const session::SessionFile file = value_or_throw(session::read_session(session));
    const auto told = [&](std::string_view begin) {
        return std::ranges::count_if(file.events, [&](const auto& event) {
            return event.kind == "tracker" && event.text.starts_with(begin);
        });
    };
    std::string all;
    for (const auto& event : file.events) {
        all += event.text + '\n';
    }
    EXPECT_EQ(told("plugged in"), 2) << all;
    EXPECT_EQ(told("gone"), 2);
    EXPECT_EQ(told("its gaze endpoint was halted"), 1);
    EXPECT_TRUE(std::ranges::any_of(file.frames, [](const auto& frame) {
        return frame.frame.fovea.eyes[0].state == gaze::FoveaState::Tracking;
    }));
}

}  // namespace
}  // namespace gazeloop::tests
