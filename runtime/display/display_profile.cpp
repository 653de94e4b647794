#include "runtime/display/display_profile.h"

#include <glm/gtc/quaternion.hpp>
#include <string_view>

namespace gazeloop::display {

std::optional<std::int64_t> DisplayProfile::rolling_ns() const {
    if (!illumination) {
        return std::nullopt;
    }
    return *illumination == Illumination::Global ? 0 : scan_out_ns;
}

std::string DisplayProfile::assumed_photons() const {
    constexpr std::string_view kTable = "photons.";
    std::string text;
    for (const std::string& key : assumed) {
        if (key.starts_with(kTable)) {
            text += (text.empty() ? "" : ", ") + key.substr(kTable.size());
        }
    }
    return text;
}

gaze::EyeView profile_view(const DisplayProfile& display, gaze::Eye eye, std::uint32_t width_px,
                           std::uint32_t height_px) {
    const std::size_t e = gaze::index(eye);
    const double side = eye == gaze::Eye::Left ? -1.0 : 1.0;
    // About +Y, a positive angle turns to the left.
    const glm::dquat cant =
        glm::angleAxis(-side * display.cant_outward_rad[e], glm::dvec3{0.0, 1.0, 0.0});
    return {.pose = {.orientation = cant, .position_m = {side * display.ipd_m / 2.0, 0.0, 0.0}},
            .fov = display.fov[e],
            .width_px = width_px,
            .height_px = height_px};
}

}  // namespace gazeloop::display
