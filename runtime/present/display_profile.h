#pragma once

#include <cmath>
#include <cstdint>
#include <string>

#include "runtime/gaze/view.h"

namespace gazeloop::present {

/// What a display is taken to be: config/displays/NAME.toml.
struct DisplayProfile {
    std::string name;
    std::string description;
    gaze::PerEye<gaze::FieldOfView> fov;
    std::uint32_t width_px = 0;   ///< per eye
    std::uint32_t height_px = 0;  ///< per eye
    double refresh_hz = 0.0;
    double ipd_m = 0.063;
    std::int64_t switching_ns = 0;  ///< pixel switching, added to the middle of the emission

    [[nodiscard]] std::int64_t period_ns() const { return std::llround(1e9 / refresh_hz); }
};

}  // namespace gazeloop::present
