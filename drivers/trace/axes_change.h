#pragma once

#include <utility>

#include "runtime/gaze/gaze_sample.h"

namespace gazeloop::drivers {

/// What is done to every sample's rays before they are used.
struct AxesChange {
    bool swap_eyes = false;
    bool mirror_directions_x = false;
    bool mirror_places_x = false;
    bool mirror_directions_z = false;
    bool nothing_behind = false;  ///< an eye that then looks behind the head is not valid

    void apply_to(gaze::GazeSample& sample) const {
        if (swap_eyes) {
            std::swap(sample.eyes[0], sample.eyes[1]);
        }
        for (gaze::EyeRay& ray : sample.eyes) {
            ray.direction.x *= mirror_directions_x ? -1.0 : 1.0;
            ray.direction.z *= mirror_directions_z ? -1.0 : 1.0;
            ray.origin_m.x *= mirror_places_x ? -1.0 : 1.0;
            ray.valid = ray.valid && !(nothing_behind && ray.direction.z > 0.0);
        }
    }
};

}  // namespace gazeloop::drivers
