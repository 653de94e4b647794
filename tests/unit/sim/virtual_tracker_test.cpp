#include "sim/virtual_tracker.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <linux/uhid.h>
#include <sys/stat.h>
#include <sys/time.h>
#include <termios.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <ctime>

#include "drivers/hid/eye_tracker_reports.h"
#include "drivers/hid/screen_gaze.h"
#include "sim/gaze_generator.h"
#include "sim/uhid_device.h"
#include "tests/support/temporary_folder.h"

namespace gazeloop::sim {
namespace {

using namespace drivers::hid;

EyeTrackerLayout layout() {
    return value_or_throw(
        find_eye_tracker(value_or_throw(parse_report_descriptor(virtual_tracker_descriptor()))));
}

TEST(VirtualTracker, HasTheReportsThatItsDescriptorSays) {
    const EyeTrackerLayout tracker = layout();
    EXPECT_EQ(find_report(tracker.reports, ReportKind::Input, 0x10)->payload_bytes() + 1,
              kVirtualReportBytes);
    std::vector<FeatureReport> features;
    for (const std::uint8_t id : tracker.feature_ids()) {
        const auto report = virtual_tracker_feature(id, 120);
        ASSERT_TRUE(report.has_value()) << int{id};
        EXPECT_EQ(report->size(),
                  find_report(tracker.reports, ReportKind::Feature, id)->payload_bytes() + 1);
        features.push_back({id, *report});
    }
    const TrackerFeatures stated = decode_features(tracker, features);
    EXPECT_DOUBLE_EQ(stated.screen_width_m.value_or(0.0), kVirtualScreenWidth_m);
    EXPECT_DOUBLE_EQ(stated.optimum_distance_m.value_or(0.0), kVirtualDistance_m);
    EXPECT_DOUBLE_EQ(stated.capability_correction, 1.0);
    EXPECT_EQ(stated.status, (StatusReport{TrackerStatus::Ready, 120}));
    EXPECT_EQ(encode_mode_request(tracker, kModeGaze),
              (std::vector<std::uint8_t>{kVirtualControlId, 1}));
    EXPECT_FALSE(virtual_tracker_feature(0x77, 120).has_value());
}

/// Looks at a point of the screen, as the generator does at its distance.
TEST(VirtualTracker, WhatGoesInComesOut) {
    const gaze::GazeTrace trace = generate_gaze({.seed = 5,
                                                 .eye = {.distance_m = kVirtualDistance_m},
                                                 .head = {.sway_deg = 0.0, .turn_percent = 0.0}},
                                                20.0);
    const EyeTrackerLayout tracker = layout();
    int compared = 0;
    for (const gaze::GazeSample& sample : trace.samples) {
        const VirtualReport bytes = virtual_tracker_report(sample, 42);
        const InputReport input = decode_input(tracker, bytes);
        ASSERT_TRUE(std::holds_alternative<TrackingReport>(input));
        const auto& report = std::get<TrackingReport>(input);
        EXPECT_EQ(report.ticks, 42U);
        const gaze::PerEye<gaze::EyeRay> rays = eye_rays(report, {});
        for (const gaze::Eye eye : gaze::kEyes) {
            const gaze::EyeRay& seen = rays[gaze::index(eye)];
            const gaze::EyeRay& true_ray = sample.eyes[gaze::index(eye)];
            ASSERT_EQ(seen.valid, true_ray.valid);
            if (seen.valid) {
                ++compared;
                EXPECT_LT(glm::length(seen.origin_m - true_ray.origin_m), 2e-6);
                // The generator's eyes meet on a sphere, the screen is flat: at 18 deg they meet
                // up to 5 % before it.
                EXPECT_LT(glm::length(seen.direction - true_ray.direction), 0.006);
            }
        }
    }
    EXPECT_GT(compared, 4000);
}

TEST(VirtualTracker, LookingAwayFromTheScreenIsNoData) {
    gaze::GazeSample sample;
    for (gaze::EyeRay& ray : sample.eyes) {
        ray.valid = true;
        ray.direction = {0.0, 0.0, 1.0};
    }
    const auto gaze_of = [&] {
        return std::get<TrackingReport>(decode_input(layout(), virtual_tracker_report(sample, 0)))
            .gaze_m;
    };
    EXPECT_FALSE(gaze_of().has_value());
    sample.eyes[0].direction = sample.eyes[1].direction = {0.999, 0.0, -0.0447};
    EXPECT_FALSE(gaze_of().has_value()) << "13 m to the right";
}

TEST(VirtualTracker, SendsWhatItWasAskedFor) {
    gaze::GazeSample sample;
    sample.eyes[0].origin_m = {-0.03, 0.0, 0.0};
    sample.eyes[1].origin_m = {0.03, 0.0, 0.0};
    for (gaze::EyeRay& ray : sample.eyes) {
        ray.valid = true;
    }
    const auto sent = [&](std::uint8_t modes) {
        const auto report = std::get<TrackingReport>(
            decode_input(layout(), virtual_tracker_report(sample, 7, modes)));
        EXPECT_EQ(report.ticks, 7U);
        EXPECT_EQ(report.eye_m[0].has_value(), report.eye_m[1].has_value());
        return std::pair(report.gaze_m.has_value(), report.eye_m[0].has_value());
    };
    EXPECT_EQ(sent(kModeGaze), std::pair(true, false));
    EXPECT_EQ(sent(kModeEyePosition), std::pair(false, true));
    EXPECT_EQ(sent(kModeGaze | kModeEyePosition), std::pair(true, true));
}

TEST(UhidDevice, IsRefusedWithTheRemedyWhereThereIsNone) {
    const auto device =
        UhidDevice::create({"x", 1, 2}, virtual_tracker_descriptor(), {}, "/nowhere/uhid");
    ASSERT_FALSE(device.has_value());
    EXPECT_EQ(device.error().kind, ErrorKind::NoDevice);
    EXPECT_NE(device.error().message.find("modprobe uhid"), std::string::npos);
}

/// A FIFO in the kernel's place shows what the kernel would be told.
TEST(UhidDevice, TellsTheKernelDescriptorAndReports) {
    const tests::TemporaryFolder folder;
    const std::string path = (folder / "uhid").string();
    ASSERT_EQ(mkfifo(path.c_str(), 0600), 0);
    const int kernel = open(path.c_str(), O_RDWR | O_NONBLOCK);
    auto device = value_or_throw(
        UhidDevice::create({"eyes", 0x1209, 0xE7E7}, virtual_tracker_descriptor(), {}, path));
    uhid_event event{};
    ASSERT_EQ(read(kernel, &event, sizeof(event)), static_cast<ssize_t>(sizeof(event)));
    EXPECT_EQ(event.type, static_cast<std::uint32_t>(UHID_CREATE2));
    EXPECT_EQ(event.u.create2.rd_size, virtual_tracker_descriptor().size());
    EXPECT_EQ(std::memcmp(event.u.create2.rd_data, virtual_tracker_descriptor().data(),
                          virtual_tracker_descriptor().size()),
              0);
    EXPECT_STREQ(reinterpret_cast<const char*>(event.u.create2.name), "eyes");
    const VirtualReport report = virtual_tracker_report({}, 7);
    ASSERT_TRUE(device.send(report).has_value());
    ASSERT_EQ(read(kernel, &event, sizeof(event)), static_cast<ssize_t>(sizeof(event)));
    EXPECT_EQ(event.type, static_cast<std::uint32_t>(UHID_INPUT2));
    ASSERT_EQ(event.u.input2.size, report.size());
    EXPECT_EQ(std::memcmp(event.u.input2.data, report.data(), report.size()), 0);
    close(kernel);
}

/// A terminal that nobody holds the other end of any more: it can always be read, and has nothing.
TEST(UhidDevice, ThatHangsUpIsNotAskedOverAndOver) {
    const int kernel = posix_openpt(O_RDWR | O_NOCTTY);
    ASSERT_EQ(grantpt(kernel) | unlockpt(kernel), 0);
    const std::string path = ptsname(kernel);
    {
        const int other_end = open(path.c_str(), O_RDWR | O_NOCTTY);
        termios plain{};
        cfmakeraw(&plain);
        ASSERT_EQ(tcsetattr(other_end, TCSANOW, &plain), 0);
        close(other_end);
    }
    auto device =
        value_or_throw(UhidDevice::create({"eyes", 1, 2}, virtual_tracker_descriptor(), {}, path));
    close(kernel);
    const auto cpu_ns = [] {
        timespec now{};
        clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
        return now.tv_sec * 1'000'000'000 + now.tv_nsec;
    };
    const auto begin = std::chrono::steady_clock::now();
    const std::int64_t cpu_begin_ns = cpu_ns();
    device.answer_for(std::chrono::milliseconds(300), [] { return false; });
    EXPECT_GE(std::chrono::steady_clock::now() - begin, std::chrono::milliseconds(300));
    EXPECT_LT(cpu_ns() - cpu_begin_ns, 30'000'000) << "it slept";
}

void ignore_signal(int) {}

TEST(UhidDevice, WaitsThroughSignalsThatDoNotEndTheProgram) {
    const tests::TemporaryFolder folder;
    const std::string path = (folder / "uhid").string();
    ASSERT_EQ(mkfifo(path.c_str(), 0600), 0);
    const int kernel = open(path.c_str(), O_RDWR | O_NONBLOCK);
    auto device =
        value_or_throw(UhidDevice::create({"eyes", 1, 2}, virtual_tracker_descriptor(), {}, path));
    uhid_event event{};
    ASSERT_GT(read(kernel, &event, sizeof(event)), 0);  // what the kernel would take

    struct sigaction handler{};
    struct sigaction before{};
    handler.sa_handler = ignore_signal;
    ASSERT_EQ(sigaction(SIGALRM, &handler, &before), 0);
    const itimerval every_5_ms{{0, 5000}, {0, 5000}};
    ASSERT_EQ(setitimer(ITIMER_REAL, &every_5_ms, nullptr), 0);
    int asked = 0;
    const auto begin = std::chrono::steady_clock::now();
    device.answer_for(std::chrono::milliseconds(100), [&] { return ++asked < 0; });
    EXPECT_GE(std::chrono::steady_clock::now() - begin, std::chrono::milliseconds(100));
    EXPECT_GT(asked, 0);
    device.answer_for(std::chrono::hours(1), [] { return true; });  // ends with the next signal
    const itimerval none{};
    setitimer(ITIMER_REAL, &none, nullptr);
    sigaction(SIGALRM, &before, nullptr);
    close(kernel);
}

}  // namespace
}  // namespace gazeloop::sim
