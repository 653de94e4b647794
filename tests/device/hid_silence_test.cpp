// HID eye trackers that send nothing, and those that leave requests unanswered.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>

#include "runtime/time/clock.h"
#include "tests/device/hid_device_fixture.h"

namespace gazeloop::drivers::hid {
namespace {

using std::chrono::milliseconds;

std::ptrdiff_t count(const std::vector<std::string>& lines, std::string_view part) {
    return std::ranges::count_if(
        lines, [&](const std::string& line) { return line.find(part) != std::string::npos; });
}

// Reports that are shorter than declared never reach hidraw on some kernels: to us that is silence.
TEST_F(HidDevice, ThatSendsNothingIsToldSoOnce) {
    tracker_->plug_in();
    HidSource source({});
    until_event(source, "plugged in");
    const std::int64_t begin_ns = time::monotonic_ns();
    until_event(source, "opened, no report in 5");
    EXPECT_GE(time::monotonic_ns() - begin_ns, 4'000'000'000);
    for (const char* part : {"not worn", "be off", "calibration", "less than its descriptor"}) {
        EXPECT_TRUE(contains(events_, part)) << part;
    }
    const std::int64_t told_ns = time::monotonic_ns();
    until(source, [&] { return time::monotonic_ns() - told_ns > 1'000'000'000; });
    tracker_->send(report_at(1000));
    until(source, [&] { return !samples_.empty() && samples_.back().eyes[0].valid; });
    EXPECT_EQ(count(events_, "no report in"), 1);
}

TEST_F(HidDevice, ThatSendsItsStatusAloneIsToldToGiveNoGaze) {
    tracker_->plug_in();
    HidSource source({});
    until_event(source, "plugged in");
    tracker_->send(std::vector<std::uint8_t>{0x13, 1, 120, 0});
    until_event(source, "opened, 1 reports in 5");
    EXPECT_EQ(count(events_, "none of gaze"), 1);
    EXPECT_EQ(count(events_, "no report in"), 0);
}

TEST_F(HidDevice, ThatSendsIsNotToldToBeSilent) {
    tracker_->plug_in();
    HidSource source({});
    until_event(source, "plugged in");
    tracker_->send(report_at(1000));
    const std::int64_t begin_ns = time::monotonic_ns();
    until(source, [&] { return time::monotonic_ns() - begin_ns > 5'500'000'000; });
    EXPECT_EQ(count(events_, "opened, "), 0) << testing::PrintToString(events_);
}

// Its gaze is there long before the kernel has given up.
TEST_F(HidDevice, IsReadWhileItLeavesARequestUnanswered) {
    tracker_->leave_unanswered(0x12, milliseconds(4000));
    tracker_->plug_in();
    HidSource source({});
    const std::int64_t begin_ns = time::monotonic_ns();
    until_event(source, "plugged in");
    tracker_->send(report_at(1000));
    until(source, [&] { return !samples_.empty() && samples_.back().eyes[0].valid; });
    EXPECT_LT(time::monotonic_ns() - begin_ns, 3'500'000'000);
    EXPECT_EQ(count(events_, "no answer"), 0);
    until_event(source, "feature report 0x12: no answer in ");
    until_event(source, "states 120 Hz");  // that was asked after it
    until(source, [&] { return tracker_->asked() == 3; });
    EXPECT_EQ(tracker_->sent(0x14), (std::vector<std::uint8_t>{0x14, 3}));
}

// Two requests are given the time, whatever else there is to ask.
TEST_F(HidDevice, ThatAnswersNothingIsAskedForLittle) {
    for (const std::uint8_t id : std::initializer_list<std::uint8_t>{0x11, 0x12, 0x13, 0x14}) {
        tracker_->leave_unanswered(id, milliseconds(1200));
    }
    tracker_->plug_in();
    auto session = TrackerSession::open(find_trackers().at(0), {}, never);
    ASSERT_TRUE(session.has_value()) << session.error().message;
    EXPECT_TRUE(session->asking());
    std::vector<std::string> told = session->remarks();
    DeviceFeed feed;
    for (int i = 0; i < 10'000 && session->asking(); ++i) {
        ASSERT_TRUE(session->read(milliseconds(5), feed).has_value());
    }
    for (SourceEvent& event : feed.take_events()) {
        told.push_back(std::move(event.text));
    }
    for (std::string& line : told) {  // a busy machine may take longer
        const std::size_t from = line.find(" in ") + 4;
        const std::size_t end = line.find_first_not_of("0123456789", from);
        if (from >= 4 && end != from && end == line.find(" s", from)) {
            line.replace(from, end - from, "N");
        }
    }
    EXPECT_EQ(told,
              (std::vector<std::string>{
                  "request to start, feature report 0x14: no answer in N s; going on without",
                  "feature report 0x12: no answer in N s; going on without",
                  "feature report 0x13: not asked for, as 2 requests before it got no answer; "
                  "going on without",
                  "feature report 0x11: not asked for, as 2 requests before it got no answer; "
                  "going on without"}));
    EXPECT_EQ(session->facts().unanswered_reports, (std::vector<std::uint8_t>{0x12, 0x13, 0x11}));
    EXPECT_EQ(tracker_->asked(), 1);
    tracker_->send(report_at(1000));
    std::vector<gaze::GazeSample> samples;
    ASSERT_TRUE(session->read(milliseconds(1000), feed).has_value());
    feed.poll(samples);
    ASSERT_EQ(samples.size(), 1U);
    EXPECT_TRUE(samples[0].eyes[0].valid);
    const std::int64_t begin_ns = time::monotonic_ns();
    {
        const TrackerSession last = std::move(*session);
    }
    EXPECT_LT(time::monotonic_ns() - begin_ns, 1'100'000'000) << "not asked to stop either";
}

TEST_F(HidDevice, IsListenedToUntilItIsClearWhatItAnswers) {
    tracker_->leave_unanswered(0x12, milliseconds(2000));
    tracker_->plug_in();
    const std::vector<FoundTracker> found = find_trackers();
    // Twice the same one: what is listened to at once takes no longer than one.
    const std::int64_t begin_ns = time::monotonic_ns();
    const auto probes =
        probe_trackers({found.at(0), found.at(0)}, HidOptions{}, milliseconds(100), never);
    EXPECT_LT(time::monotonic_ns() - begin_ns, 3'900'000'000);
    ASSERT_EQ(probes.size(), 2U);
    for (const TrackerProbe& probe : probes) {
        EXPECT_FALSE(probe.problem.has_value()) << *probe.problem;
        EXPECT_TRUE(contains(probe.remarks, "feature report 0x12: no answer in "));
        EXPECT_EQ(probe.facts.unanswered_reports, std::vector<std::uint8_t>{0x12});
        EXPECT_EQ(probe.facts.status, "ready");
        EXPECT_NE(probe.silence.value_or("").find("no report in"), std::string::npos);
    }
}

}  // namespace
}  // namespace gazeloop::drivers::hid
