#pragma once

#include <cstddef>
#include <cstdint>
#include <expected>
#include <glm/vec3.hpp>
#include <optional>
#include <span>

#include "runtime/gaze/eye.h"

namespace gazeloop::drivers::psvr2 {

/// A gaze packet of a PlayStation VR2: little-endian, as public drivers read it. Vectors are in the
/// headset's own axes (head_axes.h). What the headset does not vouch for, or what is impossible, is
/// absent.
inline constexpr std::size_t kPacketBytes = 328;

struct EyeBlock {
    std::optional<glm::dvec3> origin_mm;  ///< within 200 mm of the headset's origin
    std::optional<glm::dvec3> direction;  ///< unit vector
    std::optional<double> pupil_mm;       ///< diameter, 0 to 15
    std::optional<bool> blink;            ///< closed
};

/// What is used of a packet.
struct GazePacket {
    std::uint16_t version = 0;
    std::uint32_t calibration_id = 0;
    std::int64_t timestamp_us = 0;  ///< of 64 bits, or of 32 in the lower half
    std::uint32_t frame = 0;        ///< up by one with every packet
    gaze::PerEye<EyeBlock> eyes;
    /// Timestamp of the block by which the headset itself would steer foveated rendering.
    std::int64_t foveated_timestamp_us = 0;
    /// Values that the headset vouches for but that are impossible: not finite, no unit vector,
    /// along the face, out of range. They are absent above.
    std::uint32_t implausible = 0;
};

/// Why bytes are no gaze packet.
enum class PacketFault : std::uint8_t {
    Length,       ///< shorter or longer than a packet, or several in one transfer
    Magic,        ///< does not begin as any packet does
    Size,         ///< says that it is longer than what came
    Calibration,  ///< "GC": a calibration's packet, no fault
    Raw,          ///< "GR": raw data, no fault
};

/// Reads a transfer.
///
/// The length must be that of a packet. The packet's own size field must not exceed it. Public
/// sources name that field but not what it counts, so smaller values pass. No source says which
/// versions there are.
[[nodiscard]] std::expected<GazePacket, PacketFault> decode_gaze_packet(
    std::span<const std::uint8_t> bytes);

}  // namespace gazeloop::drivers::psvr2
