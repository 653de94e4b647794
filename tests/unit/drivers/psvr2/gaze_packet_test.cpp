#include "drivers/psvr2/gaze_packet.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <vector>

#include "sim/psvr2_packet.h"
#include "tests/support/generated_numbers.h"
#include "tests/unit/drivers/psvr2/packet_bytes.h"

namespace gazeloop::drivers::psvr2 {
namespace {

using tests::between;

using tests::good_packet;
using tests::PacketBytes;

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinity = std::numeric_limits<float>::infinity();

void expect_vector(const std::optional<glm::dvec3>& v, double x, double y, double z) {
    ASSERT_TRUE(v.has_value());
    EXPECT_NEAR(v->x, x, 1e-6);
    EXPECT_NEAR(v->y, y, 1e-6);
    EXPECT_NEAR(v->z, z, 1e-6);
}

TEST(GazePacket, HasEveryFieldWhereItIsPublished) {
    const auto packet = decode_gaze_packet(good_packet(5'000'000, 7).bytes);
    ASSERT_TRUE(packet.has_value());
    EXPECT_EQ(packet->version, 3);
    EXPECT_EQ(packet->calibration_id, 0xCAFEU);
    EXPECT_EQ(packet->timestamp_us, 5'000'000);
    EXPECT_EQ(packet->frame, 7U);
    const auto& [left, right] = packet->eyes;
    expect_vector(left.origin_mm, 31.0, 1.5, -2.0);
    expect_vector(right.origin_mm, -32.0, 1.5, -2.0);
    expect_vector(left.direction, 0.28, 0.0, 0.96);
    EXPECT_EQ(left.pupil_mm, 3.25);
    EXPECT_EQ(right.pupil_mm, 4.5);
    EXPECT_EQ(left.blink, false);
    EXPECT_EQ(packet->foveated_timestamp_us, 5'000'250);
    EXPECT_EQ(packet->implausible, 0U);
}

// Each byte of the two eyes' blocks belongs to its own eye.
TEST(GazePacket, DoesNotMixTheEyesUp) {
    PacketBytes bytes = good_packet();
    bytes.set<std::uint32_t>(164 + 16, 0)
        .set<std::uint32_t>(92 + 64, 0)
        .set<std::uint32_t>(164 + 68, 1);
    const auto packet = decode_gaze_packet(bytes.bytes);
    ASSERT_TRUE(packet.has_value());
    EXPECT_TRUE(packet->eyes[0].direction.has_value());
    EXPECT_FALSE(packet->eyes[1].direction.has_value());
    EXPECT_FALSE(packet->eyes[0].blink.has_value());
    EXPECT_EQ(packet->eyes[1].blink, true);
}

TEST(GazePacket, IsRefusedUnlessItIsOne) {
    const auto fault = [](std::span<const std::uint8_t> bytes) {
        const auto packet = decode_gaze_packet(bytes);
        return packet ? std::optional<PacketFault>() : packet.error();
    };
    const PacketBytes good = good_packet();
    for (std::size_t length = 2; length < 328; ++length) {
        EXPECT_EQ(fault(std::span(good.bytes).first(length)), PacketFault::Length) << length;
    }
    EXPECT_EQ(fault({}), PacketFault::Length);
    std::vector<std::uint8_t> two(good.bytes.begin(), good.bytes.end());
    two.push_back(0);
    EXPECT_EQ(fault(two), PacketFault::Length);
    two.pop_back();
    two.insert(two.end(), good.bytes.begin(), good.bytes.end());
    EXPECT_EQ(fault(two), PacketFault::Length) << "two in one";
    PacketBytes other = good;
    EXPECT_EQ(fault(other.set<std::uint8_t>(1, 'C').bytes), PacketFault::Calibration);
    EXPECT_EQ(fault(other.set<std::uint8_t>(1, 'R').bytes), PacketFault::Raw);
    EXPECT_EQ(fault(other.set<std::uint8_t>(1, 'X').bytes), PacketFault::Magic);
    PacketBytes longer = good;
    EXPECT_EQ(fault(longer.set<std::uint32_t>(4, 329).bytes), PacketFault::Size);
    EXPECT_EQ(fault(longer.set<std::uint32_t>(4, 320).bytes), std::nullopt);
}

TEST(GazePacket, LeavesOutWhatCannotBe) {
    const auto decoded = [](const PacketBytes& bytes) {
        return decode_gaze_packet(bytes.bytes).value();
    };
    for (const float bad : {kNan, kInfinity, -kInfinity, 0.F, 1e30F, -1e-30F, 1.02F}) {
        const GazePacket packet = decoded(good_packet().set3(92 + 20, bad, 0.F, 0.F));
        EXPECT_FALSE(packet.eyes[0].direction.has_value()) << bad;
        EXPECT_TRUE(packet.eyes[1].direction.has_value()) << bad;
        EXPECT_EQ(packet.implausible, 1U) << bad;
    }
    // Nobody looks along his own face.
    for (const float ahead : {0.F, -0.F, 0.09F, -0.09F}) {
        const GazePacket packet =
            decoded(good_packet().set3(92 + 20, 0.F, std::sqrt(1.F - ahead * ahead), ahead));
        EXPECT_FALSE(packet.eyes[0].direction.has_value()) << ahead;
        EXPECT_EQ(packet.implausible, 1U) << ahead;
    }
    for (const float bad : {kNan, kInfinity, 201.F, -1e20F}) {
        const GazePacket packet = decoded(good_packet().set<float>(164 + 4, bad));
        EXPECT_FALSE(packet.eyes[1].origin_mm.has_value()) << bad;
        EXPECT_EQ(packet.implausible, 1U) << bad;
    }
    for (const float bad : {kNan, 0.F, -1.F, 15.1F}) {
        EXPECT_FALSE(decoded(good_packet().set<float>(92 + 36, bad)).eyes[0].pupil_mm) << bad;
    }
    const GazePacket many = decoded(good_packet()
                                        .set<float>(92 + 4, kNan)
                                        .set<float>(164 + 36, kInfinity)
                                        .set<std::uint32_t>(92 + 68, 2));
    EXPECT_EQ(many.implausible, 3U);
    EXPECT_FALSE(many.eyes[0].blink.has_value());
    // What is not used is not judged: the combined ray, the foveated block.
    EXPECT_EQ(decoded(good_packet().set3(240, kNan, 0.F, 0.F).set<float>(324, kNan)).implausible,
              0U);
}

// A flag is 1 or it is not set: memory that was never written vouches for nothing.
TEST(GazePacket, TakesOnlyOneForYes) {
    for (const std::uint32_t flag : {0U, 2U, 256U, 0xFFFF'FFFFU}) {
        const auto packet = decode_gaze_packet(good_packet().set(92 + 16, flag).bytes);
        EXPECT_FALSE(packet->eyes[0].direction.has_value()) << flag;
        EXPECT_EQ(packet->implausible, 0U);
    }
}

// Any bytes: what comes out is finite, of unit length, in range.
RC_GTEST_PROP(GazePacket, IsPlausibleWhateverTheBytes, ()) {
    auto bytes = *rc::gen::container<std::vector<std::uint8_t>>(
        328,
        rc::gen::weightedOneOf<std::uint8_t>({{4, rc::gen::element<std::uint8_t>(0, 1)},
                                              {1, rc::gen::arbitrary<std::uint8_t>()},
                                              {1, rc::gen::element<std::uint8_t>(0x3F, 0x80)}}));
    bytes[0] = 'G';
    bytes[1] = 'S';
    bytes[6] = bytes[7] = bytes[5] = 0;
    const auto packet = decode_gaze_packet(bytes);
    RC_ASSERT(packet.has_value());
    for (const EyeBlock& eye : packet->eyes) {
        RC_ASSERT(!eye.direction || std::abs(glm::length(*eye.direction) - 1.0) < 1e-9);
        RC_ASSERT(!eye.direction || std::abs(eye.direction->z) >= 0.1);
        RC_ASSERT(!eye.origin_mm || glm::length(*eye.origin_mm) < 200.0);
        RC_ASSERT(!eye.pupil_mm || (*eye.pupil_mm > 0.0 && *eye.pupil_mm <= 15.0));
    }
}

// The simulation's packets, which were written apart from the decoder, say what went in.
RC_GTEST_PROP(GazePacket, OfTheSimulationSaysWhatWentIn,
              (std::uint64_t time_us, std::uint32_t frame)) {
    gaze::GazeSample sample;
    for (const gaze::Eye eye : gaze::kEyes) {
        gaze::EyeRay& ray = sample.eyes[gaze::index(eye)];
        ray.valid = *rc::gen::arbitrary<bool>();
        ray.openness = *rc::gen::element(-1.0, 0.0, 1.0);
        ray.origin_m = {eye == gaze::Eye::Left ? -0.031 : 0.031, between(-0.01, 0.01), 0.02};
        ray.direction =
            glm::normalize(glm::dvec3(between(-1, 1), between(-1, 1), between(-2, -0.2)));
    }
    const auto packet = decode_gaze_packet(sim::psvr2_packet(sample, time_us, frame));
    RC_ASSERT(packet.has_value());
    RC_ASSERT(packet->implausible == 0U);
    RC_ASSERT(packet->timestamp_us == static_cast<std::int64_t>(time_us));
    RC_ASSERT(packet->frame == frame);
    for (std::size_t i = 0; i < 2; ++i) {
        const gaze::EyeRay& ray = sample.eyes[i];
        RC_ASSERT(packet->eyes[i].direction.has_value() == ray.valid);
        if (ray.valid) {
            const glm::dvec3 expected(-ray.direction.x, ray.direction.y, -ray.direction.z);
            RC_ASSERT(glm::distance(*packet->eyes[i].direction, expected) < 1e-6);
        }
        RC_ASSERT(packet->eyes[i].blink.has_value() == (ray.openness >= 0.0));
    }
}

}  // namespace
}  // namespace gazeloop::drivers::psvr2
