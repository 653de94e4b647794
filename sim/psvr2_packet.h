#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "runtime/gaze/gaze_sample.h"

namespace gazeloop::sim {

/// The gaze stream of a PlayStation VR2 as seen from the headset's side: what it sends, what it is
/// asked, what it says of itself. Bytes only, for an emulated or a gadget device. Written from what
/// is public of the protocol, apart from the driver's decoder, so that each can test the other.
inline constexpr std::uint16_t kPsvr2Vendor = 0x054C;
inline constexpr std::uint16_t kPsvr2Product = 0x0CDE;
inline constexpr std::uint8_t kPsvr2GazeInterface = 5;
inline constexpr std::uint8_t kPsvr2GazeEndpoint = 0x85;  ///< bulk IN

inline constexpr std::size_t kPsvr2PacketBytes = 328;
using Psvr2Packet = std::array<std::uint8_t, kPsvr2PacketBytes>;

/// The packet of a sample, sent as one bulk transfer. `time_us` counts from anywhere (a clock of 32
/// bits: modulo 2^32), `frame` up by one with every packet. Rays without an origin (all zero) say
/// that it is unknown; openness below one half is a blink, below 0 unknown.
[[nodiscard]] Psvr2Packet psvr2_packet(const gaze::GazeSample& sample, std::uint64_t time_us,
                                       std::uint32_t frame);

/// A control transfer as a device receives it.
struct ControlRequest {
    std::uint8_t request_type = 0;  ///< bmRequestType
    std::uint8_t request = 0;       ///< bRequest
    std::uint16_t value = 0;        ///< wValue
    std::uint16_t index = 0;        ///< wIndex
    std::span<const std::uint8_t> payload;
};

/// Whether it asks the headset to send gaze (true) or to stop (false); none for anything else,
/// which the headset stalls.
[[nodiscard]] std::optional<bool> psvr2_gaze_request(const ControlRequest& request);

/// Device descriptor and configuration, one after the other, as sysfs shows them: six interfaces,
/// of which the last is the gaze's, and the others have no endpoints.
[[nodiscard]] std::vector<std::uint8_t> psvr2_descriptors();

}  // namespace gazeloop::sim
