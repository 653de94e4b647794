#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace gazeloop::gaze {

/// What the eyes do. The numbers are those that coders of the recordings of Andersson et al. 2017
/// (Behavior Research Methods 49:616) write, and those of a session's `fovea.event`.
enum class EyeEvent : std::uint8_t {
    Fixation = 1,
    Saccade = 2,
    Oscillation = 3,  ///< post-saccadic: the lens swings on after a saccade
    Pursuit = 4,      ///< smooth, after something that moves
    Lost = 5,         ///< a blink, or the tracker has no gaze, or no eye moves like this
};
/// By number less one.
inline constexpr std::array<std::string_view, 5> kEyeEventNames{"fixation", "saccade",
                                                                "oscillation", "pursuit", "lost"};

[[nodiscard]] constexpr std::string_view name(EyeEvent event) {
    return kEyeEventNames[static_cast<std::size_t>(event) - 1];
}

}  // namespace gazeloop::gaze
