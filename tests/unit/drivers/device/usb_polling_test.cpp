#include "drivers/device/usb_polling.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "tests/support/temporary_folder.h"

namespace gazeloop::drivers {
namespace {

namespace fs = std::filesystem;

/// A USB device with one interface, as sysfs shows it.
class SysfsFolder : public testing::Test {
  protected:
    void SetUp() override { fs::create_directories(hidraw()); }

    [[nodiscard]] fs::path interface() const { return root_ / "usb1/1-1/1-1:1.2"; }
    [[nodiscard]] std::string hidraw() const {
        return interface() / "0003:2104:0127.0004/hidraw/hidraw3";
    }
    static void write(const fs::path& file, const std::string& text) {
        fs::create_directories(file.parent_path());
        std::ofstream(file) << text << '\n';
    }
    void add_endpoint(const std::string& name, const std::string& type,
                      const std::string& direction, const std::string& interval) const {
        write(interface() / "bInterfaceNumber", "02");
        write(interface() / name / "type", type);
        write(interface() / name / "direction", direction);
        write(interface() / name / "interval", interval);
    }

  private:
    tests::TemporaryFolder folder_;
    fs::path root_ = folder_.path();
};

TEST_F(SysfsFolder, GivesTheLongestIntervalOfWhatIsPolledForInput) {
    EXPECT_EQ(usb_polling_ns(hidraw()), kUsualPolling_ns) << "no interface";
    add_endpoint("ep_01", "Interrupt", "out", "16ms");
    add_endpoint("ep_82", "Bulk", "in", "0ms");
    EXPECT_EQ(usb_polling_ns(hidraw()), kUsualPolling_ns) << "none of input";
    add_endpoint("ep_83", "Interrupt", "in", "125us");
    EXPECT_EQ(usb_polling_ns(hidraw()), 125'000);
    add_endpoint("ep_84", "Interrupt", "in", "4ms");
    EXPECT_EQ(usb_polling_ns(hidraw()), 4'000'000);
}

TEST_F(SysfsFolder, IsNotTrustedWithNonsense) {
    for (const char* const interval :
         {"", "ms", "4", "4 ms", "-4ms", "4s", "99999999999999999999ms", "20000000ms", "0us"}) {
        add_endpoint("ep_81", "Interrupt", "in", interval);
        EXPECT_EQ(usb_polling_ns(hidraw()), kUsualPolling_ns) << interval;
    }
}

TEST(UsbPolling, IsNoneOfVirtualDevices) {
    EXPECT_EQ(usb_polling_ns("/sys/devices/virtual/misc/uhid/0003:1209:0001.0001/hidraw/hidraw0"),
              0);
    EXPECT_EQ(usb_polling_ns(""), kUsualPolling_ns);
}

}  // namespace
}  // namespace gazeloop::drivers
