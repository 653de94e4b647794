#include "drivers/psvr2/head_axes.h"

#include <gtest/gtest.h>

#include "tests/unit/drivers/psvr2/packet_bytes.h"

namespace gazeloop::drivers::psvr2 {
namespace {

/// A packet whose axes point as `x` and `z` say: -1 against the head's, as published.
GazePacket packet_with(int x, int z, bool places = true) {
    tests::PacketBytes bytes = tests::good_packet();
    const auto sx = static_cast<float>(x);
    const auto sz = static_cast<float>(z);
    for (const std::size_t eye : {92U, 164U}) {
        bytes.set<std::uint32_t>(eye, places ? 1 : 0);
        bytes.set3(eye + 4, sx * (eye == 92 ? -31.F : 32.F), 0.F, 0.F);
        bytes.set3(eye + 20, sx * -0.28F, 0.F, sz * -0.96F);  // to the left, forward
    }
    return decode_gaze_packet(bytes.bytes).value();
}

TEST(HeadAxes, AsPublishedAreLeftUpForward) {
    HeadAxes axes;
    for (int i = 0; i < 7; ++i) {
        EXPECT_FALSE(axes.agrees(packet_with(-1, -1))) << "not before it is clear: " << i;
    }
    EXPECT_TRUE(axes.agrees(packet_with(-1, -1)));
    EXPECT_EQ(axes.verdict(), AxesVerdict::AsPublished);
    EXPECT_EQ(axes.to_head({1.0, 2.0, 3.0}), glm::dvec3(-1.0, 2.0, -3.0));
}

TEST(HeadAxes, AreNeverMirroredWhateverTheHeadsetSends) {
    for (const int x : {-1, 1}) {
        for (const int z : {-1, 1}) {
            HeadAxes axes;
            int used = 0;
            for (int i = 0; i < 100; ++i) {
                const GazePacket packet = packet_with(x, z);
                if (axes.agrees(packet)) {
                    ++used;
                    const glm::dvec3 left = axes.to_head(*packet.eyes[0].origin_mm);
                    const glm::dvec3 right = axes.to_head(*packet.eyes[1].origin_mm);
                    EXPECT_LT(left.x, right.x);
                    const glm::dvec3 direction = axes.to_head(*packet.eyes[0].direction);
                    EXPECT_NEAR(direction.x, -0.28, 1e-6) << "it looks to the left";
                    EXPECT_NEAR(direction.z, -0.96, 1e-6);
                }
            }
            EXPECT_EQ(used, 93);
            EXPECT_EQ(axes.verdict(),
                      x < 0 && z < 0 ? AxesVerdict::AsPublished : AxesVerdict::FromData);
        }
    }
}

TEST(HeadAxes, OnePacketDoesNotTurnThemAround) {
    HeadAxes axes;
    EXPECT_FALSE(axes.agrees(packet_with(1, -1)));
    for (int i = 0; i < 8; ++i) {
        EXPECT_EQ(axes.agrees(packet_with(-1, -1)), i == 7);
    }
    EXPECT_FALSE(axes.agrees(packet_with(1, -1))) << "it contradicts";
    EXPECT_FALSE(axes.agrees(packet_with(-1, 1))) << "eyes do not look back";
    EXPECT_TRUE(axes.agrees(packet_with(-1, -1)));
    EXPECT_TRUE(axes.agrees(packet_with(-1, -1, false))) << "without places nothing contradicts";
    EXPECT_EQ(axes.verdict(), AxesVerdict::AsPublished);
}

TEST(HeadAxes, WithoutPlacesAreUnconfirmedUntilThereAreSome) {
    HeadAxes axes;
    for (int i = 0; i < 180; ++i) {
        EXPECT_EQ(axes.agrees(packet_with(-1, -1, false)), i == 179);
    }
    EXPECT_EQ(axes.verdict(), AxesVerdict::Unconfirmed);
    for (int i = 0; i < 8; ++i) {
        EXPECT_EQ(axes.agrees(packet_with(1, -1)), i == 7) << "places that contradict";
    }
    EXPECT_EQ(axes.verdict(), AxesVerdict::FromData);
}

// What a second's worth of packets says counts more than what the first of them said.
TEST(HeadAxes, AreTurnedByASecondOfContradiction) {
    HeadAxes axes;
    for (int i = 0; i < 8; ++i) {
        EXPECT_EQ(axes.agrees(packet_with(1, -1)), i == 7);
    }
    EXPECT_EQ(axes.verdict(), AxesVerdict::FromData);
    int used = 0;
    for (int i = 0; i < 1000; ++i) {
        const GazePacket packet = packet_with(-1, -1);
        if (axes.agrees(packet)) {
            ++used;
            EXPECT_LT(axes.to_head(*packet.eyes[0].origin_mm).x,
                      axes.to_head(*packet.eyes[1].origin_mm).x);
        }
    }
    EXPECT_EQ(used, 1000 - 119);
    EXPECT_EQ(axes.verdict(), AxesVerdict::AsPublished);
    // And back, should the headset be told to send otherwise.
    for (int i = 0; i < 120; ++i) {
        EXPECT_EQ(axes.agrees(packet_with(1, -1)), i == 119);
    }
    EXPECT_EQ(axes.verdict(), AxesVerdict::FromData);
}

TEST(HeadAxes, AFewOddPacketsAreLeftOutAndNoMore) {
    HeadAxes axes;
    int used = 0;
    for (int i = 0; i < 700; ++i) {
        const bool odd = i % 7 == 3;
        const bool agrees = axes.agrees(packet_with(odd ? 1 : -1, -1));
        EXPECT_FALSE(odd && agrees);
        used += agrees ? 1 : 0;
    }
    EXPECT_EQ(used, 600 - 7) << "all that are not odd, from the eighth on";
    EXPECT_EQ(axes.verdict(), AxesVerdict::AsPublished);
}

TEST(HeadAxes, ThatContradictEachOtherAreNotUsedUntilTheyAgree) {
    HeadAxes axes;
    for (int i = 0; i < 1000; ++i) {
        EXPECT_FALSE(axes.agrees(packet_with(i % 2 == 0 ? 1 : -1, -1)));
        EXPECT_EQ(axes.verdict(), i < 179 ? AxesVerdict::Unchecked : AxesVerdict::Contradictory);
    }
    int needed = 1;
    while (!axes.agrees(packet_with(-1, -1)) && needed < 1000) {
        ++needed;
    }
    EXPECT_EQ(needed, 59) << "two thirds of the last 180";
    EXPECT_EQ(axes.verdict(), AxesVerdict::AsPublished);
    // A verdict that half of them contradict is none either.
    int used = 0;
    for (int i = 0; i < 1000; ++i) {
        used += axes.agrees(packet_with(i % 3 == 0 ? -1 : 1, i % 2 == 0 ? -1 : 1)) ? 1 : 0;
    }
    EXPECT_EQ(axes.verdict(), AxesVerdict::Contradictory);
    EXPECT_LT(used, 100);
}

TEST(HeadAxes, OfEyesThatLookBackWithoutPlacesAreNotTaken) {
    HeadAxes axes;
    for (int i = 0; i < 300; ++i) {
        EXPECT_FALSE(axes.agrees(packet_with(-1, 1, false)));
    }
    EXPECT_EQ(axes.verdict(), AxesVerdict::Contradictory);
}

TEST(HeadAxes, EyesInOnePlaceOrMilesApartSayNothing) {
    for (const float mm : {0.F, 5.F, 70.F}) {
        tests::PacketBytes bytes = tests::good_packet();
        bytes.set3(92 + 4, mm, 0.F, 0.F).set3(164 + 4, -mm, 0.F, 0.F);
        HeadAxes axes;
        for (int i = 0; i < 20; ++i) {
            EXPECT_FALSE(axes.agrees(decode_gaze_packet(bytes.bytes).value()));
        }
        EXPECT_EQ(axes.verdict(), AxesVerdict::Unchecked) << mm;
    }
}

}  // namespace
}  // namespace gazeloop::drivers::psvr2
