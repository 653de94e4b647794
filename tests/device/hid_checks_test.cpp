#include <gtest/gtest.h>

#include <chrono>
#include <cstdint>
#include <string>
#include <vector>

#include "drivers/hid/find_trackers.h"
#include "runtime/doctor/checks.h"
#include "tests/device/as_nobody.h"
#include "tests/device/emulated_tracker.h"
#include "tests/unit/drivers/hid/descriptor_items.h"

namespace gazeloop::doctor {
namespace {

using drivers::hid::CollectionType;
using drivers::hid::DescriptorItems;
using tests::EmulatedTracker;

const HidChecks kBriefly{
    .options = {}, .listen = std::chrono::milliseconds(300), .stop = [] { return false; }};

DescriptorItems mouse() {
    constexpr std::uint32_t kGenericDesktop = 1;
    constexpr std::uint32_t kMouse = 2;
    DescriptorItems items;
    items.page(kGenericDesktop).open(CollectionType::Application, kMouse).close();
    return items;
}

/// Tells when it looked, but not where somebody looks.
DescriptorItems blind_tracker() {
    using namespace drivers::hid::eye_tracker;
    DescriptorItems items;
    items.page(kPage).open(CollectionType::Application, kEyeTracker);
    items.usage(kSensorTimestamp).fields(32, 1).input(DescriptorItems::kVariable).close();
    return items;
}

TEST(CheckHid, FindsNothingWhereThereIsNothing) {
    const EmulatedTracker unplugged(drivers::hid::first_layout());
    ASSERT_TRUE(unplugged.possible());
    const Findings findings = check_hid(kBriefly);
    ASSERT_EQ(findings.size(), 1U);
    EXPECT_EQ(findings[0].verdict, Verdict::NotApplicable);
    EXPECT_EQ(findings[0].facts["nodes"], 0);
}

TEST(CheckHid, TellsTrackersFromOtherDevices) {
    EmulatedTracker other(mouse().bytes());
    other.plug_in();
    const Findings findings = check_hid(kBriefly);
    ASSERT_EQ(findings.size(), 1U);
    EXPECT_EQ(findings[0].verdict, Verdict::NotApplicable);
    EXPECT_EQ(findings[0].facts["nodes"], 1);
    EXPECT_EQ(findings[0].facts["eye_trackers"], 0);
}

TEST(CheckHid, NamesTheTracker) {
    EmulatedTracker tracker(drivers::hid::first_layout());
    tracker.plug_in();
    tracker.send(std::vector<std::uint8_t>(65, 0x10));
    const Findings findings = check_hid(kBriefly);
    ASSERT_EQ(findings.size(), 2U);
    EXPECT_EQ(findings[0].verdict, Verdict::Ok);
    EXPECT_EQ(findings[0].facts["usable"], 1);
    EXPECT_EQ(findings[1].check, "hid.hidraw0");
    EXPECT_EQ(findings[1].verdict, Verdict::Ok) << findings[1].found;
    EXPECT_NE(findings[1].found.find(": 1 samples in "), std::string::npos) << findings[1].found;
    EXPECT_EQ(findings[1].facts["samples"], 1);
    EXPECT_EQ(findings[1].facts["id"], "1209:e7e7");
    EXPECT_EQ(findings[1].facts["name"], "Emulated Eye Tracker");
}

TEST(CheckHid, SaysThatATrackerSendsNothing) {
    EmulatedTracker tracker(drivers::hid::first_layout());
    tracker.plug_in();
    const Findings findings = check_hid(kBriefly);
    ASSERT_EQ(findings.size(), 2U);
    EXPECT_EQ(findings[0].facts["usable"], 1) << "it can be opened";
    EXPECT_EQ(findings[1].verdict, Verdict::Warning);
    EXPECT_EQ(findings[1].facts["reports"], 0);
    for (const char* part : {"opened, no report in ", "less than its descriptor declares"}) {
        EXPECT_NE(findings[1].found.find(part), std::string::npos) << findings[1].found;
    }
    EXPECT_NE(findings[1].remedy.find("dmesg"), std::string::npos) << findings[1].remedy;
    EXPECT_FALSE(findings[1].stops_loop);
}

TEST(CheckHid, SaysWhatATrackerDoesNotAnswer) {
    EmulatedTracker tracker(drivers::hid::first_layout());
    tracker.leave_unanswered(0x12, std::chrono::milliseconds(1200));
    tracker.plug_in();
    tracker.send(std::vector<std::uint8_t>(65, 0x10));
    const Findings findings = check_hid(kBriefly);
    ASSERT_EQ(findings.size(), 2U);
    EXPECT_EQ(findings[1].verdict, Verdict::Warning);
    EXPECT_NE(findings[1].found.find("no answer for feature reports 0x12"), std::string::npos)
        << findings[1].found;
    EXPECT_NE(findings[1].remedy.find("hid.screen_width_m"), std::string::npos);
    EXPECT_EQ(findings[1].facts["unanswered_feature_reports"], nlohmann::json({0x12}));
}

// A calibration would not help: its points have no direction without a screen and a distance.
TEST(CheckHid, SaysWhatGazeOnAScreenNeedsToHaveADirection) {
    EmulatedTracker tracker(drivers::hid::second_layout(false));
    tracker.plug_in();
    constexpr std::size_t kReportBytes = 1 + 3 + 8 + 2 * 4 + 3 * 4;
    std::vector<std::uint8_t> report(kReportBytes, 0x01);
    for (std::uint8_t time = 1; time < 9; ++time) {
        report[4] = time;
        tracker.send(report);
    }
    Findings findings = check_hid(kBriefly);
    ASSERT_EQ(findings.size(), 2U);
    EXPECT_GT(findings[1].facts["samples"], 0) << findings[1].found;
    EXPECT_EQ(findings[1].facts["samples_with_gaze"], 0);
    EXPECT_EQ(findings[1].verdict, Verdict::Warning) << findings[1].found;
    for (const char* const setting : {"hid.viewing_distance_m", "hid.screen_width_m"}) {
        EXPECT_NE(findings[1].remedy.find(setting), std::string::npos) << findings[1].remedy;
    }
    EXPECT_EQ(findings[1].remedy.find("calibrate"), std::string::npos) << findings[1].remedy;
}

TEST(CheckHid, SaysWhatATrackersDescriptorLacks) {
    EmulatedTracker tracker(blind_tracker().bytes());
    tracker.plug_in();
    const Findings findings = check_hid(kBriefly);
    ASSERT_EQ(findings.size(), 2U);
    EXPECT_EQ(findings[0].facts["usable"], 0);
    EXPECT_EQ(findings[1].verdict, Verdict::Failure);
    EXPECT_NE(findings[1].found.find("gaze point"), std::string::npos) << findings[1].found;
    EXPECT_FALSE(findings[1].remedy.empty());
    EXPECT_FALSE(findings[1].stops_loop);
}

// A tracker that may be read alone cannot be asked for gaze.
TEST(CheckHid, NamesTheRuleForATrackerThatMayNotBeOpened) {
#ifdef __SANITIZE_THREAD__
    GTEST_SKIP() << "the thread sanitizer cannot follow threads of a threaded program's fork";
#endif
    if (const std::string missing = tests::missing_for_nobody(); !missing.empty()) {
        GTEST_SKIP() << missing;
    }
    constexpr unsigned kReadOnly = 0444;
    EmulatedTracker tracker(drivers::hid::first_layout());
    tracker.plug_in();
    tracker.set_mode(kReadOnly);
    EXPECT_TRUE(tests::as_nobody([] {
        const Findings findings = check_hid(kBriefly);
        EXPECT_EQ(findings.size(), 2U);
        EXPECT_EQ(findings.at(1).verdict, Verdict::Failure);
        EXPECT_FALSE(findings.at(1).stops_loop);
        EXPECT_NE(findings.at(1).remedy.find("KERNELS==\"*:1209:E7E7.*\""), std::string::npos)
            << findings.at(1).remedy;
        return !testing::Test::HasFailure();
    }));
}

}  // namespace
}  // namespace gazeloop::doctor
