#pragma once

#include <cstdint>
#include <optional>

#include "runtime/gaze/pose.h"

namespace gazeloop::gaze {

/// From this frame on, poses are given in another world than before: its origin has moved.
struct OriginChange {
    std::uint64_t frame = 0;
    Pose new_in_old{};       ///< the new world's origin, in the world before
    bool announced = false;  ///< as the runtime said; false: the head was taken to stand still
};

/// What a runtime says of its origin before it moves it.
struct AnnouncedOrigin {
    std::int64_t time_ns = 0;        ///< poses for this host time and later are in the new world
    std::optional<Pose> new_in_old;  ///< none: it does not say where the new origin is
};

/// A pose given in the world before, in the new one.
[[nodiscard]] inline Pose carried(const Pose& new_in_old, const Pose& pose) {
    const Pose moved = compose(inverse(new_in_old), pose);
    return {glm::normalize(moved.orientation), moved.position_m};
}

/// Where the new world's origin must be if the head stood still while it was moved: the head as
/// given in the world before, and in the new one.
[[nodiscard]] inline Pose new_origin_of_still_head(const Pose& in_old, const Pose& in_new) {
    const Pose origin = compose(in_old, inverse(in_new));
    return {glm::normalize(origin.orientation), origin.position_m};
}

}  // namespace gazeloop::gaze
