#include "drivers/datagram/osc_gaze.h"

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>
#include <sys/socket.h>
#include <unistd.h>

#include <bit>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <string>
#include <thread>
#include <vector>

#include "drivers/datagram/datagram_source.h"
#include "runtime/gaze/direction.h"
#include "runtime/time/clock.h"

namespace gazeloop::drivers::datagram {
namespace {

std::string text(const std::string& written) {
    return written + std::string(4 - written.size() % 4, '\0');
}

std::string bits(std::uint64_t number, int size) {
    std::string bytes;
    for (int shift = 8 * (size - 1); shift >= 0; shift -= 8) {
        bytes += static_cast<char>(number >> static_cast<unsigned>(shift) & 0xFFU);
    }
    return bytes;
}

std::string floats(const std::string& address, const std::vector<float>& numbers) {
    std::string packet = text(address) + text("," + std::string(numbers.size(), 'f'));
    for (const float number : numbers) {
        packet += bits(std::bit_cast<std::uint32_t>(number), 4);
    }
    return packet;
}

std::string bundle(const std::vector<std::string>& elements) {
    std::string packet = text("#bundle") + bits(1, 8);
    for (const std::string& element : elements) {
        packet += bits(element.size(), 4) + element;
    }
    return packet;
}

std::span<const std::uint8_t> bytes(const std::string& packet) {
    return {reinterpret_cast<const std::uint8_t*>(packet.data()), packet.size()};
}

/// 15 degrees up and 20 to the right, by each of the ways to say so.
TEST(OscGaze, TakesEachWayToSayWhereEyesLook) {
    const double up = glm::radians(15.0);
    const double right = glm::radians(20.0);
    const glm::dvec3 there{std::sin(right) * std::cos(up), std::sin(up),
                           -std::cos(right) * std::cos(up)};
    const auto x = static_cast<float>(there.x);
    const auto y = static_cast<float>(there.y);
    const auto z = static_cast<float>(-there.z);
    for (const std::string& packet :
         {floats("/tracking/eye/LeftRightPitchYaw", {-15, 20, -15, 20}),
          floats("/tracking/eye/CenterPitchYaw", {-15, 20}),
          floats("/tracking/eye/LeftRightVec", {x, y, z, 2 * x, 2 * y, 2 * z}),
          floats("/tracking/eye/CenterVec", {x, y, z}),
          floats("/gazeloop/gaze", {7, x, y, -z, 1, 1, x, y, -z, 1, 1})}) {
        OscGaze gaze;
        const auto sample = gaze.take(bytes(packet), 5);
        ASSERT_TRUE(sample) << packet;
        EXPECT_EQ(sample->arrived, (time::Stamp{5, time::StampKind::Measured}));
        EXPECT_FALSE(sample->sampled.known());
        for (const gaze::EyeRay& ray : sample->eyes) {
            EXPECT_TRUE(ray.valid);
            EXPECT_LT(gaze::angle_between(ray.direction, there), 1e-6) << packet;
        }
    }
}

TEST(OscGaze, KeepsTheLidsForAWhile) {
    OscGaze gaze;
    EXPECT_FALSE(gaze.take(bytes(floats("/tracking/eye/EyesClosedAmount", {0.75F})), 0));
    const std::string look = floats("/tracking/eye/CenterPitchYaw", {0, 0});
    EXPECT_NEAR(gaze.take(bytes(look), 1000)->eyes[0].openness, 0.25, 1e-6);
    EXPECT_EQ(gaze.take(bytes(look), OscGaze::kLidsLast_ns + 1)->eyes[0].openness, -1.0);
}

TEST(OscGaze, TakesOurOwnMessageWithAllItSays) {
    OscGaze gaze;
    const auto sample =
        gaze.take(bytes(floats("/gazeloop/gaze", {41, 0, 0, -1, 0.5F, 0.25F, 0, 0, 0, -1, -1})), 9);
    ASSERT_TRUE(sample);
    EXPECT_EQ(sample->sequence, 41U);
    EXPECT_TRUE(sample->eyes[0].valid);
    EXPECT_EQ(sample->eyes[0].openness, 0.5);
    EXPECT_EQ(sample->eyes[0].confidence, 0.25);
    EXPECT_FALSE(sample->eyes[1].valid) << "no direction: the eye is not seen";
    EXPECT_EQ(sample->eyes[1].confidence, -1.0);
}

TEST(OscGaze, LooksIntoBundlesOnlySoDeep) {
    const std::string look = floats("/tracking/eye/CenterPitchYaw", {0, 0});
    std::string nested = look;
    for (int depth = 1; depth <= OscReader::kDeepest + 2; ++depth) {
        nested = bundle({floats("/other", {1}), nested});
        OscGaze gaze;
        EXPECT_EQ(gaze.take(bytes(nested), 0).has_value(), depth <= OscReader::kDeepest) << depth;
        EXPECT_EQ(gaze.counts().damaged, depth <= OscReader::kDeepest ? 0U : 1U) << depth;
        EXPECT_GT(gaze.counts().others, 0U);
        EXPECT_EQ(gaze.first_other(), "/other with 1 numbers");
    }
}

TEST(OscGaze, TellsTheFirstMessageOfNoUse) {
    OscGaze gaze;
    EXPECT_EQ(gaze.first_other(), "");
    EXPECT_FALSE(gaze.take(bytes(floats("/gazeloop/gaze", {1, 2, 3, 4, 5, 6, 7, 8, 9})), 0));
    EXPECT_FALSE(gaze.take(bytes(floats("/avatar/parameters/x", {1})), 0));
    EXPECT_EQ(gaze.counts().others, 2U);
    EXPECT_EQ(gaze.first_other(), "/gazeloop/gaze with 9 numbers");
    OscGaze odd;
    EXPECT_FALSE(odd.take(bytes(floats("/a\x1B[2J", {1})), 0));
    EXPECT_EQ(odd.first_other(), "/a?[2J with 1 numbers");
}

TEST(OscGaze, CountsWhatItCannotTake) {
    OscGaze gaze;
    const std::string look = floats("/tracking/eye/CenterPitchYaw", {0, 0});
    for (const std::string& packet :
         {std::string(), std::string("x"), look.substr(0, look.size() - 1), text("no/slash"),
          bundle({look}).substr(0, 20)}) {
        EXPECT_FALSE(gaze.take(bytes(packet), 0));
    }
    EXPECT_EQ(gaze.counts().damaged, 5U);
    const float nan = std::nanf("");
    const auto sample = gaze.take(bytes(floats("/tracking/eye/CenterPitchYaw", {nan, 0})), 0);
    ASSERT_TRUE(sample);
    EXPECT_FALSE(sample->eyes[0].valid);
}

RC_GTEST_PROP(OscGaze, TakesAnyBytes, ()) {
    OscGaze gaze;
    std::string packet = bundle({floats("/tracking/eye/LeftRightVec", {0, 0, 1, 0, 0, 1})});
    const int changes = *rc::gen::inRange(0, 6);
    for (int i = 0; i < changes; ++i) {
        packet[*rc::gen::inRange<std::size_t>(0, packet.size())] = *rc::gen::arbitrary<char>();
    }
    packet.resize(*rc::gen::inRange<std::size_t>(0, packet.size() + 1));
    const auto sample = gaze.take(bytes(packet), 0);
    if (sample && sample->eyes[0].valid) {
        RC_ASSERT(std::abs(glm::length(sample->eyes[0].direction) - 1.0) < 1e-9);
    }
    RC_ASSERT(gaze.counts().packets == 1U);
}

TEST(DatagramSource, IsNamedByPortAndAddress) {
    EXPECT_EQ(parse_endpoint("9020")->address, "127.0.0.1");
    EXPECT_EQ(parse_endpoint("0.0.0.0:9020")->address, "0.0.0.0");
    EXPECT_EQ(parse_endpoint("0.0.0.0:9020")->port, 9020);
    for (const char* text : {"", "0", "70000", "-1", "9020x", "localhost:9020", "::1", "1.2.3:4"}) {
        EXPECT_FALSE(parse_endpoint(text)) << text;
    }
}

TEST(DatagramSource, SaysWhenADatagramArrivedAndWhoHasThePort) {
    const Endpoint endpoint{.address = "127.0.0.1", .port = 47'123};
    DatagramSource source(endpoint);
    EXPECT_THROW(DatagramSource another(endpoint), SetupError);
    const int sender = ::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
    sockaddr_in to{};
    to.sin_family = AF_INET;
    to.sin_port = htons(endpoint.port);
    inet_pton(AF_INET, "127.0.0.1", &to.sin_addr);
    const auto send = [&](const std::string& packet) {
        return ::sendto(sender, packet.data(), packet.size(), 0,
                        reinterpret_cast<const sockaddr*>(&to),
                        sizeof to) == static_cast<ssize_t>(packet.size());
    };
    const std::string look = floats("/tracking/eye/CenterPitchYaw", {0, 0});
    ASSERT_TRUE(send(look) && send(std::string(5000, 'x')) && send(look));
    std::vector<gaze::GazeSample> samples;
    source.poll(time::monotonic_ns(), samples);
    EXPECT_EQ(samples.size(), 2U);
    const auto events = source.take_events();
    ASSERT_EQ(events.size(), 2U);
    EXPECT_NE(events[1].text.find("1 of 3"), std::string::npos) << events[1].text;

    // By the kernel's stamp, though it is asked for later. The kernel begins to stamp some time
    // after it was told to.
    bool stamped = false;
    for (int round = 0; round < 100 && !stamped; ++round) {
        const std::int64_t before_ns = time::monotonic_ns();
        ASSERT_TRUE(send(look));
        const std::int64_t after_ns = time::monotonic_ns();
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
        samples.clear();
        source.poll(time::monotonic_ns(), samples);
        ASSERT_EQ(samples.size(), 1U);
        constexpr std::int64_t kTwoClocks_ns = 5'000'000;
        stamped = samples[0].arrived.ns >= before_ns - kTwoClocks_ns &&
                  samples[0].arrived.ns <= after_ns + kTwoClocks_ns;
    }
    EXPECT_TRUE(stamped);
    ::close(sender);
}

}  // namespace
}  // namespace gazeloop::drivers::datagram
