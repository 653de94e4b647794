#include "runtime/probe/trials.h"

#include <limits>

namespace gazeloop::probe {

PairedChanges pair_changes(std::span<const LightChange> lamp, std::span<const LightChange> patch) {
    // The two are told to a part of a frame: a patch that follows at once may seem a bit earlier.
    constexpr double kTolerance = 1.0;
    PairedChanges paired;
    std::size_t next = 0;
    for (std::size_t i = 0; i < lamp.size(); ++i) {
        const double begin = lamp[i].frame - kTolerance;
        const double end =
            i + 1 < lamp.size() ? lamp[i + 1].frame : std::numeric_limits<double>::infinity();
        bool followed = false;
        for (; next < patch.size() && patch[next].frame < end && !followed; ++next) {
            followed = patch[next].on == lamp[i].on && patch[next].frame >= begin;
            if (followed) {
                paired.trials.push_back({.on = lamp[i].on,
                                         .lamp_frame = lamp[i].frame,
                                         .patch_frame = patch[next].frame});
            } else {
                ++paired.patch_alone;
            }
        }
        paired.lamp_alone += followed ? 0 : 1;
    }
    paired.patch_alone += patch.size() - next;
    return paired;
}

}  // namespace gazeloop::probe
