// A HID eye tracker, emulated by umockdev, in the first of the published layouts.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cstring>
#include <functional>
#include <thread>

#include "drivers/hid/hid_source.h"
#include "tests/device/emulated_tracker.h"
#include "tests/unit/drivers/hid/descriptor_items.h"

namespace gazeloop::drivers::hid {

using tests::EmulatedTracker;
/// Report 0x10 of the first layout, at `time_us`: both eyes 600 mm before the middle of a screen.
inline std::vector<std::uint8_t> report_at(std::uint64_t time_us,
                                           std::int32_t gaze_x_um = 200'000) {
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

inline bool contains(const std::vector<std::string>& lines, std::string_view part) {
    return std::ranges::any_of(
        lines, [&](const std::string& line) { return line.find(part) != std::string::npos; });
}

inline bool never() { return false; }

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

}  // namespace gazeloop::drivers::hid
