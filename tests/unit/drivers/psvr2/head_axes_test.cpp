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
    for (int i = 0; i < 240; ++i) {
        EXPECT_EQ(axes.agrees(packet_with(-1, -1, false)), i == 239);
    }
    EXPECT_EQ(axes.verdict(), AxesVerdict::Unconfirmed);
    for (int i = 0; i < 8; ++i) {
        EXPECT_EQ(axes.agrees(packet_with(1, -1)), i == 7) << "places that contradict";
    }
    EXPECT_EQ(axes.verdict(), AxesVerdict::FromData);
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
