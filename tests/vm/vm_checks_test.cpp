// What gazeloop does with devices on a real Linux kernel, as the virtual machine's sections tell
// it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>

#include "runtime/session/session_file.h"
#include "sim/virtual_tracker.h"
#include "tests/support/temporary_folder.h"
#include "tests/vm/machine.h"

namespace gazeloop::tests {
namespace {

class InMachine : public testing::Test {
  protected:
    void SetUp() override {
        if (const std::string reason = machine_skipped(); !reason.empty()) {
            GTEST_SKIP() << reason;
        }
        sections_ = machine_sections();
    }

    /// A section that must be there.
    const Section& section(const std::string& name) { return sections_.at(name); }

    nlohmann::json only_device(const std::string& name) {
        const auto all = nlohmann::json::parse(section(name).text);
        EXPECT_EQ(section(name).exit_code, 0);
        nlohmann::json list = nlohmann::json::array();
        std::ranges::copy_if(all, std::back_inserter(list),
                             [](const auto& row) { return row["source"] != "openxr"; });
        EXPECT_EQ(list.size(), 1U) << list.dump(2);
        return list.at(0);
    }

    /// How many reports a device of ours says the host has taken.
    std::uint64_t sent(const std::string& name) {
        const std::string& text = section(name).text;
        const auto at = text.find(" reports sent");
        EXPECT_NE(at, std::string::npos) << text;
        const auto begin = text.find_last_not_of("0123456789", at - 1) + 1;
        return std::strtoull(text.c_str() + begin, nullptr, 10);
    }

    /// Every report but those that were on their way when the program stopped listening.
    void expect_none_lost(const nlohmann::json& device, std::uint64_t reports) {
        constexpr std::uint64_t kOnTheirWay = 30;
        const auto samples = device["samples"].get<std::uint64_t>();
        EXPECT_EQ(device["samples_lost"], 0) << device.dump(2);
        EXPECT_LE(samples, reports);
        EXPECT_GE(samples + kOnTheirWay, reports) << device.dump(2);
    }

    void expect_virtual_tracker(const nlohmann::json& device) {
        EXPECT_EQ(device["vendor"], "1209");
        EXPECT_EQ(device["product"], "e7e7");
        EXPECT_TRUE(device["accessible"]);
        EXPECT_FALSE(device["tried_on_hardware"]);
        EXPECT_EQ(device["status"], "ready");
        EXPECT_EQ(device["stated_hz"], 120);
        EXPECT_DOUBLE_EQ(device["screen_width_m"], sim::kVirtualScreenWidth_m);
        EXPECT_DOUBLE_EQ(device["screen_height_m"], sim::kVirtualScreenHeight_m);
        EXPECT_GT(device["samples_with_gaze"], 0);
        EXPECT_TRUE(device["problems"].empty()) << device.dump(2);
        // What the clock is worth depends on how busy the emulation was, but it is one.
        ASSERT_TRUE(device["clock"].is_object()) << device.dump(2);
        EXPECT_NE(device["clock"]["verdict"], "unusable") << device.dump(2);
    }

    static std::size_t times(const std::string& text, std::string_view part) {
        std::size_t count = 0;
        for (auto at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) {
            ++count;
        }
        return count;
    }

    std::map<std::string, Section> sections_;
};

TEST_F(InMachine, UhidTrackerIsFoundAndRead) {
    const auto device = only_device("uhid-devices");
    EXPECT_EQ(device["path"], "/dev/hidraw0");
    EXPECT_EQ(device["name"], "gazeloop virtual eye tracker");
    expect_virtual_tracker(device);
    EXPECT_GT(device["optimum_distance_m"], device["minimum_distance_m"]);
    EXPECT_LT(device["optimum_distance_m"], device["maximum_distance_m"]);
    expect_none_lost(device, sent("uhid-tracker"));
}

TEST_F(InMachine, AUserWithoutPermissionIsShownTheRule) {
    const Section& seen = section("uhid-user");
    EXPECT_EQ(seen.exit_code, 4) << seen.text;
    EXPECT_NE(seen.text.find("/dev/hidraw0 may not be opened"), std::string::npos) << seen.text;
    EXPECT_NE(seen.text.find("KERNELS==\"*:1209:E7E7.*\", TAG+=\"uaccess\""), std::string::npos)
        << seen.text;
}

TEST_F(InMachine, TheRuleThatIsShownAndThoseThatAreShippedGiveAccess) {
    for (const char* name : {"rule-shown", "rule-shipped-hid", "rule-shipped-usb"}) {
        EXPECT_NE(section(name).text.find("TAGS=:uaccess:"), std::string::npos)
            << name << ": " << section(name).text;
    }
}

TEST_F(InMachine, UsbTrackerWhoseReportsSpanPacketsIsRead) {
    const auto device = only_device("usb-devices");
    expect_virtual_tracker(device);
    expect_none_lost(device, sent("usb-tracker"));
}

TEST_F(InMachine, Psvr2IsFoundAskedAndRead) {
    const auto device = only_device("psvr2-devices");
    EXPECT_EQ(device["source"], "psvr2");
    EXPECT_EQ(device["vendor"], "054c");
    EXPECT_EQ(device["product"], "0cde");
    EXPECT_TRUE(device["accessible"]);
    EXPECT_FALSE(device["tried_on_hardware"]);
    EXPECT_GT(device["samples_with_gaze"], 0);
    EXPECT_TRUE(device["clock"].is_object()) << device.dump(2);
    EXPECT_TRUE(device["problems"].empty()) << device.dump(2);
    expect_none_lost(device, sent("psvr2-sent"));
}

TEST_F(InMachine, Psvr2MayComeAndGo) {
    const std::string& text = section("psvr2-watch").text;
    EXPECT_EQ(times(text, "plugged in: PlayStation"), 2U) << text;
    EXPECT_EQ(times(text, "gone: "), 2U) << text;
    EXPECT_EQ(text.find("gave up"), std::string::npos) << text;
    // Each time it was asked, and gave gaze: a line that begins with an angle.
    std::size_t at = 0;
    for (int round = 1; round <= 2; ++round) {
        at = text.find("plugged in: PlayStation", at);
        const std::size_t gone = text.find("gone: ", at);
        ASSERT_NE(gone, std::string::npos) << text;
        EXPECT_THAT(text.substr(at, gone - at),
                    testing::ContainsRegex("\n *[-+][0-9]+\\.[0-9]+ +[-+][0-9]"));
        at = gone;
    }
}

TEST_F(InMachine, TheLoopRunsOnThroughUnpluggingAndPluggingIn) {
    const std::string& text = section("loop").text;
    EXPECT_NE(text.find("exit code 130"), std::string::npos) << text;
    const TemporaryFolder folder;
    const auto encoded = folder / "session.base64";
    const auto recorded = folder / "session.gaze";
    std::ofstream(encoded) << section("loop-session").text;
    ASSERT_EQ(std::system(("base64 -d " + encoded.string() + " >" + recorded.string()).c_str()), 0);
    const session::SessionFile session = value_or_throw(session::read_session(recorded));
    EXPECT_TRUE(session.closed_cleanly);

    std::vector<std::pair<std::string, std::int64_t>> changes;
    for (const auto& event : session.events) {
        for (const char* kind : {"plugged in", "gone"}) {
            if (event.kind == "tracker" && event.text.starts_with(kind)) {
                changes.emplace_back(kind, event.time.ns);
            }
        }
    }
    ASSERT_EQ(changes.size(), 4U) << text;
    for (std::size_t i = 0; i < changes.size(); ++i) {
        EXPECT_EQ(changes[i].first, i % 2 == 0 ? "plugged in" : "gone");
        // The loop went on, and the change had come to it by the second frame at the latest: the
        // first may have read the gaze in the moment between the change and its being handed over.
        const std::int64_t until_ns = i + 1 < changes.size() ? changes[i + 1].second : INT64_MAX;
        std::size_t frames = 0;
        std::size_t tracked = 0;
        for (const auto& shown : session.frames) {
            const std::int64_t latch_ns = shown.frame.stamps.latch.ns;
            if (latch_ns > changes[i].second && latch_ns < until_ns && ++frames > 1) {
                tracked += shown.frame.fovea.eyes[0].state == gaze::FoveaState::Tracking ? 1 : 0;
            }
        }
        EXPECT_GT(frames, 1U) << "change " << i << ": " << changes[i].first;
        EXPECT_EQ(tracked > 0, changes[i].first == "plugged in")
            << "change " << i << ": " << changes[i].first << ", tracked in " << tracked << " of "
            << frames << " frames";
    }
}

TEST_F(InMachine, TheKernelReadsReportDescriptorsAsWeDo) {
    const Section& compared = section("kernel-parser");
    EXPECT_EQ(compared.exit_code, 0) << compared.text;
    EXPECT_NE(compared.text.find(" descriptors read as expected"), std::string::npos)
        << compared.text;
}

}  // namespace
}  // namespace gazeloop::tests
