#pragma once

#include <cstdint>
#include <optional>

#include "runtime/latency/gaze_age.h"
#include "runtime/latency/pending_frames.h"

namespace gazeloop::latency {

/// When the display's light comes after the announced time, from its profile. Unknown where the
/// profile does not say.
struct PhotonTimes {
    std::optional<std::int64_t> switching_ns{};  ///< from a pixel's emission to the photon
    std::optional<std::int64_t> rolling_ns{};    ///< from the first row's emission to the last's
};

/// Where the time of one rendered frame went.
struct FrameAccount {
    frame::FrameStamps stamps;  ///< with the GPU's
    ShownFrame shown;
    gaze::FoveaState state = gaze::FoveaState::Ahead;  ///< of the worse eye
    /// Of the older gaze. Unknown throughout where the state is Ahead: the picture then rests on no
    /// gaze, and has no age.
    GazeAge age;

    /// Whether both foveae rest on a fresh sample.
    [[nodiscard]] bool with_gaze() const {
        return state == gaze::FoveaState::Tracking || state == gaze::FoveaState::OtherEye;
    }
};

/// `period_ns` is used where the frame itself was announced none; 0: unknown. Where the frame's
/// stamps are modelled (virtual time), the GPU's own, measured ones are left out.
[[nodiscard]] FrameAccount account_of(const FinishedFrame& finished, std::int64_t period_ns,
                                      const PhotonTimes& photons);

/// The frame's stamps, with the GPU's part as account_of takes it.
[[nodiscard]] frame::FrameStamps joined_stamps(const FinishedFrame& finished);

}  // namespace gazeloop::latency
