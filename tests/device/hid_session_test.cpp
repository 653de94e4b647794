// What a HID eye tracker states and is asked for: features, status, start and stop.
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstring>
#include <functional>
#include <thread>

#include "drivers/hid/hid_source.h"
#include "runtime/time/clock.h"
#include "tests/device/hid_device_fixture.h"

namespace gazeloop::drivers::hid {
namespace {

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
    EXPECT_EQ(session.error().kind, ErrorKind::Interrupted);
    EXPECT_EQ(tracker_->asked(), 1);
    EXPECT_EQ(tracker_->sent(0x14), (std::vector<std::uint8_t>{0x14, 0})) << "left as it was";
    const int taken = tracker_->requests_taken();
    const auto any = open_tracker({}, ends);
    ASSERT_FALSE(any.has_value());
    EXPECT_EQ(any.error().kind, ErrorKind::Interrupted);
    EXPECT_EQ(tracker_->asked(), 1);
    EXPECT_EQ(tracker_->requests_taken(), taken) << "neither started nor stopped";
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

/// What another program may do to a tracker that we have started.
void stop_as_another(const EmulatedTracker& tracker) {
    auto device = HidrawDevice::open(tracker.node());
    ASSERT_TRUE(device.has_value());
    ASSERT_TRUE(device->send_feature(std::vector<std::uint8_t>{0x14, 0}).has_value());
    ASSERT_EQ(tracker.sent(0x14), (std::vector<std::uint8_t>{0x14, 0}));
}

TEST_F(HidDevice, IsAskedAgainWhenSomethingStoppedIt) {
    tracker_->plug_in();
    auto session = TrackerSession::open(find_trackers().at(0), {}, never);
    ASSERT_TRUE(session.has_value());
    ASSERT_NO_FATAL_FAILURE(stop_as_another(*tracker_));
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
    ASSERT_NO_FATAL_FAILURE(stop_as_another(*tracker_));
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
    read_until(*session, feed, [&] { return session->facts().sampling_hz.has_value(); });
    read_until(*session, feed, [&] { return !session->asking(); });
    EXPECT_EQ(tracker_->sent(0x14), (std::vector<std::uint8_t>{0x14, 3}));
    EXPECT_EQ(session->facts().sampling_hz, 120U) << "told only now";
    EXPECT_EQ(session->facts().status, "ready");
    EXPECT_DOUBLE_EQ(session->features().screen_width_m.value_or(0.0), 0.527);
    std::vector<std::string> told = texts(feed.take_events());
    ASSERT_FALSE(told.empty());
    EXPECT_EQ(told.front(), "takes the request to start now");
    std::ranges::sort(told);
    EXPECT_EQ(told, (std::vector<std::string>{
                        "calibrated to a screen of 527 x 296 mm",
                        std::string("set up for the display 4d10:1234 (maker and ") +
                            "product in its EDID)",
                        "states 120 Hz", "status: ready", "takes the request to start now"}));
    const int asked = tracker_->asked();
    const int taken = tracker_->requests_taken();
    read_until(*session, feed, [&] { return tracker_->requests_taken() > taken; });
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
    read_until(*session, feed, [&] { return !session->asking(); });
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
    const std::int64_t begin_ns = time::monotonic_ns();
    auto session = TrackerSession::open(find_trackers().at(0), {}, never);
    ASSERT_TRUE(session.has_value());
    const int once = tracker_->asked();
    const auto seconds = [&] {
        return static_cast<double>(time::monotonic_ns() - begin_ns) * 1e-9;
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

// The program's end waits for no request that is still to be made.
TEST_F(HidDevice, IsAskedAgainNoMoreOnceTheProgramEnds) {
    std::atomic<bool> ends{false};
    tracker_->set_feature(0x13, {0x13, 2, 120, 0});
    tracker_->plug_in();
    auto session = TrackerSession::open(find_trackers().at(0), {}, [&] { return ends.load(); });
    ASSERT_TRUE(session.has_value());
    const int asked = tracker_->asked();
    const int taken = tracker_->requests_taken();
    ends = true;
    tracker_->send(std::vector<std::uint8_t>{0x13, 1, 120, 0});
    DeviceFeed feed;
    read_until(*session, feed, [&] { return session->asking(); });
    read_until(*session, feed, [&] { return !session->asking(); });
    EXPECT_EQ(tracker_->asked(), asked);
    EXPECT_EQ(tracker_->requests_taken(), taken);
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

}  // namespace
}  // namespace gazeloop::drivers::hid
