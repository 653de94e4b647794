// The program as its users run it, on an emulated PlayStation VR2.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <nlohmann/json.hpp>
#include <stop_token>
#include <thread>

#include "runtime/session/session_file.h"
#include "runtime/time/clock.h"
#include "sim/gaze_generator.h"
#include "sim/psvr2_packet.h"
#include "tests/device/emulated_psvr2.h"
#include "tests/device/standstill.h"
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
              simulation.eye.blinks_per_min = 0.0;  // a closed eye looks like a loss
              const gaze::GazeTrace trace = sim::generate_gaze(simulation, kLap_s);
              const std::int64_t begin_ns = time::monotonic_ns();
              for (std::uint32_t i = 0; !stop.stop_requested(); ++i) {
                  time::sleep_until_ns(begin_ns + i * 8'333'333LL);
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

/// One loss that reached the loop as a sample, and the frames from the one that took it to the one
/// that took the next gaze.
struct Loss {
    std::int64_t arrived_ns = 0;
    std::uint64_t first_frame = 0;
    std::size_t frames = 0;
    std::size_t tracking = 0;         ///< of them
    std::size_t tracking_before = 0;  ///< since the loss before
};

std::vector<Loss> losses_in(const session::SessionFile& file) {
    std::vector<Loss> losses;
    std::vector<std::uint64_t> ends;
    bool lost = true;  // until the headset's axes are known, its gaze is not
    for (const auto& [frame, sample] : file.samples) {
        const bool seen = sample.eyes[0].valid || sample.eyes[1].valid;
        if (lost && seen && !losses.empty()) {
            ends.push_back(frame);
        } else if (!lost && !seen) {
            losses.push_back({.arrived_ns = sample.arrived.ns, .first_frame = frame});
        }
        lost = !seen;
    }
    ends.resize(losses.size(), UINT64_MAX);
    std::uint64_t before = 0;
    for (std::size_t i = 0; i < losses.size(); ++i) {
        for (const auto& shown : file.frames) {
            const std::uint64_t index = shown.frame.index;
            const bool tracking = shown.frame.fovea.eyes[0].state == gaze::FoveaState::Tracking;
            const bool in = index >= losses[i].first_frame && index < ends[i];
            losses[i].frames += in ? 1 : 0;
            losses[i].tracking += in && tracking ? 1 : 0;
            losses[i].tracking_before +=
                index >= before && index < losses[i].first_frame && tracking ? 1 : 0;
        }
        before = ends[i];
    }
    return losses;
}

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
    EXPECT_NE(silent.out.find("opened, no report in "), std::string::npos) << silent.out;
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
        run_gazeloop({"run", "--gaze", "psvr2", "--target", "headless", "--seconds", "9",
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
    expect_no_standstill_at(file, "plugged in");
    expect_no_standstill_at(file, "gone");
    const std::vector<Loss> losses = losses_in(file);
    ASSERT_EQ(losses.size(), 3U) << "pulled out, halted, pulled out";
    for (const Loss& loss : losses) {
        EXPECT_GT(loss.tracking_before, 0U) << "to frame " << loss.first_frame;
        EXPECT_EQ(loss.tracking, 0U) << "from frame " << loss.first_frame;
    }
    // The halt may have been over in the frame that heard of it.
    EXPECT_GT(losses[0].frames, 0U);
    EXPECT_GT(losses[2].frames, 0U);
}

// A headset that stays on its port and fails: the loop does not wait for the reason.
TEST_F(Psvr2Program, LosesTheGazeInTheFrameOfTheFailure) {
    const std::string session = folder_.file("session.gaze");
    headset_->plug_in();
    std::optional<Sending> sending(std::in_place, *headset_);
    ProgramOptions options;
    options.trigger = "plugged in: PlayStation VR2";
    options.timeout = std::chrono::seconds(200);
    std::thread hands;
    options.on_trigger = [&](int) {
        hands = std::thread([&] {
            std::this_thread::sleep_for(std::chrono::milliseconds(1000));
            sending.reset();
            headset_->set_fault(EmulatedPsvr2::Fault::HaltStays);
            headset_->halt();
        });
    };
    const ProgramResult result =
        run_gazeloop({"run", "--gaze", "psvr2", "--target", "headless", "--seconds", "3",
                      "--record", session, "--set", "render.scale=0.05"},
                     options);
    if (hands.joinable()) {
        hands.join();
    }
    ASSERT_EQ(result.exit_code, 0) << result.err;
    const session::SessionFile file = value_or_throw(session::read_session(session));
    const auto gone = std::ranges::find_if(file.events, [](const auto& event) {
        return event.kind == "tracker" &&
               event.text.find("clearing its halted endpoint failed") != std::string::npos;
    });
    ASSERT_NE(gone, file.events.end()) << result.err;
    const std::vector<Loss> losses = losses_in(file);
    ASSERT_EQ(losses.size(), 1U) << result.err;
    EXPECT_GT(losses[0].tracking_before, 0U);
    EXPECT_EQ(losses[0].tracking, 0U);
    // As many frames as there are in the half second until the reason is told.
    EXPECT_GE(gone->time.ns - losses[0].arrived_ns, 500'000'000);
    EXPECT_TRUE(std::ranges::any_of(file.frames, [&](const auto& shown) {
        return shown.frame.index >= losses[0].first_frame &&
               shown.frame.stamps.latch.ns < gone->time.ns;
    }));
}

}  // namespace
}  // namespace gazeloop::tests
