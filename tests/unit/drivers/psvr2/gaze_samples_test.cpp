#include "drivers/psvr2/gaze_samples.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "drivers/psvr2/stream_keeper.h"
#include "tests/support/allocation_counter.h"
#include "tests/unit/drivers/psvr2/packet_bytes.h"

namespace gazeloop::drivers::psvr2 {
namespace {

using tests::good_packet;
using tests::PacketBytes;

constexpr std::int64_t kMs = 1'000'000;
constexpr TrackerDelay kDelay{.least_ns = 5 * kMs, .uncertainty_ns = 2 * kMs};

std::vector<std::string> changes(GazeSamples& samples) {
    std::vector<std::string> lines;
    while (auto line = samples.take_change()) {
        lines.push_back(std::move(*line));
    }
    return lines;
}

TEST(Psvr2Samples, AreInTheHeadsAxesAndHaveTimes) {
    GazeSamples samples(kDelay);
    std::optional<gaze::GazeSample> last;
    for (int i = 0; i < 600; ++i) {
        const std::int64_t taken_ns = i * 8'333'000LL;
        const std::int64_t arrived_ns = taken_ns + 3 * kMs + (i % 5 == 4 ? 2 * kMs : 0);
        last = samples.take(good_packet(taken_ns / 1000 + 1, static_cast<std::uint32_t>(i)).bytes,
                            arrived_ns);
        ASSERT_TRUE(last.has_value());
        EXPECT_EQ(last->eyes[0].valid, i >= 7);
        EXPECT_EQ(samples.lost_before_last(), 0U);
    }
    EXPECT_NEAR(last->eyes[0].direction.x, -0.28, 1e-6) << "to the left";
    EXPECT_NEAR(last->eyes[0].direction.z, -0.96, 1e-6) << "forward";
    EXPECT_NEAR(last->eyes[0].origin_m.x, -0.031, 1e-9);
    EXPECT_NEAR(last->eyes[1].origin_m.x, 0.032, 1e-9);
    EXPECT_NEAR(last->eyes[1].origin_m.y, 0.0015, 1e-9);
    EXPECT_EQ(last->eyes[0].openness, 1.0);
    ASSERT_TRUE(last->sampled.known());
    EXPECT_EQ(last->sampled.kind, time::StampKind::Profile);
    EXPECT_EQ(last->ready.ns - last->sampled.ns, 5 * kMs);
    const auto lines = changes(samples);
    ASSERT_EQ(lines.size(), 3U);
    EXPECT_EQ(lines[0], "packets of version 3, user calibration 51966");
    EXPECT_TRUE(lines[1].starts_with("axes: as published")) << lines[1];
    EXPECT_TRUE(lines[2].starts_with("clock: good")) << lines[2];
    EXPECT_EQ(samples.counts().samples, 600U);
    EXPECT_EQ(samples.counts().damaged, 0U);
}

TEST(Psvr2Samples, OfAClosedEyeAreNotValid) {
    GazeSamples samples(kDelay);
    std::optional<gaze::GazeSample> sample;
    for (std::uint32_t i = 0; i < 20; ++i) {
        sample = samples.take(good_packet(8333 * i + 1, i).set<std::uint32_t>(92 + 68, 1).bytes,
                              8'333'000LL * i);
    }
    EXPECT_FALSE(sample->eyes[0].valid);
    EXPECT_EQ(sample->eyes[0].openness, 0.0);
    EXPECT_TRUE(sample->eyes[1].valid);
}

TEST(Psvr2Samples, CountWhatIsDamagedAndWhatIsSomethingElse) {
    GazeSamples samples(kDelay);
    const PacketBytes good = good_packet();
    EXPECT_FALSE(samples.take(std::span(good.bytes).first(100), 0).has_value());
    EXPECT_FALSE(samples.take({}, 0).has_value());
    EXPECT_FALSE(samples.take(good_packet().set<std::uint8_t>(0, 'X').bytes, 0).has_value());
    EXPECT_FALSE(samples.take(good_packet().set<std::uint8_t>(1, 'C').bytes, 0).has_value());
    EXPECT_FALSE(samples.take(good_packet().set<std::uint8_t>(1, 'R').bytes, 0).has_value());
    EXPECT_TRUE(samples.take(good_packet().set<float>(92 + 20, 9.F).bytes, 0).has_value());
    EXPECT_EQ(samples.counts().damaged, 4U);
    EXPECT_EQ(samples.counts().others, 2U);
    EXPECT_EQ(samples.counts().samples, 1U);
    EXPECT_EQ(changes(samples).front(),
              "100 bytes came that are no gaze packet: there are none of that length");
}

TEST(Psvr2Samples, TellWhenTheAxesAreNotAsPublished) {
    GazeSamples samples(kDelay);
    std::optional<gaze::GazeSample> sample;
    for (std::uint32_t i = 0; i < 20; ++i) {
        PacketBytes bytes = good_packet(8333 * i + 1, i);
        bytes.set<float>(92 + 4, -31.F).set<float>(164 + 4, 31.F);  // X to the right after all
        sample = samples.take(bytes.bytes, 8'333'000LL * i);
    }
    EXPECT_TRUE(sample->eyes[0].valid);
    EXPECT_NEAR(sample->eyes[0].direction.x, 0.28, 1e-6);
    EXPECT_LT(sample->eyes[0].origin_m.x, sample->eyes[1].origin_m.x);
    const auto lines = changes(samples);
    ASSERT_GE(lines.size(), 2U);
    EXPECT_TRUE(lines[1].starts_with("axes: NOT as published")) << lines[1];
    // One that is the other way round again is not passed on, and counted.
    sample = samples.take(good_packet(200'000, 20).bytes, 200 * kMs);
    EXPECT_FALSE(sample->eyes[0].valid || sample->eyes[1].valid);
    EXPECT_EQ(samples.counts().damaged, 1U);
}

TEST(Psvr2Samples, TellWhenTheAxesTurnOrContradictEachOther) {
    GazeSamples samples(kDelay);
    std::uint32_t frame = 0;
    const auto take = [&](bool odd) {
        ++frame;
        PacketBytes bytes = good_packet(frame * std::int64_t{8333}, frame);
        if (odd) {
            bytes.set<float>(92 + 4, -31.F).set<float>(164 + 4, 31.F);
        }
        return samples.take(bytes.bytes, 8'333'000LL * frame)->eyes[0].valid;
    };
    int valid = 0;
    for (int i = 0; i < 400; ++i) {
        valid += take(i < 8) ? 1 : 0;
    }
    EXPECT_EQ(valid, 1 + 400 - 8 - 119);
    EXPECT_EQ(samples.counts().damaged, 119U);
    std::vector<std::string> axes;
    for (int i = 0; i < 600; ++i) {
        (void)take(i % 2 == 0);
    }
    for (const std::string& line : changes(samples)) {
        if (line.starts_with("axes: ")) {
            axes.push_back(line.substr(6, 15));
        }
    }
    EXPECT_EQ(axes,
              (std::vector<std::string>{"NOT as publishe", "as published (l", "the eyes' place"}));
    EXPECT_EQ(samples.pupils_mm(), (PupilsMm{3.25, 4.5}));
}

TEST(Psvr2Samples, MissPacketsThatTheHeadsetCounted) {
    GazeSamples samples(kDelay);
    const auto lost_before = [&](std::uint32_t frame, std::int64_t at_ms) {
        (void)samples.take(good_packet(at_ms * 1000, frame).bytes, at_ms * kMs);
        return samples.lost_before_last();
    };
    EXPECT_EQ(lost_before(1000, 1), 0U) << "nobody knows what was before";
    EXPECT_EQ(lost_before(1001, 9), 0U);
    EXPECT_EQ(lost_before(1004, 34), 2U);
    EXPECT_EQ(lost_before(1004, 42), 0U) << "repeated";
    EXPECT_EQ(lost_before(1003, 50), 0U) << "backwards";
    EXPECT_EQ(lost_before(2000, 3000), 0U) << "it had ceased to send";
    EXPECT_EQ(lost_before(0xFFFF'FFFF, 3008), 0U) << "another counter";
    EXPECT_EQ(lost_before(0, 3016), 0U) << "its wrap";
    EXPECT_EQ(lost_before(2, 3033), 1U);
    EXPECT_EQ(samples.counts().lost, 3U);
}

/// The device's time after each raw timestamp.
std::vector<std::uint64_t> unwrapped(const std::vector<std::uint64_t>& raw) {
    PacketTimestamp timestamp;
    std::vector<std::uint64_t> times;
    for (const std::uint64_t us : raw) {
        GazePacket packet;
        packet.timestamp_us = static_cast<std::int64_t>(us);
        packet.foveated_timestamp_us = 77;
        times.push_back(timestamp.unwrapped_us(packet));
    }
    return times;
}

TEST(Psvr2Timestamp, IsUnwrappedWhetherItHas32BitsOr64) {
    using Times = std::vector<std::uint64_t>;
    constexpr std::uint64_t kWrap = 0x1'0000'0000;
    // 32 bits that wrap, with nothing above them.
    EXPECT_EQ(unwrapped({kWrap - 5000, kWrap - 1, 3000, 11'333}),
              (Times{kWrap - 5000, kWrap - 1, kWrap + 3000, kWrap + 11'333}));
    // 64 bits that carry into the upper half.
    EXPECT_EQ(unwrapped({kWrap - 5000, kWrap - 1, kWrap + 3000, kWrap + 11'333}),
              (Times{kWrap - 5000, kWrap - 1, kWrap + 3000, kWrap + 11'333}));
    EXPECT_EQ(unwrapped({7 * kWrap + 1, 7 * kWrap + 8334}),
              (Times{7 * kWrap + 1, 7 * kWrap + 8334}));
    // 32 bits below something else: its changes are no time.
    EXPECT_EQ(unwrapped({1000, 9333 + 5 * kWrap, 17'666 + (kWrap << 20U)}),
              (Times{1000, 9333, 17'666}));
    EXPECT_EQ(unwrapped({(kWrap << 30U) + 1000, (kWrap << 29U) + 9333}), (Times{1000, 9333}));
    // A packet that comes late, and one that is set back.
    EXPECT_EQ(unwrapped({2000, 10'000, 9000, 500}), (Times{2000, 10'000, 9000, 500}));
    // Over several wraps.
    Times raw;
    Times expected;
    for (std::uint64_t us = 1; us < 5 * kWrap; us += 1'500'000'000) {
        raw.push_back(us % kWrap);
        expected.push_back(us);
    }
    EXPECT_EQ(unwrapped(raw), expected);
}

TEST(Psvr2Timestamp, IsTheFoveatedBlocksWhereThePacketHasNone) {
    PacketTimestamp timestamp;
    for (const std::int64_t us : {500, 8833, 17'166}) {
        GazePacket packet;
        packet.foveated_timestamp_us = us;
        EXPECT_EQ(timestamp.unwrapped_us(packet), static_cast<std::uint64_t>(us));
    }
}

// A wrap is nothing to the clock: the ages stay known and nothing is told.
TEST(Psvr2Samples, KeepTheirTimesOverAWrap) {
    GazeSamples samples(kDelay);
    constexpr std::int64_t kBeforeWrap_us = 0x1'0000'0000 - 5'000'000;
    for (std::uint32_t i = 0; i < 1200; ++i) {
        const std::int64_t taken_us = kBeforeWrap_us + 8333LL * i;
        const auto sample =
            samples.take(good_packet(taken_us & 0xFFFF'FFFF, i).bytes, 8'333'000LL * i);
        if (i > 300) {
            ASSERT_TRUE(sample->sampled.known()) << i;
            EXPECT_EQ(sample->device_ns, taken_us * 1000);
        }
    }
    EXPECT_EQ(samples.clock()->steps(), 0U);
}

TEST(Psvr2Samples, AllocateNothingOnceTheyHaveSaidWhatTheyAre) {
    GazeSamples samples(kDelay);
    for (std::uint32_t i = 0; i < 1000; ++i) {
        (void)samples.take(good_packet(8333 * i + 1, i).bytes, 8'333'000LL * i);
        (void)changes(samples);
    }
    const std::size_t before = tests::allocations_of_this_thread();
    for (std::uint32_t i = 1000; i < 5000; ++i) {
        (void)samples.take(good_packet(8333LL * i + 1, i).bytes, 8'333'000LL * i);
        (void)samples.take_change();
    }
    EXPECT_EQ(tests::allocations_of_this_thread(), before);
}

TEST(StreamKeeper, AsksAtOnceEverySecondAndInSilenceEveryHalf) {
    constexpr std::int64_t kStart = 77'000 * kMs;
    StreamKeeper keeper(kStart);
    std::vector<std::int64_t> asked_ms;
    bool told_silent = false;
    // Data every 8 ms from 40 ms to 2.5 s, and from 5 s on.
    for (std::int64_t now = kStart; now <= kStart + 7000 * kMs; now += kMs) {
        const std::int64_t ms = (now - kStart) / kMs;
        if (ms % 8 == 0 && ((ms >= 40 && ms <= 2500) || ms >= 5000)) {
            keeper.heard(now);
        }
        if (now >= keeper.next_ns()) {
            told_silent = told_silent || keeper.silent(now);
            EXPECT_EQ(keeper.silent(now), ms >= 2996 && ms < 5000) << ms;
            asked_ms.push_back(ms);
            keeper.asked(now);
        }
    }
    EXPECT_EQ(asked_ms,
              (std::vector<std::int64_t>{0, 1000, 2000, 2996, 3496, 3996, 4496, 4996, 5996, 6996}));
}

}  // namespace
}  // namespace gazeloop::drivers::psvr2
