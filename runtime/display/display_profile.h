#pragma once

#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "runtime/gaze/view.h"

namespace gazeloop::display {

/// How a panel gives its light.
enum class Illumination : std::uint8_t {
    Global,   ///< all rows at once
    Rolling,  ///< row after row, from the top of the picture to its bottom
};

/// What a display is taken to be: config/displays/NAME.toml. A figure that times photons and is
/// unknown is absent, never 0.
///
/// When a frame's light comes. The time that a runtime announces is the middle of the display's
/// emission, over the whole panel. Half of the scan-out lies before it and half after, so that no
/// scan-out must be added to it. A row at a share y of the picture's height (0 top, 1 bottom) emits
/// in the middle of its own light at
///
///     rolling:  announced + (y - 1/2) scan_out
///     global:   announced, whatever its row
///
/// and the photon that counts comes `switching` later, once the pixel has changed. Light lasts
/// `persistence`, half of it before and half after that middle, so it shifts no time.
struct DisplayProfile {
    std::string name;
    std::string description;
    gaze::PerEye<gaze::FieldOfView> fov;
    /// Each view is turned outward (left eye to the left, right eye to the right) by so much about
    /// the head's vertical axis; inward is negative. Fields of view are about the turned axis.
    gaze::PerEye<double> cant_outward_rad{};
    std::uint32_t width_px = 0;   ///< per eye
    std::uint32_t height_px = 0;  ///< per eye
    double refresh_hz = 0.0;
    double ipd_m = 0.063;
    std::optional<Illumination> illumination{};
    std::optional<std::int64_t> persistence_ns{};  ///< for how long a pixel is lit
    std::optional<std::int64_t> scan_out_ns{};     ///< from the first row's turn to the last one's
    std::optional<std::int64_t> switching_ns{};    ///< from a pixel's emission to its new colour
    std::vector<std::string> assumed{};  ///< keys of the figures that nobody has published

    [[nodiscard]] std::int64_t period_ns() const { return std::llround(1e9 / refresh_hz); }

    /// By how much the scan-out spreads the rows' photons: 0 with global illumination; unknown
    /// where the illumination is unknown.
    [[nodiscard]] std::optional<std::int64_t> rolling_ns() const;

    /// The figures in `assumed` that decide when photons come: "switching_ms, persistence_ms"; else
    /// empty.
    [[nodiscard]] std::string assumed_photons() const;
};

/// What one eye's picture of this size is rendered from, with the head at the origin.
[[nodiscard]] gaze::EyeView profile_view(const DisplayProfile& display, gaze::Eye eye,
                                         std::uint32_t width_px, std::uint32_t height_px);

}  // namespace gazeloop::display
