// The HID path on an emulated device: found, opened, read, pulled out.
#include <fmt/core.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <csignal>
#include <thread>

#include "drivers/device/usb_polling.h"
#include "drivers/hid/hid_source.h"
#include "runtime/time/clock.h"
#include "tests/device/as_nobody.h"
#include "tests/device/hid_device_fixture.h"
#include "tests/device/thread_time.h"

namespace gazeloop::drivers::hid {
namespace {

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
    EXPECT_EQ(opened.error().kind, ErrorKind::NoDevice);
    EXPECT_NE(opened.error().message.find("/dev/null"), std::string::npos);
    EXPECT_FALSE(HidrawDevice::open("/dev/hidraw77").has_value());
}

// Ctrl-C is not to be told as an unplugged tracker.
TEST_F(HidDevice, ASignalWhileItIsWaitedForIsNoFailure) {
    tracker_->plug_in();
    auto device = HidrawDevice::open(tracker_->node());
    ASSERT_TRUE(device.has_value());
    struct sigaction ours{};
    ours.sa_handler = [](int) {};
    ours.sa_flags = SA_RESTART;
    struct sigaction before{};
    sigaction(SIGUSR1, &ours, &before);
    std::atomic<bool> done{false};
    Expected<std::size_t> bytes = 1;
    std::thread reader([&] {
        std::array<std::uint8_t, 65> report{};
        bytes = device->read(report, std::chrono::seconds(60));
        done = true;
    });
    while (!done) {
        pthread_kill(reader.native_handle(), SIGUSR1);
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    reader.join();
    sigaction(SIGUSR1, &before, nullptr);
    ASSERT_TRUE(bytes.has_value()) << bytes.error().message;
    EXPECT_EQ(*bytes, 0U);
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
    EXPECT_EQ(samples_[0].arrived.kind, time::StampKind::Measured);
    EXPECT_FALSE(samples_[0].sampled.known()) << "one sample makes no clock";
    EXPECT_FALSE(samples_[1].eyes[0].valid) << "cut off before the eyes";
    EXPECT_EQ(samples_[1].device_ns, 9'333'000);
    EXPECT_FALSE(samples_[2].eyes[0].valid);
    EXPECT_EQ(samples_[2].sequence, samples_[0].sequence + 2);
}

TEST_F(HidDevice, ComesLateGoesAndComesBack) {
    HidSource source({});
    std::int64_t noticed_ns = INT64_MAX;  // the best of the rounds: the machine may be busy
    std::int64_t missed_ns = INT64_MAX;
    for (int round = 1; round <= 4; ++round) {
        until_event(source, "no HID eye tracker is plugged in");
        events_.clear();
        const std::int64_t before_ns = time::monotonic_ns();
        tracker_->plug_in();
        until_event(source, "plugged in");
        noticed_ns = std::min(noticed_ns, time::monotonic_ns() - before_ns);
        tracker_->send(report_at(1000));
        until(source, [&] { return !samples_.empty() && samples_.back().eyes[0].valid; });
        const std::int64_t pulled_ns = time::monotonic_ns();
        tracker_->unplug();
        until_event(source, "gone: " + tracker_->node());
        ASSERT_FALSE(samples_.back().eyes[0].valid || samples_.back().eyes[1].valid)
            << "the loss is a sample, so that the loop need not wait until the gaze is stale";
        ASSERT_TRUE(samples_.back().arrived.known());
        missed_ns = std::min(missed_ns, samples_.back().arrived.ns - pulled_ns);
        samples_.clear();
        events_.clear();
    }
    EXPECT_LT(noticed_ns, 500'000'000) << "udev did not tell: it was found by looking each second";
    EXPECT_LT(missed_ns, 14'000'000) << "later than the next frame";
    fmt::print("noticed after {:.2f} ms, missed after {:.2f} ms\n",
               static_cast<double>(noticed_ns) * 1e-6, static_cast<double>(missed_ns) * 1e-6);
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
    const std::int64_t begin_ns = time::monotonic_ns();
    until(source, [&] { return time::monotonic_ns() - begin_ns > 3'000'000'000; });
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
    const std::int64_t start_ns = time::monotonic_ns();
    constexpr std::size_t kMostReports = 20'000;
    const auto known = [&] { return !samples_.empty() && samples_.back().sampled.known(); };
    while (samples_.size() < kMostReports && !known()) {
        const std::size_t before = samples_.size();
        const std::int64_t sent_ns = time::monotonic_ns() - start_ns;
        tracker_->send(report_at(static_cast<std::uint64_t>(sent_ns) / 1000));
        until(source, [&] { return samples_.size() > before; });
    }
    ASSERT_TRUE(known());
    const gaze::GazeSample& last = samples_.back();
    EXPECT_EQ(last.sampled.kind, time::StampKind::Profile);
    EXPECT_EQ(last.ready.kind, time::StampKind::Measured);
    EXPECT_EQ(last.ready.ns - last.sampled.ns, 4'000'000);
    EXPECT_GE(last.uncertainty_ns.value_or(0), 1'000'000);
    EXPECT_LE(last.ready.ns, last.arrived.ns);
    // The line lies below no point but by its slope, and no report arrives before it is sent; half
    // the time between two askings is taken off.
    const std::int64_t asked_ns = last.ready.ns + kUsualPolling_ns / 2;
    EXPECT_GE(static_cast<double>(asked_ns - start_ns),
              static_cast<double>(last.device_ns) * (1.0 - time::ClockFit::kGreatestSkew));
}

// Nothing is lost; what it takes is printed, and an upper bound, because every read goes through
// umockdev's own thread.
TEST_F(HidDevice, KeepsUpWithAThousandReportsASecond) {
    constexpr int kReports = 3000;
    tracker_->plug_in();
    HidSource source({});
    until_event(source, "plugged in");
    const double cpu_before_s = tests::thread_seconds(kHidThreadName);
    const std::int64_t start_ns = time::monotonic_ns();
    int refused = 0;  // the emulated node holds a second of reports
    std::thread sender([&] {
        for (int i = 0; i < kReports; ++i) {
            time::sleep_until_ns(start_ns + i * 1'000'000LL);
            refused += tracker_->try_send(report_at(static_cast<std::uint64_t>(i) * 1000)) ? 0 : 1;
        }
    });
    std::vector<double> published_us;
    for (int i = 0; i < 1'000'000 && samples_.size() < kReports; ++i) {
        const std::size_t before = samples_.size();
        source.poll(0, samples_);
        const std::int64_t now_ns = time::monotonic_ns();
        if (samples_.size() == before + 1) {
            published_us.push_back(static_cast<double>(now_ns - samples_.back().arrived.ns) * 1e-3);
        }
        if (samples_.size() == before) {
            time::sleep_until_ns(now_ns + 20'000);
        }
    }
    sender.join();
    EXPECT_EQ(refused, 0);
    ASSERT_EQ(samples_.size(), static_cast<std::size_t>(kReports));
    const double seconds = static_cast<double>(time::monotonic_ns() - start_ns) * 1e-9;
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
    if (const std::string missing = tests::missing_for_nobody(); !missing.empty()) {
        GTEST_SKIP() << missing;
    }
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
