#include "sim/psvr2_packet.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <glm/geometric.hpp>

namespace gazeloop::sim {
namespace {

void put_u16(Psvr2Packet& packet, std::size_t at, std::uint16_t value) {
    packet[at] = static_cast<std::uint8_t>(value);
    packet[at + 1] = static_cast<std::uint8_t>(value >> 8U);
}

void put_u32(Psvr2Packet& packet, std::size_t at, std::uint32_t value) {
    put_u16(packet, at, static_cast<std::uint16_t>(value));
    put_u16(packet, at + 2, static_cast<std::uint16_t>(value >> 16U));
}

void put_u64(Psvr2Packet& packet, std::size_t at, std::uint64_t value) {
    put_u32(packet, at, static_cast<std::uint32_t>(value));
    put_u32(packet, at + 4, static_cast<std::uint32_t>(value >> 32U));
}

void put_f32(Psvr2Packet& packet, std::size_t at, double value) {
    put_u32(packet, at, std::bit_cast<std::uint32_t>(static_cast<float>(value)));
}

/// The headset's axes: X to the wearer's left, Y up, Z forward.
void put_vector(Psvr2Packet& packet, std::size_t at, const glm::dvec3& in_head) {
    put_f32(packet, at, -in_head.x);
    put_f32(packet, at + 4, in_head.y);
    put_f32(packet, at + 8, -in_head.z);
}

bool has_origin(const gaze::EyeRay& ray) { return glm::length(ray.origin_m) > 0.0; }

void attach_eye(Psvr2Packet& packet, std::size_t at, const gaze::EyeRay& ray) {
    constexpr double kPupil_mm = 3.5;
    if (has_origin(ray)) {
        put_u32(packet, at, 1);
        put_vector(packet, at + 4, ray.origin_m * 1e3);
    }
    if (ray.valid) {
        put_u32(packet, at + 16, 1);
        put_vector(packet, at + 20, ray.direction);
        put_u32(packet, at + 32, 1);
        put_f32(packet, at + 36, kPupil_mm);
        put_u32(packet, at + 40, 1);
        put_f32(packet, at + 44, 0.5);  // in the middle of the sensor
        put_f32(packet, at + 48, 0.5);
        put_u32(packet, at + 52, 1);
        put_f32(packet, at + 56, 0.5);  // and where it should be
        put_f32(packet, at + 60, 0.5);
    }
    if (ray.openness >= 0.0) {
        put_u32(packet, at + 64, 1);
        put_u32(packet, at + 68, ray.openness < 0.5 ? 1 : 0);
    }
}

struct CombinedRay {
    std::optional<glm::dvec3> origin_m;
    std::optional<glm::dvec3> direction;
};

CombinedRay combined(const gaze::PerEye<gaze::EyeRay>& eyes) {
    const auto& [left, right] = eyes;
    CombinedRay between;
    if (has_origin(left) && has_origin(right)) {
        between.origin_m = (left.origin_m + right.origin_m) / 2.0;
    }
    glm::dvec3 direction{0.0};
    for (const gaze::EyeRay& ray : eyes) {
        direction += ray.valid ? ray.direction : glm::dvec3(0.0);
    }
    if (glm::length(direction) > 0.0) {
        between.direction = glm::normalize(direction);
    }
    return between;
}

/// How far away the rays meet, seen from above; 0 where they do not.
double convergence_mm(const gaze::PerEye<gaze::EyeRay>& eyes) {
    const auto& [left, right] = eyes;
    if (!left.valid || !right.valid || !(left.direction.z < 0.0) || !(right.direction.z < 0.0)) {
        return 0.0;
    }
    const double together =
        right.direction.x / right.direction.z - left.direction.x / left.direction.z;
    return together > 0.0 ? (right.origin_m.x - left.origin_m.x) / together * 1e3 : 0.0;
}

}  // namespace

Psvr2Packet psvr2_packet(const gaze::GazeSample& sample, std::uint64_t time_us,
                         std::uint32_t frame) {
    Psvr2Packet packet{};
    packet[0] = 'G';
    packet[1] = 'S';
    put_u16(packet, 2, 1);
    put_u32(packet, 4, static_cast<std::uint32_t>(kPsvr2PacketBytes));
    put_u32(packet, 60, 1);  // some user's calibration
    put_u64(packet, 80, time_us);
    put_u32(packet, 88, frame);
    attach_eye(packet, 92, sample.eyes[0]);
    attach_eye(packet, 164, sample.eyes[1]);
    const CombinedRay both = combined(sample.eyes);
    if (both.origin_m) {
        put_u32(packet, 236, 1);
        put_vector(packet, 240, *both.origin_m * 1e3);
    }
    if (both.direction) {
        put_u32(packet, 252, 1);
        put_vector(packet, 256, *both.direction);
    }
    put_u64(packet, 272, time_us);
    put_u32(packet, 280, frame);
    if (both.direction) {
        put_u32(packet, 284, 1);
        const glm::dvec3 direction = *both.direction;
        const auto& [left, right] = sample.eyes;
        put_vector(packet, 288, left.valid ? left.direction : direction);
        put_vector(packet, 300, right.valid ? right.direction : direction);
        put_vector(packet, 312, direction);
        put_f32(packet, 324, convergence_mm(sample.eyes));
    }
    return packet;
}

std::optional<bool> psvr2_gaze_request(const ControlRequest& request) {
    constexpr std::uint8_t kVendorToEndpoint = 0x42;
    constexpr std::uint8_t kSetReport = 9;
    constexpr std::uint8_t kGazeStream = 0x0C;
    constexpr std::size_t kHeaderBytes = 8;
    const auto& payload = request.payload;
    const bool ours = request.request_type == kVendorToEndpoint && request.request == kSetReport &&
                      request.value == kGazeStream && request.index == 0 &&
                      payload.size() == kHeaderBytes && payload[0] == kGazeStream &&
                      payload[1] == 0 && payload[3] == 0 &&
                      std::ranges::all_of(payload.subspan(4), [](auto byte) { return byte == 0; });
    if (!ours || payload[2] < 1 || payload[2] > 2) {
        return std::nullopt;
    }
    return payload[2] == 1;
}

std::vector<std::uint8_t> psvr2_descriptors() {
    constexpr std::uint8_t kInterfaces = kPsvr2GazeInterface + 1;
    constexpr std::uint16_t kConfigurationBytes = 9 + 9 * kInterfaces + 7;
    std::vector<std::uint8_t> bytes{18,
                                    1,
                                    0x00,
                                    0x02,
                                    0xEF,
                                    0x02,
                                    0x01,
                                    64,  // USB 2.0, functions side by side
                                    0x4C,
                                    0x05,
                                    0xDE,
                                    0x0C,
                                    0x00,
                                    0x01,
                                    0,
                                    0,
                                    0,
                                    1,
                                    9,
                                    2,
                                    static_cast<std::uint8_t>(kConfigurationBytes & 0xFFU),
                                    static_cast<std::uint8_t>(kConfigurationBytes >> 8U),
                                    kInterfaces,
                                    1,
                                    0,
                                    0x80,
                                    250};
    for (std::uint8_t i = 0; i < kInterfaces; ++i) {
        const std::uint8_t endpoints = i == kPsvr2GazeInterface ? 1 : 0;
        bytes.insert(bytes.end(), {9, 4, i, 0, endpoints, 0xFF, 0, 0, 0});
    }
    bytes.insert(bytes.end(), {7, 5, kPsvr2GazeEndpoint, 2, 0x00, 0x02, 0});  // bulk, 512 bytes
    return bytes;
}

}  // namespace gazeloop::sim
