#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "runtime/gaze/gaze_sample.h"

namespace gazeloop::sim {

/// What an eye tracker on HID usage page 0x12 says, in the layout that Microsoft published: bytes
/// only, for /dev/uhid or a test. Its screen is 527 x 296 mm; its viewer sits 600 mm in front of
/// the middle.
inline constexpr double kVirtualScreenWidth_m = 0.527;
inline constexpr double kVirtualScreenHeight_m = 0.296;
inline constexpr double kVirtualDistance_m = 0.6;
inline constexpr std::uint16_t kVirtualVendor = 0x1209;
inline constexpr std::uint16_t kVirtualProduct = 0xE7E7;
inline constexpr std::uint8_t kVirtualControlId = 0x14;

inline constexpr std::size_t kVirtualReportBytes = 65;
using VirtualReport = std::array<std::uint8_t, kVirtualReportBytes>;

[[nodiscard]] std::span<const std::uint8_t> virtual_tracker_descriptor();

// What it can be asked to send (Device Mode Request).
inline constexpr std::uint8_t kVirtualGaze = 1;
inline constexpr std::uint8_t kVirtualEyes = 2;

/// The input report of a sample: eyes where its rays begin, the gaze point between those of both
/// eyes on the screen. Without a valid eye, off the range of 2 m, and for what is not among the
/// `modes`, it says "no data".
[[nodiscard]] VirtualReport virtual_tracker_report(const gaze::GazeSample& sample,
                                                   std::uint64_t time_us,
                                                   std::uint8_t modes = kVirtualGaze |
                                                                        kVirtualEyes);

/// A feature report, id first; none for an id that it does not have.
[[nodiscard]] std::optional<std::vector<std::uint8_t>> virtual_tracker_feature(
    std::uint8_t id, std::uint16_t rate_hz);

}  // namespace gazeloop::sim
