#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "runtime/gaze/eye.h"
#include "runtime/preview/pressed_ring.h"
#include "runtime/preview/stage_bars.h"

namespace gazeloop::preview {

/// The longest side of a previewed picture; larger ones are reduced to a whole fraction.
inline constexpr std::uint32_t kMaxSidePx = 1280;
inline constexpr std::size_t kBytesPerPixel = 4;

/// Which eyes a window shows, one bit each.
inline constexpr std::uint32_t kLeftEye = 1U << gaze::index(gaze::Eye::Left);
inline constexpr std::uint32_t kRightEye = 1U << gaze::index(gaze::Eye::Right);
inline constexpr std::uint32_t kBothEyes = kLeftEye | kRightEye;

/// "left", "right", "both" or nothing, which is both; 0: there is no such eye.
[[nodiscard]] constexpr std::uint32_t eyes_named(std::string_view text) {
    if (text.empty() || text == "both") {
        return kBothEyes;
    }
    if (text == "left") {
        return kLeftEye;
    }
    return text == "right" ? kRightEye : 0;
}

/// One eye's picture in the preview: its own pixels, origin top-left.
struct PreviewPicture {
    std::uint32_t width_px = 0;  ///< 0: not given
    std::uint32_t height_px = 0;
    float fovea_x_px = 0.0F;
    float fovea_y_px = 0.0F;
    float ring_radius_px = 0.0F;  ///< 0: no fovea, the picture is black
};

/// A frame as it is shown.
struct PreviewFrame {
    std::uint64_t index = 0;
    bool blue_first = false;  ///< bytes are B, G, R, A; else R, G, B, A
    gaze::PerEye<PreviewPicture> pictures;
    StageBars bars;  ///< of the last finished frame, a few before this one
};

/// What the loop's process and the window's process share. One picture at a time. The loop fills it
/// only while `given` < `asked`, then counts `given` up. The window reads it only while they are
/// equal, then asks for the next one. So neither waits for the other, and neither can tear the
/// other's picture.
struct PreviewMemory {
    std::atomic<std::uint64_t> asked{1};         ///< pictures the window has asked for
    std::atomic<std::uint64_t> given{0};         ///< pictures the loop has filled in
    std::atomic<std::uint32_t> eyes{kBothEyes};  ///< that the window shows
    /// The loop wants to know what is pressed, in the window and on game controllers; else keys
    /// choose what the window shows.
    std::atomic<bool> takes_presses{false};
    PressedRing presses;
    PreviewFrame frame;
    gaze::PerEye<std::array<std::byte, kBytesPerPixel * kMaxSidePx * kMaxSidePx>> pixels;
};
static_assert(std::atomic<std::uint64_t>::is_always_lock_free);
static_assert(std::atomic<bool>::is_always_lock_free);

}  // namespace gazeloop::preview
