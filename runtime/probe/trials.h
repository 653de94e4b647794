#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "runtime/probe/light_changes.h"

namespace gazeloop::probe {

/// A change of the lamp that the patch followed. Frames as in LightChange.
struct Trial {
    bool on = false;  ///< the lamp went on: the tracker lost the eye
    double lamp_frame = 0.0;
    double patch_frame = 0.0;

    [[nodiscard]] double delay_frames() const { return patch_frame - lamp_frame; }
};

struct PairedChanges {
    std::vector<Trial> trials;
    std::uint64_t lamp_alone = 0;   ///< the patch did not follow before the lamp's next change
    std::uint64_t patch_alone = 0;  ///< the patch changed without the lamp: a blink
};

/// Pairs each change of the lamp with the first change of the patch of the same kind that is not
/// earlier and comes before the lamp's next change. Both in the order of time.
[[nodiscard]] PairedChanges pair_changes(std::span<const LightChange> lamp,
                                         std::span<const LightChange> patch);

}  // namespace gazeloop::probe
