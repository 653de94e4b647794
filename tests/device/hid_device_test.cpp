// The HID path on an emulated device: found, opened, read, pulled out.
#include <fmt/core.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstring>
#include <functional>
#include <thread>

#include "drivers/device/usb_polling.h"
#include "drivers/hid/hid_source.h"
#include "runtime/latency/clock.h"
#include "tests/device/as_nobody.h"
#include "tests/device/emulated_tracker.h"
#include "tests/device/thread_time.h"
#include "tests/unit/drivers/hid/descriptor_items.h"

namespace gazeloop::drivers::hid {
namespace {

using tests::EmulatedTracker;

/// Report 0x10 of the first layout, at `time_us`: both eyes 600 mm before the middle of a screen.
std::vector<std::uint8_t> report_at(std::uint64_t time_us, std::int32_t gaze_x_um = 200'000) {
    std::vector<std::uint8_t> report{0x10};
    const auto add = [&](const auto value) {
        const std::size_t at = report.size();
        report.resize(at + sizeof(value));
        std::memcpy(report.data() + at, &value, sizeof(value));
    };
    add(time_us);
    for (const std::int32_t um : {gaze_x_um, 100'000, 170'000, 160'000, 600'000, 230'000, 160'000,
                                  600'000, 0, 0, 0, 0, 0, 0}) {
        add(um);
    }
    return report;
}

bool contains(const std::vector<std::string>& lines, std::string_view part) {
    return std::ranges::any_of(
        lines, [&](const std::string& line) { return line.find(part) != std::string::npos; });
}

bool never() { return false; }

class HidDevice : public testing::Test {
  protected:
    void SetUp() override {
        tracker_.emplace(first_layout());
        ASSERT_TRUE(tracker_->possible())
            << "run by ctest, which preloads libumockdev-preload.so.0";
        tracker_->set_feature(0x13, {0x13, 1, 120, 0});
        std::vector<std::uint8_t> configuration(19, 0);
        configuration[0] = 0x12;
        const std::uint16_t display[] = {0x4D10, 0x1234};
        std::memcpy(configuration.data() + 1, display, sizeof(display));
        const std::int32_t size_um[] = {527'000, 296'000};
        std::memcpy(configuration.data() + 11, size_um, sizeof(size_um));
        tracker_->set_feature(0x12, configuration);
    }

    /// Waits for as long as it may take on a busy machine, not for a time that is tested.
    void until(HidSource& source, const std::function<bool()>& done) {
        for (int i = 0; i < 2000 && !done(); ++i) {
            std::this_thread::sleep_for(std::chrono::milliseconds(5));
            source.poll(0, samples_);
            for (SourceEvent& event : source.take_events()) {
                EXPECT_TRUE(event.time.known());
                EXPECT_LE(event.text.size(), 240U) << event.text;
                events_.push_back(std::move(event.text));
            }
        }
        ASSERT_TRUE(done());
    }
    void until_event(HidSource& source, std::string_view part) {
        until(source, [&] { return contains(events_, part); });
    }

    std::optional<EmulatedTracker> tracker_;
    std::vector<gaze::GazeSample> samples_;
    std::vector<std::string> events_;
};

TEST_F(HidDevice, IsFoundOnceAndByItsDescriptor) {
    EXPECT_TRUE(find_trackers().empty());
    tracker_->plug_in();
    const std::vector<FoundTracker> found = find_trackers();
    ASSERT_EQ(found.size(), 1U);
    EXPECT_EQ(found[0].device.path, "/dev/hidraw0");
    EXPECT_EQ(found[0].device.text(), "Emulated Eye Tracker (1209:e7e7) at /dev/hidraw0");
    EXPECT_TRUE(found[0].layout.has_value());
    EXPECT_FALSE(found[0].device.access_problem.has_value());
    tracker_->unplug();
    EXPECT_TRUE(find_trackers().empty());
}

TEST_F(HidDevice, TellsItsFeaturesAndIsStartedAndStopped) {
    tracker_->plug_in();
    const std::vector<FoundTracker> found = find_trackers();
    {
        auto session = TrackerSession::open(found.at(0), {}, never);
        ASSERT_TRUE(session.has_value()) << session.error().message;
        EXPECT_EQ(session->features().status, (StatusReport{TrackerStatus::Ready, 120}));
        EXPECT_DOUBLE_EQ(session->features().screen_width_m.value_or(0.0), 0.527);
        EXPECT_EQ(session->facts().display_manufacturer, 0x4D10U);
        EXPECT_EQ(session->facts().display_product, 0x1234U);
        EXPECT_FALSE(session->facts().display_serial.has_value()) << "0 is none";
        EXPECT_TRUE(contains(session->remarks(), "the display 4d10:1234"));
        EXPECT_FALSE(session->features().maximum_width_m.has_value()) << "that report stalls";
        EXPECT_EQ(tracker_->sent(0x14), (std::vector<std::uint8_t>{0x14, 3}));
    }
    EXPECT_EQ(tracker_->sent(0x14), (std::vector<std::uint8_t>{0x14, 0}));
}

// A slow device keeps nobody from leaving for longer than one request takes.
TEST_F(HidDevice, IsAskedForNoMoreOnceTheProgramEnds) {
    tracker_->plug_in();
    const auto ends = [&] { return tracker_->asked() > 0; };
    const auto session = TrackerSession::open(find_trackers().at(0), {}, ends);
    ASSERT_FALSE(session.has_value());
    EXPECT_EQ(session.error().code, ExitCode::Interrupted);
    EXPECT_EQ(tracker_->asked(), 1);
    EXPECT_FALSE(tracker_->sent(0x14).has_value()) << "neither started nor stopped";
    const auto any = open_tracker({}, ends);
    ASSERT_FALSE(any.has_value());
    EXPECT_EQ(any.error().code, ExitCode::Interrupted);
    EXPECT_EQ(tracker_->asked(), 2);
}

// The emulated one too is whole before it can be seen.
TEST_F(HidDevice, CanBeOpenedAsSoonAsItIsThere) {
    ASSERT_TRUE(
        find_trackers().empty());  // libudev's first use is not to be by two threads at once
    for (int round = 0; round < 30; ++round) {
        std::atomic<bool> looking{false};
        std::optional<Error> problem;
        std::thread impatient([&] {
            std::vector<FoundTracker> found;
            while (found.empty()) {
                looking = true;
                found = find_trackers();
            }
            if (auto device = HidrawDevice::open(found[0].device.path); !device) {
                problem = device.error();
            }
        });
        while (!looking) {
            std::this_thread::yield();
        }
        tracker_->plug_in();
        impatient.join();
        EXPECT_FALSE(problem.has_value()) << problem->message;
        tracker_->unplug();
    }
}

// Listening to trackers for a moment takes none away from a loop that runs.
TEST_F(HidDevice, IsNotStoppedWhileAnotherReadsIt) {
    tracker_->plug_in();
    const std::vector<FoundTracker> found = find_trackers();
    auto first = TrackerSession::open(found.at(0), {}, never);
    ASSERT_TRUE(first.has_value());
    {
        auto second = TrackerSession::open(found.at(0), {}, never);
        ASSERT_TRUE(second.has_value());
    }
    EXPECT_EQ(tracker_->sent(0x14), (std::vector<std::uint8_t>{0x14, 3}));
    {
        const TrackerSession last = std::move(*first);
    }
    EXPECT_EQ(tracker_->sent(0x14), (std::vector<std::uint8_t>{0x14, 0}));
}

TEST_F(HidDevice, IsAskedAgainWhenSomethingStoppedIt) {
    tracker_->plug_in();
    auto session = TrackerSession::open(find_trackers().at(0), {}, never);
    ASSERT_TRUE(session.has_value());
    {
        auto device = HidrawDevice::open(tracker_->node());
        ASSERT_TRUE(device.has_value());
        ASSERT_TRUE(device->send_feature(std::vector<std::uint8_t>{0x14, 0}).has_value());
    }
    ASSERT_EQ(tracker_->sent(0x14), (std::vector<std::uint8_t>{0x14, 0}));
    DeviceFeed feed;
    for (int i = 0; i < 1000 && tracker_->sent(0x14)->at(1) == 0; ++i) {
        ASSERT_TRUE(session->read(std::chrono::milliseconds(50), feed).has_value());
    }
    EXPECT_EQ(tracker_->sent(0x14), (std::vector<std::uint8_t>{0x14, 3}));
}

// A stopped tracker that goes on to send its status is asked again, too.
TEST_F(HidDevice, IsAskedAgainWhileItsStatusComes) {
    tracker_->plug_in();
    auto session = TrackerSession::open(find_trackers().at(0), {}, never);
    ASSERT_TRUE(session.has_value());
    {
        auto device = HidrawDevice::open(tracker_->node());
        ASSERT_TRUE(device.has_value());
        ASSERT_TRUE(device->send_feature(std::vector<std::uint8_t>{0x14, 0}).has_value());
    }
    DeviceFeed feed;
    for (int i = 0; i < 1000 && tracker_->sent(0x14)->at(1) == 0; ++i) {
        tracker_->send(std::vector<std::uint8_t>{0x13, 1, 120, 0});
        ASSERT_TRUE(session->read(std::chrono::milliseconds(5), feed).has_value());
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    EXPECT_EQ(tracker_->sent(0x14), (std::vector<std::uint8_t>{0x14, 3}));
    EXPECT_TRUE(feed.take_events().empty()) << "the status was told when it was opened";
}

/// The session has read what is sent to it for as long as it takes on a busy machine, at most.
void read_until(TrackerSession& session, DeviceFeed& feed, const std::function<bool()>& done) {
    for (int i = 0; i < 10'000 && !done(); ++i) {
        ASSERT_TRUE(session.read(std::chrono::milliseconds(5), feed).has_value());
    }
    ASSERT_TRUE(done());
}

std::vector<std::string> texts(const std::vector<SourceEvent>& events) {
    std::vector<std::string> texts;
    texts.reserve(events.size());
    for (const SourceEvent& event : events) {
        texts.push_back(event.text);
    }
    return texts;
}

// One that boots refuses everything for a while, and need not tell when that is over.
TEST_F(HidDevice, IsStartedOnceItTakesTheRequest) {
    tracker_->plug_in();
    tracker_->set_fault(EmulatedTracker::Fault::FeaturesStall);
    auto session = TrackerSession::open(find_trackers().at(0), {}, never);
    ASSERT_TRUE(session.has_value());
    EXPECT_TRUE(contains(session->remarks(), "does not take the request: asked again each second"));
    EXPECT_FALSE(session->facts().sampling_hz.has_value());
    tracker_->set_fault(EmulatedTracker::Fault::None);
    DeviceFeed feed;
    read_until(*session, feed, [&] { return tracker_->requests_taken() > 0; });
    EXPECT_EQ(tracker_->sent(0x14), (std::vector<std::uint8_t>{0x14, 3}));
    EXPECT_EQ(session->facts().sampling_hz, 120U) << "told only now";
    EXPECT_EQ(session->facts().status, "ready");
    EXPECT_DOUBLE_EQ(session->features().screen_width_m.value_or(0.0), 0.527);
    EXPECT_EQ(
        texts(feed.take_events()),
        (std::vector<std::string>{
            "takes the request to start now", "states 120 Hz",
            "calibrated to a screen of 527 x 296 mm",
            std::string("set up for the display 4d10:1234 (maker and ") + "product in its EDID)",
            "status: ready"}));
    const int asked = tracker_->asked();
    read_until(*session, feed, [&] { return tracker_->requests_taken() > 1; });
    EXPECT_EQ(tracker_->asked(), asked) << "its features once, the start again";
}

TEST_F(HidDevice, IsStoppedEvenIfItDidNotTakeTheRequestToStart) {
    tracker_->plug_in();
    tracker_->set_fault(EmulatedTracker::Fault::FeaturesStall);
    {
        auto session = TrackerSession::open(find_trackers().at(0), {}, never);
        ASSERT_TRUE(session.has_value());
        tracker_->set_fault(EmulatedTracker::Fault::None);
    }
    EXPECT_EQ(tracker_->sent(0x14), (std::vector<std::uint8_t>{0x14, 0}));
}

// The screen's size comes with its set-up, and without it (and without eyes) there is no gaze.
TEST_F(HidDevice, IsReadAgainOnceItIsReady) {
    const auto without_eyes = [](std::uint64_t time_us) {
        constexpr std::int32_t kNoData = 0x7FFFFFFF;
        std::vector<std::uint8_t> report = report_at(time_us);
        for (std::size_t at = 17; at < 41; at += sizeof(kNoData)) {
            std::memcpy(report.data() + at, &kNoData, sizeof(kNoData));
        }
        return report;
    };
    tracker_->set_feature(0x12, std::vector<std::uint8_t>{0x12});
    tracker_->set_feature(0x13, {0x13, 3, 0, 0});
    tracker_->plug_in();
    HidOptions options;
    options.geometry.viewing_distance_m = 0.6;
    auto session = TrackerSession::open(find_trackers().at(0), options, never);
    ASSERT_TRUE(session.has_value());
    EXPECT_EQ(session->facts().status, "needs its screen set up: run the maker's set-up tool");
    const int asked = tracker_->asked();
    std::vector<std::uint8_t> configuration(19, 0);
    configuration[0] = 0x12;
    const std::int32_t size_um[] = {600'000, 340'000};
    std::memcpy(configuration.data() + 11, size_um, sizeof(size_um));
    tracker_->set_feature(0x12, configuration);
    tracker_->set_feature(0x13, {0x13, 1, 90, 0});

    DeviceFeed feed;
    std::vector<gaze::GazeSample> samples;
    std::uint64_t time_us = 0;
    const auto goes_on = [&] {
        tracker_->send(without_eyes(time_us += 10'000));
        feed.poll(samples);
    };
    for (int i = 0; i < 10; ++i) {
        goes_on();
        ASSERT_TRUE(session->read(std::chrono::milliseconds(50), feed).has_value());
    }
    EXPECT_EQ(tracker_->asked(), asked) << "not ready yet";
    tracker_->send(std::vector<std::uint8_t>{0x13, 1, 90, 0});
    read_until(*session, feed, [&] {
        goes_on();
        return !samples.empty() && samples.back().eyes[0].valid;
    });
    ASSERT_FALSE(samples.front().eyes[0].valid);
    EXPECT_EQ(tracker_->asked(), 2 * asked);
    EXPECT_EQ(session->facts().sampling_hz, 90U);
    EXPECT_EQ(session->facts().status, "ready");
    EXPECT_DOUBLE_EQ(session->facts().screen_width_m.value_or(0.0), 0.6);
    const std::vector<std::string> told = texts(feed.take_events());
    EXPECT_EQ(std::ranges::count(told, "calibrated to a screen of 600 x 340 mm"), 1);
    EXPECT_EQ(std::ranges::count(told, "status: ready"), 1) << testing::PrintToString(told);
    // What comes after does not lead to more.
    for (int i = 0; i < 50; ++i) {
        tracker_->send(std::vector<std::uint8_t>{0x13, 1, 90, 0});
        goes_on();
        ASSERT_TRUE(session->read(std::chrono::milliseconds(50), feed).has_value());
        ASSERT_TRUE(session->read(std::chrono::milliseconds(50), feed).has_value());
    }
    EXPECT_EQ(tracker_->asked(), 2 * asked);
}

// Whatever its status does, it is asked once a second at most.
TEST_F(HidDevice, IsNotAskedMoreOftenWhileItsStatusChanges) {
    tracker_->plug_in();
    const std::int64_t begin_ns = latency::monotonic_ns();
    auto session = TrackerSession::open(find_trackers().at(0), {}, never);
    ASSERT_TRUE(session.has_value());
    const int once = tracker_->asked();
    const auto seconds = [&] {
        return static_cast<double>(latency::monotonic_ns() - begin_ns) * 1e-9;
    };
    DeviceFeed feed;
    for (std::uint8_t i = 0; tracker_->asked() < 2 * once + 1 && seconds() < 60.0; ++i) {
        const auto status = static_cast<std::uint8_t>(1 + i % 2);
        tracker_->send(std::vector<std::uint8_t>{0x13, status, 120, 0});
        ASSERT_TRUE(session->read(std::chrono::milliseconds(50), feed).has_value());
    }
    EXPECT_GT(tracker_->asked(), 2 * once) << "twice";
    EXPECT_GE(seconds(), 2.0) << "a second after it was opened, and a second after that";
    EXPECT_EQ(tracker_->sent(0x14), (std::vector<std::uint8_t>{0x14, 3}));
}

// The program's end waits for one request at most then, too.
TEST_F(HidDevice, IsReadAgainNoMoreOnceTheProgramEnds) {
    std::atomic<bool> ends{false};
    tracker_->set_feature(0x13, {0x13, 2, 120, 0});
    tracker_->plug_in();
    auto session = TrackerSession::open(find_trackers().at(0), {}, [&] { return ends.load(); });
    ASSERT_TRUE(session.has_value());
    const int once = tracker_->asked();
    ends = true;
    tracker_->send(std::vector<std::uint8_t>{0x13, 1, 120, 0});
    DeviceFeed feed;
    read_until(*session, feed, [&] { return tracker_->asked() > once; });
    EXPECT_EQ(tracker_->asked(), once + 1);
}

TEST_F(HidDevice, TellsWhatItStatesThatCannotBe) {
    std::vector<std::uint8_t> configuration(19, 0);
    configuration[0] = 0x12;
    const std::int32_t size_um[] = {527, 0x7FFFFFFF};
    std::memcpy(configuration.data() + 11, size_um, sizeof(size_um));
    tracker_->set_feature(0x12, configuration);
    std::vector<std::uint8_t> capabilities(22, 0);
    capabilities[0] = 0x11;
    const std::int32_t lengths_um[] = {450'000, 600'000, 900'000, 600'000, 1};
    std::memcpy(capabilities.data() + 2, lengths_um, sizeof(lengths_um));
    tracker_->set_feature(0x11, capabilities);
    tracker_->set_feature(0x13, {0x13, 1, 0, 0});
    tracker_->plug_in();
    auto session = TrackerSession::open(find_trackers().at(0), {}, never);
    ASSERT_TRUE(session.has_value());
    const std::vector<std::string>& remarks = session->remarks();
    EXPECT_TRUE(contains(remarks, "its screen's size is wrong by a factor of 1000: corrected"));
    EXPECT_TRUE(contains(
        remarks, "states 1e-06 m as its screen's greatest height, which cannot be: left out"));
    EXPECT_FALSE(contains(remarks, "calibrated to a screen")) << "its height is no data";
    EXPECT_FALSE(contains(remarks, " Hz"));
}

TEST_F(HidDevice, AsksForNoMoreThanARequestCanSay) {
    tracker_->plug_in();
    auto device = HidrawDevice::open(tracker_->node());
    ASSERT_TRUE(device.has_value());
    for (const std::size_t payload_bytes :
         {kLongestReport - 2, kLongestReport - 1, kLongestReport}) {
        const auto report = device->feature(0x12, payload_bytes);
        ASSERT_TRUE(report.has_value()) << payload_bytes;
        EXPECT_EQ(report->size(), 19U) << payload_bytes;
    }
    std::vector<std::uint8_t> request(kLongestReport + 1, 0);
    request[0] = 0x14;
    EXPECT_FALSE(device->send_feature(request).has_value());
    EXPECT_FALSE(tracker_->sent(0x14).has_value()) << "nor one byte of it";
}

TEST_F(HidDevice, IsKnownByItsOtherNames) {
    HidSource source({.path = "/dev/my-tracker", .delay = {}, .geometry = {}});
    until_event(source, "/dev/my-tracker: No such file or directory: waiting for it");
    tracker_->plug_in();
    tracker_->set_link("my-tracker", "..");
    until_event(source, "/dev/my-tracker is no HID eye tracker: waiting for one");
    EXPECT_FALSE(contains(events_, "plugged in"));
    tracker_->set_link("my-tracker", "hidraw0");
    until_event(source, "plugged in");
    tracker_->send(report_at(1000));
    until(source, [&] { return !samples_.empty() && samples_.back().eyes[0].valid; });
}

TEST_F(HidDevice, WorksWithoutFeaturesToo) {
    tracker_->plug_in();
    tracker_->set_fault(EmulatedTracker::Fault::FeaturesStall);
    auto session = TrackerSession::open(find_trackers().at(0), {}, never);
    ASSERT_TRUE(session.has_value()) << session.error().message;
    EXPECT_FALSE(session->features().status.status.has_value());
    EXPECT_TRUE(contains(session->remarks(), "does not take the request"));
}

TEST_F(HidDevice, ANodeThatIsNoHidDeviceIsRefused) {
    const auto opened = HidrawDevice::open("/dev/null");
    ASSERT_FALSE(opened.has_value());
    EXPECT_EQ(opened.error().code, ExitCode::NoDevice);
    EXPECT_NE(opened.error().message.find("/dev/null"), std::string::npos);
    EXPECT_FALSE(HidrawDevice::open("/dev/hidraw77").has_value());
}

TEST_F(HidDevice, ReportsBecomeSamplesWholeAndShort) {
    tracker_->plug_in();
    HidSource source({});
    until_event(source, "plugged in");
    tracker_->send(report_at(1000));
    tracker_->send(std::vector<std::uint8_t>{0x13, 4, 120, 0});
    tracker_->send(std::vector<std::uint8_t>{0x77, 1, 2, 3});
    std::vector<std::uint8_t> cut = report_at(9333);
    cut.resize(20);
    tracker_->send(cut);
    tracker_->send(report_at(17667, 0x7FFFFFFF));
    until(source, [&] { return samples_.size() >= 3; });
    until_event(source, "calibration");
    EXPECT_TRUE(samples_[0].eyes[0].valid && samples_[0].eyes[1].valid);
    EXPECT_EQ(samples_[0].device_ns, 1'000'000);
    EXPECT_EQ(samples_[0].arrived.kind, latency::StampKind::Measured);
    EXPECT_FALSE(samples_[0].sampled.known()) << "one sample makes no clock";
    EXPECT_FALSE(samples_[1].eyes[0].valid) << "cut off before the eyes";
    EXPECT_EQ(samples_[1].device_ns, 9'333'000);
    EXPECT_FALSE(samples_[2].eyes[0].valid);
    EXPECT_EQ(samples_[2].sequence, samples_[0].sequence + 2);
}

TEST_F(HidDevice, ComesLateGoesAndComesBack) {
    HidSource source({});
    until_event(source, "no HID eye tracker is plugged in");
    for (int round = 1; round <= 3; ++round) {
        tracker_->plug_in();
        until_event(source, "plugged in");
        tracker_->send(report_at(1000));
        until(source, [&] { return !samples_.empty() && samples_.back().eyes[0].valid; });
        tracker_->unplug();
        until_event(source, "gone: " + tracker_->node());
        ASSERT_FALSE(samples_.back().eyes[0].valid || samples_.back().eyes[1].valid)
            << "the loss is a sample, so that the loop need not wait until the gaze is stale";
        EXPECT_TRUE(samples_.back().arrived.known());
        samples_.clear();
        events_.clear();
    }
}

TEST_F(HidDevice, AReadErrorIsToldAndTheDeviceOpenedAgain) {
    tracker_->plug_in();
    HidSource source({});
    until_event(source, "plugged in");
    tracker_->set_fault(EmulatedTracker::Fault::ReadFails);
    until_event(source, "gone");
    events_.clear();
    tracker_->set_fault(EmulatedTracker::Fault::None);
    until_event(source, "plugged in");
    samples_.clear();
    tracker_->send(report_at(5000));
    until(source, [&] { return !samples_.empty() && samples_.back().eyes[0].valid; });
}

// One that fails as soon as it is opened floods neither session nor bus.
TEST_F(HidDevice, ThatFailsAgainAndAgainIsTriedLessAndLessOften) {
    tracker_->plug_in();
    tracker_->set_fault(EmulatedTracker::Fault::ReadFails);
    HidSource source({});
    until_event(source, "failed again before it gave a sample");
    EXPECT_EQ(std::ranges::count_if(
                  events_, [](const std::string& line) { return line.starts_with("gone: "); }),
              1)
        << testing::PrintToString(events_);
    events_.clear();
    samples_.clear();
    const int asked = tracker_->asked();
    const std::int64_t begin_ns = latency::monotonic_ns();
    until(source, [&] { return latency::monotonic_ns() - begin_ns > 3'000'000'000; });
    EXPECT_TRUE(events_.empty()) << testing::PrintToString(events_);
    EXPECT_TRUE(samples_.empty());
    EXPECT_LE(tracker_->asked() - asked, 4 * 8) << "opened four times in 3 s at the most";
    tracker_->set_fault(EmulatedTracker::Fault::None);
    until_event(source, "plugged in");
    tracker_->send(report_at(5000));
    until(source, [&] { return !samples_.empty() && samples_.back().eyes[0].valid; });
}

TEST_F(HidDevice, GivesTimesOnceItsClockIsKnown) {
    tracker_->plug_in();
    HidSource source({.path = "", .delay = {4'000'000, 1'000'000}, .geometry = {}});
    until_event(source, "plugged in");
    // Each report bears the time at which it is sent, however late that is, and so a busy machine
    // only takes more reports until the clock is known.
    const std::int64_t start_ns = latency::monotonic_ns();
    constexpr std::size_t kMostReports = 20'000;
    const auto known = [&] { return !samples_.empty() && samples_.back().sampled.known(); };
    while (samples_.size() < kMostReports && !known()) {
        const std::size_t before = samples_.size();
        const std::int64_t sent_ns = latency::monotonic_ns() - start_ns;
        tracker_->send(report_at(static_cast<std::uint64_t>(sent_ns) / 1000));
        until(source, [&] { return samples_.size() > before; });
    }
    ASSERT_TRUE(known());
    const gaze::GazeSample& last = samples_.back();
    EXPECT_EQ(last.sampled.kind, latency::StampKind::Profile);
    EXPECT_EQ(last.ready.kind, latency::StampKind::Measured);
    EXPECT_EQ(last.ready.ns - last.sampled.ns, 4'000'000);
    EXPECT_GE(last.uncertainty_ns.value_or(0), 1'000'000);
    EXPECT_LE(last.ready.ns, last.arrived.ns);
    // The line lies below no point but by its slope, and no report arrives before it is sent; half
    // the time between two askings is taken off.
    const std::int64_t asked_ns = last.ready.ns + kUsualPolling_ns / 2;
    EXPECT_GE(static_cast<double>(asked_ns - start_ns),
              static_cast<double>(last.device_ns) * (1.0 - latency::ClockFit::kGreatestSkew));
}

// Nothing is lost; what it takes is printed, and an upper bound, because every read goes through
// umockdev's own thread.
TEST_F(HidDevice, KeepsUpWithAThousandReportsASecond) {
    constexpr int kReports = 3000;
    tracker_->plug_in();
    HidSource source({});
    until_event(source, "plugged in");
    const double cpu_before_s = tests::thread_seconds(kHidThreadName);
    const std::int64_t start_ns = latency::monotonic_ns();
    std::thread sender([&] {
        for (int i = 0; i < kReports; ++i) {
            latency::sleep_until_ns(start_ns + i * 1'000'000LL);
            tracker_->send(report_at(static_cast<std::uint64_t>(i) * 1000));
        }
    });
    std::vector<double> published_us;
    for (int i = 0; i < 1'000'000 && samples_.size() < kReports; ++i) {
        const std::size_t before = samples_.size();
        source.poll(0, samples_);
        const std::int64_t now_ns = latency::monotonic_ns();
        if (samples_.size() == before + 1) {
            published_us.push_back(static_cast<double>(now_ns - samples_.back().arrived.ns) * 1e-3);
        }
        if (samples_.size() == before) {
            latency::sleep_until_ns(now_ns + 20'000);
        }
    }
    sender.join();
    ASSERT_EQ(samples_.size(), static_cast<std::size_t>(kReports));
    const double seconds = static_cast<double>(latency::monotonic_ns() - start_ns) * 1e-9;
    for (int i = 0; i < kReports; ++i) {
        EXPECT_EQ(samples_[static_cast<std::size_t>(i)].device_ns, i * 1'000'000LL);
        EXPECT_EQ(samples_[static_cast<std::size_t>(i)].sequence,
                  samples_[0].sequence + static_cast<std::uint64_t>(i));
    }
    EXPECT_EQ(source.dropped(), 0U);
    std::ranges::sort(published_us);
    fmt::print(
        "reader {:.2f} % of a core; read to polled p50 {:.0f} us, p99 {:.0f} us (polled every "
        "20 us and more)\n",
        100.0 * (tests::thread_seconds(kHidThreadName) - cpu_before_s) / seconds,
        published_us.at(published_us.size() / 2), published_us.at(published_us.size() * 99 / 100));
}

TEST_F(HidDevice, SaysWhenItMayNotBeOpened) {
    tracker_->plug_in();
    tracker_->set_mode(0);
    EXPECT_TRUE(tests::as_nobody([] {
        const std::vector<FoundTracker> found = find_trackers();
        EXPECT_EQ(found.size(), 1U);
        const FoundDevice& device = found.at(0).device;
        EXPECT_NE(device.access_problem.value_or("").find("permission denied"), std::string::npos);
        EXPECT_EQ(device.missing_rule, udev_rule(0x1209, 0xE7E7));
        return !testing::Test::HasFailure();
    }));
}

}  // namespace
}  // namespace gazeloop::drivers::hid
