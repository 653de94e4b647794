#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>
#include <string>
#include <string_view>

#include "runtime/doctor/checks.h"
#include "tests/support/temporary_folder.h"

namespace gazeloop::doctor {
namespace {

using namespace std::string_view_literals;

// Usage page 0x12, usage 1, application collection, end.
constexpr std::string_view kEyeTracker = "\x05\x12\x09\x01\xA1\x01\xC0"sv;
constexpr std::string_view kMouse = "\x05\x01\x09\x02\xA1\x01\xC0"sv;

class CheckHid : public testing::Test {
  protected:
    void add_node(const std::string& name, std::string_view descriptor, const std::string& id) {
        const auto device = root_ / "sys/class/hidraw" / name / "device";
        std::filesystem::create_directories(device);
        std::filesystem::create_directories(root_ / "dev");
        std::ofstream(device / "report_descriptor", std::ios::binary) << descriptor;
        std::ofstream(device / "uevent")
            << "DRIVER=hid-generic\nHID_ID=" << id << "\nHID_NAME=ACME Gazer\n";
        std::ofstream(root_ / "dev" / name) << "";
    }

    tests::TemporaryFolder folder_;
    std::filesystem::path root_ = folder_.path();
};

TEST_F(CheckHid, FindsNothingWhereThereIsNothing) {
    const Findings findings = check_hid(root_);
    ASSERT_EQ(findings.size(), 1U);
    EXPECT_EQ(findings[0].verdict, Verdict::NotApplicable);
}

TEST_F(CheckHid, TellsTrackersFromOtherDevices) {
    add_node("hidraw0", kMouse, "0003:0000046D:0000C077");
    add_node("hidraw1", kEyeTracker, "0003:00002104:00000127");
    add_node("hidraw2", kEyeTracker.substr(0, 6), "0003:00002104:00000128");  // cut off
    const Findings findings = check_hid(root_);
    ASSERT_EQ(findings.size(), 2U);
    EXPECT_EQ(findings[0].facts["nodes"], 3);
    EXPECT_EQ(findings[0].facts["eye_trackers"], 1);
    EXPECT_EQ(findings[1].check, "hid.hidraw1");
    EXPECT_EQ(findings[1].verdict, Verdict::Ok);
    EXPECT_EQ(findings[1].facts["id"], "2104:0127");
    EXPECT_EQ(findings[1].facts["name"], "ACME Gazer");
}

// A tracker that may be read alone cannot be asked for gaze.
TEST_F(CheckHid, NamesTheRuleForATrackerThatMayNotBeOpened) {
    add_node("hidraw3", kEyeTracker, "0003:00002104:00000127");
    std::filesystem::permissions(root_ / "dev/hidraw3", std::filesystem::perms::others_read);
    std::filesystem::permissions(root_, std::filesystem::perms::all);
    // Root may read anything: look with another user's eyes.
    const bool root = geteuid() == 0;
    if (root) {
        ASSERT_EQ(seteuid(65534), 0);
    }
    const Findings findings = check_hid(root_);
    if (root) {
        ASSERT_EQ(seteuid(0), 0);
    }
    ASSERT_EQ(findings.size(), 2U);
    EXPECT_EQ(findings[1].verdict, Verdict::Failure);
    EXPECT_FALSE(findings[1].stops_loop);
    EXPECT_NE(findings[1].remedy.find("KERNELS==\"*:2104:0127.*\""), std::string::npos)
        << findings[1].remedy;
}

}  // namespace
}  // namespace gazeloop::doctor
