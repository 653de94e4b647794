#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "runtime/gaze/view.h"

namespace gazeloop::render {

/// How the viewer is carried through the scene, beside how the head moves: as somebody on a
/// platform that the scene knows nothing of. Gaze and head stay those on the platform.
enum class CameraMotion : std::uint8_t {
    Still,
    Pan,   ///< stands, and turns to the left and to the right by 15 deg, there and back in 6 s
    Fly1,  ///< goes round in a level circle of 0.2 m, facing as before, at 0.025 m/s
    Fly2,  ///< at twice the speed; and so on, up to 0.8 m/s
    Fly3,
    Fly4,
    Fly5,
    Fly6,
};
inline constexpr std::array<std::string_view, 8> kCameraMotionNames{
    "still", "pan", "fly-1", "fly-2", "fly-3", "fly-4", "fly-5", "fly-6"};

/// The views, in world, carried as far as at a scene time; at 0 they are the same but for the
/// circle's radius.
[[nodiscard]] gaze::StereoView carried(CameraMotion motion, const gaze::StereoView& views,
                                       double scene_time_s);

}  // namespace gazeloop::render
