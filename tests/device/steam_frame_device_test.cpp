// The Steam Frame's path on an emulated eye service: found, opened, read, ended, started again.
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <functional>
#include <optional>
#include <stop_token>
#include <thread>
#include <vector>

#include "drivers/steam_frame/raw_clock.h"
#include "drivers/steam_frame/steam_frame_source.h"
#include "runtime/time/clock.h"
#include "sim/steam_frame_file.h"
#include "tests/support/temporary_folder.h"

namespace gazeloop::drivers::steam_frame {
namespace {

constexpr std::int64_t kAge_ns = 17'000'000;

/// Publishes at 90 Hz while it exists: both eyes forward, the counter in the left one's openness.
class Publishing {
  public:
    explicit Publishing(sim::SteamFrameFile& file)
        : thread_([&file](const std::stop_token& stop) {
              const std::int64_t begin_ns = time::monotonic_ns();
              for (std::int64_t i = 1; !stop.stop_requested(); ++i) {
                  time::sleep_until_ns(begin_ns + i * 11'111'111);
                  gaze::GazeSample sample;
                  for (gaze::EyeRay& ray : sample.eyes) {
                      ray.valid = true;
                      ray.openness = 0.5;
                      ray.covariance = {1e-6, 0.0, 1e-6};
                  }
                  value_or_throw(file.publish(sim::steam_frame_record(
                      sim::steam_frame_gaze(sample, read_clocks().raw_ns - kAge_ns))));
              }
          }) {}

  private:
    std::jthread thread_;
};

class SteamFrameDevice : public testing::Test {
  protected:
    [[nodiscard]] SteamFrameOptions options() const {
        return {.file = path_.string(), .delay = {}, .rays = Rays::BeforeFusion};
    }

    void until(DeviceSource& source, const std::function<bool()>& holds) {
        const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(30);
        while (!holds()) {
            ASSERT_LT(std::chrono::steady_clock::now(), end) << all_events();
            source.poll(time::monotonic_ns(), samples_);
            for (SourceEvent& event : source.take_events()) {
                events_.push_back(std::move(event.text));
            }
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
        }
    }
    void until_event(DeviceSource& source, std::string_view part) {
        until(source, [&] { return told(part) > 0; });
    }
    [[nodiscard]] std::ptrdiff_t told(std::string_view part) const {
        return std::ranges::count_if(events_, [part](const std::string& event) {
            return event.find(part) != std::string::npos;
        });
    }
    [[nodiscard]] std::string all_events() const {
        std::string all;
        for (const std::string& event : events_) {
            all += event + '\n';
        }
        return all;
    }
    sim::SteamFrameFile service(std::uint32_t version = 5) {
        return value_or_throw(sim::SteamFrameFile::create(path_, version));
    }

    tests::TemporaryFolder folder_;
    std::filesystem::path path_ = folder_ / "eye-server.mmap";
    std::vector<gaze::GazeSample> samples_;
    std::vector<std::string> events_;
};

TEST_F(SteamFrameDevice, IsReadInBothLayouts) {
    for (const std::uint32_t version : {4U, 5U}) {
        samples_.clear();
        sim::SteamFrameFile file = service(version);
        const Publishing publishing(file);
        SteamFrameSource source(options());
        until(source, [&] { return samples_.size() >= 30; });
        EXPECT_EQ(told("layout of version " + std::to_string(version)), 1) << all_events();
        for (const gaze::GazeSample& sample : samples_) {
            EXPECT_TRUE(sample.eyes[0].valid && sample.eyes[1].valid);
            EXPECT_EQ(sample.sampled.kind, time::StampKind::Measured);
            EXPECT_GE(sample.arrived.ns - sample.sampled.ns, kAge_ns);
            EXPECT_TRUE(sample.eyes[0].covariance.has_value());
            EXPECT_EQ(sample.processing, gaze::GazeProcessing::Raw);
        }
        for (std::size_t i = 1; i < samples_.size(); ++i) {
            EXPECT_GT(samples_[i].sequence, samples_[i - 1].sequence);
            EXPECT_GT(samples_[i].device_ns, samples_[i - 1].device_ns);
        }
    }
}

TEST_F(SteamFrameDevice, GivesNoOldSampleOfItsFile) {
    sim::SteamFrameFile file = service();
    value_or_throw(file.publish({}));
    SteamFrameSource source(options());
    until_event(source, "plugged in: Steam Frame's eye service at ");
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
    source.poll(0, samples_);
    EXPECT_TRUE(samples_.empty());
}

TEST_F(SteamFrameDevice, CountsTheSamplesThatItMissed) {
    sim::SteamFrameFile file = service();
    const auto tracker = value_or_throw(open_service(options()));
    DeviceFeed feed;
    const auto publish = [&](std::uint32_t skipped) {
        value_or_throw(
            file.publish(sim::steam_frame_record(sim::steam_frame_gaze({}, read_clocks().raw_ns)),
                         sim::StoreOrder::CounterLast, skipped));
        const std::uint64_t before = tracker->counts().samples;
        while (tracker->counts().samples == before) {
            value_or_throw(tracker->read(std::chrono::milliseconds(20), feed));
        }
    };
    publish(0);
    publish(0);
    publish(3);
    feed.poll(samples_);
    ASSERT_EQ(samples_.size(), 3U);
    EXPECT_EQ(samples_[2].sequence - samples_[1].sequence, 4U);
    EXPECT_EQ(tracker->counts().lost, 3U);
}

TEST_F(SteamFrameDevice, RefusesAnUnknownVersionAndWaitsForOneThatIsKnown) {
    SteamFrameSource source(options());
    until_event(source, "eye service does not run here: waiting for it");
    {
        const sim::SteamFrameFile file = service(6);
        until_event(source, "writes version 6 of its file; known are 4 (build 20260921), 5");
    }
    sim::SteamFrameFile file = service(4);
    const Publishing publishing(file);
    until(source, [&] { return samples_.size() >= 3; });
    EXPECT_EQ(told("version 6"), 1) << all_events();
}

TEST_F(SteamFrameDevice, WaitsUntilTheFileIsInitialised) {
    sim::SteamFrameFile file = value_or_throw(sim::SteamFrameFile::create(path_, 5, false));
    SteamFrameSource source(options());
    until_event(source, "not initialised its file yet");
    file.set_initialised(true);
    until_event(source, "plugged in");
}

TEST_F(SteamFrameDevice, GoesAlongWithAServiceThatIsStartedAgain) {
    SteamFrameSource source(options());
    for (int round = 1; round <= 2; ++round) {
        sim::SteamFrameFile file = service();
        std::optional<Publishing> publishing(std::in_place, file);
        const std::size_t before = samples_.size();
        until(source, [&] { return samples_.size() >= before + 5; });
        publishing.reset();
        if (round == 1) {  // replaced at once: another file under the same name
            std::filesystem::remove(path_);
            sim::SteamFrameFile next = service();
            until_event(source, "was replaced: the eye service was started again");
        }
    }
    until_event(source, "was removed: the eye service has ended");
    EXPECT_GE(told("plugged in"), 2) << all_events();
    until(source, [&] { return samples_.back().tracker_gone; });
    EXPECT_FALSE(samples_.back().eyes[0].valid || samples_.back().eyes[1].valid);
}

TEST_F(SteamFrameDevice, SurvivesAFileThatIsCutShort) {
    sim::SteamFrameFile file = service();
    SteamFrameSource source(options());
    {
        const Publishing publishing(file);
        until(source, [&] { return samples_.size() >= 5; });
    }
    ASSERT_EQ(truncate(path_.c_str(), 0), 0);
    until_event(source, "has 0 bytes, which is too short");
    ASSERT_EQ(truncate(path_.c_str(), 4096), 0);
    until_event(source, "version 0 of its file");
}

TEST_F(SteamFrameDevice, SaysThatSamplesStopAndComeAgain) {
    sim::SteamFrameFile file = service();
    SteamFrameSource source(options());
    {
        const Publishing publishing(file);
        until(source, [&] { return samples_.size() >= 5; });
    }
    until_event(source, "the headset may be off the head");
    const Publishing publishing(file);
    until_event(source, "samples come again, after ");
    EXPECT_EQ(told("plugged in"), 1) << all_events();
}

TEST_F(SteamFrameDevice, DoesNotHangAtWhatIsNoFile) {
    ASSERT_EQ(mkfifo(path_.c_str(), 0600), 0);
    const auto opened = open_service(options());
    ASSERT_FALSE(opened.has_value());
    EXPECT_NE(opened.error().message.find("is no regular file"), std::string::npos);
    std::filesystem::remove(path_);
    std::filesystem::create_directory(path_);
    EXPECT_FALSE(open_service(options()).has_value());
    std::filesystem::remove(path_);
    const auto none = open_service(options());
    ASSERT_TRUE(none.has_value());
    EXPECT_EQ(*none, nullptr);
}

TEST_F(SteamFrameDevice, IsProbed) {
    EXPECT_TRUE(
        probe_services(options(), std::chrono::milliseconds(1), [] { return false; }).empty());
    sim::SteamFrameFile file = service();
    const Publishing publishing(file);
    const auto probes =
        probe_services(options(), std::chrono::milliseconds(700), [] { return false; });
    ASSERT_EQ(probes.size(), 1U);
    EXPECT_GT(probes[0].with_gaze, 0U);
    EXPECT_FALSE(probes[0].problem.has_value());
    EXPECT_EQ(probes[0].device.text(), "Steam Frame's eye service at " + path_.string());
    EXPECT_NE(std::string(probes[0].support.verified).find("not tried on hardware"),
              std::string::npos);
    EXPECT_TRUE(probes[0].clock.has_value());
}

}  // namespace
}  // namespace gazeloop::drivers::steam_frame
