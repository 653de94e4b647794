// The USB path on an emulated PlayStation VR2: found, claimed, asked, read, halted, pulled out.
#include <dlfcn.h>
#include <fmt/core.h>
#include <gtest/gtest.h>
#include <libusb.h>
#include <spdlog/sinks/ringbuffer_sink.h>
#include <spdlog/spdlog.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <functional>
#include <thread>

#include "drivers/device/last_words.h"
#include "drivers/psvr2/psvr2_source.h"
#include "runtime/time/clock.h"
#include "sim/psvr2_packet.h"
#include "tests/device/as_nobody.h"
#include "tests/device/emulated_psvr2.h"
#include "tests/device/thread_time.h"

namespace {

std::atomic<bool> g_no_memory{false};

}  // namespace

/// In the place of libusb's, which is called but where there is to be no memory.
extern "C" libusb_transfer* libusb_alloc_transfer(int packets) {
    const auto real =
        reinterpret_cast<libusb_transfer* (*)(int)>(dlsym(RTLD_NEXT, "libusb_alloc_transfer"));
    return g_no_memory ? nullptr : real(packets);
}

namespace gazeloop::drivers::psvr2 {
namespace {

using tests::EmulatedPsvr2;

/// Both eyes look 10 degrees to the right and a little down.
gaze::GazeSample looking_right() {
    gaze::GazeSample sample;
    for (const gaze::Eye eye : gaze::kEyes) {
        gaze::EyeRay& ray = sample.eyes[gaze::index(eye)];
        ray.valid = true;
        ray.openness = 1.0;
        ray.origin_m = {eye == gaze::Eye::Left ? -0.031 : 0.031, 0.0, 0.01};
        ray.direction = {0.17364818, -0.05, -0.98353770};
    }
    return sample;
}

bool contains(const std::vector<std::string>& lines, std::string_view part) {
    return std::ranges::any_of(
        lines, [&](const std::string& line) { return line.find(part) != std::string::npos; });
}

class Psvr2Device : public testing::Test {
  protected:
    void SetUp() override {
        headset_.emplace();
        ASSERT_TRUE(headset_->possible())
            << "run by ctest, which preloads libumockdev-preload.so.0";
    }

    /// Sends as many packets as the axes have to be looked at, and more.
    void send(std::uint32_t packets = 12) {
        for (std::uint32_t i = 0; i < packets; ++i) {
            ++frame_;
            headset_->send(
                sim::psvr2_packet(looking_right(), std::uint64_t{frame_} * 8333, frame_));
        }
    }

    /// Waits for as long as it may take on a busy machine, not for a time that is tested.
    void until(Psvr2Source& source, const std::function<bool()>& done) {
        for (int i = 0; i < 4000 && !done(); ++i) {
            std::this_thread::sleep_for(std::chrono::milliseconds(5));
            source.poll(0, samples_);
            for (SourceEvent& event : source.take_events()) {
                EXPECT_TRUE(event.time.known());
                EXPECT_LE(event.text.size(), 240U) << event.text;
                gone_ns_ = event.text.starts_with("gone: ") ? event.time.ns : gone_ns_;
                events_.push_back(std::move(event.text));
            }
        }
        ASSERT_TRUE(done()) << testing::PrintToString(events_);
    }
    void until_event(Psvr2Source& source, std::string_view part) {
        until(source, [&] { return contains(events_, part); });
    }
    [[nodiscard]] bool tracking() const {
        return !samples_.empty() && samples_.back().eyes[0].valid && samples_.back().eyes[1].valid;
    }

    /// The loss was told as one sample, before it was known why: not after the half second in which
    /// a headset that fails may turn out to have been pulled out.
    void expect_loss_before_its_reason() const {
        constexpr std::int64_t kHalfASecond_ns = 500'000'000;
        ASSERT_FALSE(samples_.empty());
        const gaze::GazeSample& loss = samples_.back();
        EXPECT_FALSE(loss.eyes[0].valid || loss.eyes[1].valid);
        EXPECT_GE(gone_ns_ - loss.arrived.ns, kHalfASecond_ns);
        ASSERT_GT(samples_.size(), 1U);
        EXPECT_TRUE(samples_[samples_.size() - 2].eyes[0].valid);
    }

    std::optional<EmulatedPsvr2> headset_;
    std::uint32_t frame_ = 0;
    std::int64_t gone_ns_ = 0;  ///< when a headset was last told to have gone
    std::vector<gaze::GazeSample> samples_;
    std::vector<std::string> events_;
};

TEST_F(Psvr2Device, IsFoundOnUsb) {
    EXPECT_TRUE(find_headsets().empty());
    headset_->plug_in();
    const std::vector<FoundDevice> found = find_headsets();
    ASSERT_EQ(found.size(), 1U);
    EXPECT_EQ(found[0].text(), "PlayStation VR2 (054c:0cde) at /dev/bus/usb/001/002");
    EXPECT_FALSE(found[0].access_problem.has_value());
    headset_->unplug();
    EXPECT_TRUE(find_headsets().empty());
}

TEST_F(Psvr2Device, IsClaimedAskedReadAndLeftAsItWas) {
    headset_->plug_in();
    {
        Psvr2Source source({.delay = {4'000'000, 1'000'000}});
        until_event(source, "plugged in: PlayStation VR2");
        until_event(source, "not tried on hardware");
        until(source, [&] { return headset_->seen().starts > 0; });
        EXPECT_EQ(headset_->seen().claimed, std::vector<unsigned>{5});
        EXPECT_EQ(headset_->seen().endpoints, std::vector<int>(4, 0x85)) << "several under way";
        send();
        until(source, [&] { return samples_.size() >= 12; });
        EXPECT_TRUE(tracking());
        const gaze::GazeSample& last = samples_.back();
        EXPECT_NEAR(last.eyes[0].direction.x, 0.17364818, 1e-6) << "to the right";
        EXPECT_NEAR(last.eyes[0].direction.y, -0.05, 1e-6) << "down";
        EXPECT_LT(last.eyes[0].direction.z, -0.9) << "forward";
        EXPECT_LT(last.eyes[0].origin_m.x, last.eyes[1].origin_m.x);
        EXPECT_EQ(last.device_ns, 12 * 8'333'000LL);
        EXPECT_EQ(last.sequence, samples_.front().sequence + 11);
        EXPECT_EQ(last.arrived.kind, time::StampKind::Measured);
        until_event(source, "axes: as published");
        EXPECT_EQ(headset_->seen().others, 0);
    }
    EXPECT_EQ(headset_->seen().stops, 1);
    EXPECT_EQ(headset_->seen().releases, 1);
    EXPECT_EQ(headset_->seen().listening, 0U);
}

TEST_F(Psvr2Device, RefusesWhatIsNoPacketAndReadsOn) {
    headset_->plug_in();
    Psvr2Source source({});
    until_event(source, "plugged in");
    send(2);
    const auto packet = sim::psvr2_packet(looking_right(), 1, 1);
    std::vector<std::uint8_t> two(packet.begin(), packet.end());
    two.insert(two.end(), packet.begin(), packet.end());
    headset_->send(std::span(packet).first(100));
    headset_->send(two);
    headset_->send(std::vector<std::uint8_t>(5000, 'G'));  // more than a transfer takes
    headset_->send({});
    send(10);
    until(source, [&] { return samples_.size() >= 12; });
    EXPECT_TRUE(tracking());
    EXPECT_EQ(samples_.size(), 12U);
    EXPECT_TRUE(contains(events_, "no gaze packet"));
    EXPECT_EQ(headset_->seen().claims, 1) << "none of it is a reason to begin anew";
}

TEST_F(Psvr2Device, IsAskedAgainWhileItIsSilent) {
    headset_->plug_in();
    Psvr2Source source({});
    until_event(source, "plugged in");
    send();
    until(source, [&] { return tracking(); });
    const int asked = headset_->seen().starts;
    until_event(source, "silent for half a second");
    until(source, [&] { return headset_->seen().starts >= asked + 2; });
    send();
    until_event(source, "sends again");
    EXPECT_EQ(headset_->seen().claims, 1);
}

TEST_F(Psvr2Device, GoesOnAfterAHaltedEndpoint) {
    headset_->plug_in();
    Psvr2Source source({});
    until_event(source, "plugged in");
    send();
    until(source, [&] { return samples_.size() >= 12; });
    for (int round = 1; round <= 3; ++round) {
        const int asked = headset_->seen().starts;
        const std::size_t seen = headset_->seen().order.size();
        samples_.clear();
        events_.clear();
        headset_->halt();
        until_event(source, "halted: cleared, and asked for gaze again");
        EXPECT_EQ(headset_->seen().halts_cleared, round);
        until(source, [&] { return headset_->seen().starts > asked; });
        EXPECT_NE(headset_->seen().order.find("HS", seen), std::string::npos)
            << "asked at once: " << headset_->seen().order;
        send();
        until(source, [&] { return samples_.size() >= 13; });
        EXPECT_FALSE(samples_[0].eyes[0].valid || samples_[0].eyes[1].valid) << "lost in between";
        EXPECT_TRUE(samples_[1].eyes[0].valid && samples_[1].eyes[1].valid) << "and no longer";
        EXPECT_TRUE(tracking());
        for (std::size_t i = 0; i < samples_.size(); ++i) {
            EXPECT_EQ(samples_[i].sequence, static_cast<std::uint64_t>(round) * 13 + i)
                << "nothing lost, nothing twice";
        }
    }
    EXPECT_EQ(headset_->seen().claims, 1);
    until(source, [&] { return headset_->seen().listening == 4; });
}

// What a headset that is pulled out does first: all fails, and then it has gone.
TEST_F(Psvr2Device, IsToldAsUnpluggedEvenWhereClearingItsEndpointFailedFirst) {
    headset_->plug_in();
    Psvr2Source source({});
    until_event(source, "plugged in");
    send();
    until(source, [&] { return tracking(); });
    headset_->set_fault(EmulatedPsvr2::Fault::PulledOut);
    headset_->halt();
    until_event(source, "gone: ");
    EXPECT_TRUE(contains(events_, "gone: " + headset_->node() + ": unplugged"))
        << testing::PrintToString(events_);
    EXPECT_FALSE(contains(events_, "cleared")) << testing::PrintToString(events_);
}

TEST_F(Psvr2Device, ThatStaysAndFailsIsToldAsFailing) {
    headset_->plug_in();
    Psvr2Source source({});
    until_event(source, "plugged in");
    send();
    until(source, [&] { return tracking(); });
    headset_->set_fault(EmulatedPsvr2::Fault::HaltStays);
    headset_->halt();
    until_event(source, "gone: " + headset_->node() + ": clearing its halted endpoint failed");
    EXPECT_FALSE(contains(events_, "halted: cleared")) << testing::PrintToString(events_);
    expect_loss_before_its_reason();
}

TEST_F(Psvr2Device, ThatDoesNotTakeTheRequestIsHeardNevertheless) {
    headset_->plug_in();
    headset_->set_fault(EmulatedPsvr2::Fault::RequestStalls);
    Psvr2Source source({});
    until_event(source, "does not take the request");
    send();
    until(source, [&] { return tracking(); });
}

TEST_F(Psvr2Device, ComesLateGoesAndComesBack) {
    Psvr2Source source({});
    until_event(source, "no PlayStation VR2 is plugged in");
    for (int round = 1; round <= 3; ++round) {
        headset_->plug_in();
        until_event(source, "plugged in: PlayStation VR2 (054c:0cde) at " + headset_->node());
        send();
        until(source, [&] { return tracking(); });
        headset_->unplug();
        until_event(source, "gone: " + headset_->node() + ": unplugged");
        ASSERT_FALSE(samples_.back().eyes[0].valid || samples_.back().eyes[1].valid)
            << "the loss is a sample, so that the loop need not wait until the gaze is stale";
        samples_.clear();
        events_.clear();
    }
}

/// What is logged while this lives.
class Log {
  public:
    Log() : before_(spdlog::default_logger()) {
        spdlog::set_default_logger(std::make_shared<spdlog::logger>("test", lines_));
        set_last_words([](std::string_view line) noexcept { spdlog::warn("{}", line); });
    }
    Log(const Log&) = delete;
    Log& operator=(const Log&) = delete;
    ~Log() {
        set_last_words(nullptr);
        spdlog::set_default_logger(before_);
    }
    [[nodiscard]] std::string text() const {
        std::string text;
        for (const std::string& line : lines_->last_formatted()) {
            text += line;
        }
        return text;
    }

  private:
    std::shared_ptr<spdlog::logger> before_;
    std::shared_ptr<spdlog::sinks::ringbuffer_sink_mt> lines_ =
        std::make_shared<spdlog::sinks::ringbuffer_sink_mt>(100);
};

TEST_F(Psvr2Device, ThatCannotBeWaitedForIsGoneAndOpenedAgain) {
    const Log log;
    headset_->plug_in();
    Psvr2Source source({});
    send();
    until(source, [&] { return tracking(); });
    headset_->set_fault(EmulatedPsvr2::Fault::EventsFail);
    until_event(source, "gone: " + headset_->node() + ": waiting for its data failed: ");
    expect_loss_before_its_reason();
    // Told before it is closed; mended earlier, its transfers would end.
    until(source, [&] {
        return log.text().find("of its transfers do not end: left") != std::string::npos;
    });
    events_.clear();
    samples_.clear();
    headset_->set_fault(EmulatedPsvr2::Fault::None);
    until_event(source, "plugged in");
    send();
    until(source, [&] { return tracking(); });
}

// Whatever the device does, the program ends.
TEST_F(Psvr2Device, WhoseTransfersDoNotEndIsLeft) {
    const Log log;
    headset_->plug_in();
    {
        Psvr2Source source({});
        send();
        until(source, [&] { return tracking() && headset_->seen().listening == 4; });
        headset_->set_fault(EmulatedPsvr2::Fault::NothingEnds);
    }
    EXPECT_NE(log.text().find("4 of its transfers do not end: left, and the device closed"),
              std::string::npos)
        << log.text();
    EXPECT_EQ(headset_->seen().releases, 1);
}

TEST_F(Psvr2Device, WithoutMemoryForTransfersIsTriedAgain) {
    headset_->plug_in();
    g_no_memory = true;
    Psvr2Source source({});
    until_event(source, "reading the tracker failed: ");
    EXPECT_FALSE(contains(events_, "plugged in"));
    g_no_memory = false;
    until_event(source, "plugged in");
    send();
    until(source, [&] { return tracking(); });
}

TEST_F(Psvr2Device, SaysWhoHasItAndGoesOnOnceItIsFree) {
    headset_->plug_in();
    headset_->set_fault(EmulatedPsvr2::Fault::ClaimedElsewhere);
    Psvr2Source source({});
    until_event(source, "another program uses its gaze interface (5): close it");
    headset_->set_fault(EmulatedPsvr2::Fault::KernelDriver);
    until_event(source, "a kernel driver has its gaze interface (5): unload that driver");
    EXPECT_EQ(headset_->seen().claims, 0);
    headset_->set_fault(EmulatedPsvr2::Fault::None);
    until_event(source, "plugged in: PlayStation VR2");
    send();
    until(source, [&] { return tracking(); });
}

// Nothing is lost or turned round; what it takes is printed, and an upper bound, because every
// transfer goes through umockdev's own thread.
TEST_F(Psvr2Device, KeepsUpWithAThousandPacketsASecond) {
    constexpr std::uint32_t kPackets = 3000;
    headset_->plug_in();
    Psvr2Source source({});
    until_event(source, "plugged in");
    const double cpu_before_s = tests::thread_seconds("gaze-psvr2");
    const std::int64_t start_ns = time::monotonic_ns();
    std::thread sender([&] {
        for (std::uint32_t i = 0; i < kPackets; ++i) {
            time::sleep_until_ns(start_ns + i * 1'000'000LL);
            headset_->send(sim::psvr2_packet(looking_right(), std::uint64_t{i} * 1000, i));
        }
    });
    until(source, [&] { return samples_.size() >= kPackets; });
    sender.join();
    const double seconds = static_cast<double>(time::monotonic_ns() - start_ns) * 1e-9;
    ASSERT_EQ(samples_.size(), kPackets);
    for (std::uint32_t i = 0; i < kPackets; ++i) {
        EXPECT_EQ(samples_[i].device_ns, i * 1'000'000LL);
        EXPECT_EQ(samples_[i].sequence, samples_[0].sequence + i);
    }
    EXPECT_EQ(source.dropped(), 0U);
    fmt::print("reader {:.2f} % of a core at 1000 packets a second\n",
               100.0 * (tests::thread_seconds("gaze-psvr2") - cpu_before_s) / seconds);
}

TEST_F(Psvr2Device, SaysThatItMayNotBeOpenedAndWhatCuresIt) {
    if (const std::string missing = tests::missing_for_nobody(); !missing.empty()) {
        GTEST_SKIP() << missing;
    }
    headset_->plug_in();
    headset_->set_mode(0);
    EXPECT_TRUE(tests::as_nobody([] {
        const std::vector<FoundDevice> found = find_headsets();
        EXPECT_EQ(found.size(), 1U);
        EXPECT_NE(found.at(0).access_problem.value_or("").find("permission denied"),
                  std::string::npos);
        EXPECT_EQ(found.at(0).missing_rule,
                  R"(SUBSYSTEM=="usb", ATTR{idVendor}=="054c", ATTR{idProduct}=="0cde", )"
                  R"(TAG+="uaccess")");
        const auto opened = open_headset(found.at(0), {});
        EXPECT_TRUE(!opened && opened.error().kind == ErrorKind::NoDevice &&
                    opened.error().message == found.at(0).access_problem);
        return !testing::Test::HasFailure();
    }));
}

}  // namespace
}  // namespace gazeloop::drivers::psvr2
