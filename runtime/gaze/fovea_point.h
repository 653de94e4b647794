#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

#include "runtime/gaze/events/eye_event.h"
#include "runtime/gaze/eye.h"
#include "runtime/gaze/view.h"
#include "runtime/time/stamp.h"

namespace gazeloop::gaze {

/// What the fovea rests on.
enum class FoveaState : std::uint8_t {
    Tracking,   ///< a valid, fresh sample of this eye
    OtherEye,   ///< this eye is invalid, the other one's valid, fresh direction is used
    Held,       ///< no valid sample: the last valid point is held in world
    Returning,  ///< on the way from the held point to straight ahead
    Ahead,      ///< straight ahead: no gaze for longer than hold + return, or never any
};
inline constexpr std::array<std::string_view, 5> kFoveaStateNames{"tracking", "other-eye", "held",
                                                                  "returning", "ahead"};

/// Why the fovea is not tracking.
enum class LossReason : std::uint8_t {
    None,     ///< it is tracking
    Invalid,  ///< samples arrive, but neither eye is valid (a blink, a lost pupil)
    Stale,    ///< the newest sample is too old
    Never,    ///< no valid sample has arrived since the start
};
inline constexpr std::array<std::string_view, 4> kLossReasonNames{"none", "invalid", "stale",
                                                                  "never"};

/// What took the gaze away, in more detail than LossReason. A replay of a file from before there
/// were causes reads None.
enum class LossCause : std::uint8_t {
    None,           ///< it is tracking; or none is known
    NotSeen,        ///< the tracker vouches for neither eye
    Blink,          ///< the lids are closed, or were until just now
    LowConfidence,  ///< directions come with too little confidence
    OutsideField,   ///< directions point farther out than eyes or optics allow
    Unplugged,      ///< the tracker is gone
    Stopped,        ///< no sample comes any more, and nobody says why
    ClockStep,      ///< samples come with times before those that came already
};
inline constexpr std::array<std::string_view, 8> kLossCauseNames{
    "none",          "not seen",  "blink",   "low confidence",
    "outside field", "unplugged", "stopped", "clock step"};

/// Where one eye's fovea is in one frame.
struct FoveaPoint {
    PixelPosition position;                ///< finite always; may lie off screen
    glm::dvec3 direction{0.0, 0.0, -1.0};  ///< unit, in the eye's view frame
    FoveaState state = FoveaState::Ahead;
    LossReason reason = LossReason::Never;
    LossCause cause = LossCause::None;
    std::uint64_t sample_sequence = 0;  ///< of the sample it rests on; 0 with Never
    time::Stamp sampled;                ///< of that sample; unknown with Never
    time::Stamp arrived;
    time::Stamp ready;                           ///< of that sample, as in GazeSample
    std::optional<std::int64_t> uncertainty_ns;  ///< of `sampled`
    std::optional<double> parallax_rad;          ///< of that sample, as in GazeSample
    /// How far the eye may look from here when the frame is shown. With `gaze.widen` by the
    /// widening (gaze/fovea_uncertainty.h). Without it, what the prediction says: meant to hold in
    /// 95 % of cases, if no saccade begins before it is shown (GazePrediction says how often it
    /// does). None where neither is computed.
    std::optional<double> uncertainty_rad{};
    /// Whether a method is to shade as far around as uncertainty_rad says (`gaze.widen`). A session
    /// keeps the setting.
    bool widens = false;
    /// What the eyes did at the newest sample; none where nobody asked (MotionPolicy).
    std::optional<EyeEvent> event{};
    /// How far ahead of that sample the direction is predicted, 0: it is not extrapolated. None
    /// where nothing is predicted.
    std::optional<std::int64_t> horizon_ns{};
    /// How much older the direction is on average than its newest sample, because it is filtered.
    /// None without a filter.
    std::optional<std::int64_t> filter_delay_ns{};
};

/// The foveae of one frame: written once, before the frame's first gaze-dependent submit.
struct FrameFovea {
    PerEye<FoveaPoint> eyes;
    time::Stamp latched;  ///< when the gaze was read for the last time
};

}  // namespace gazeloop::gaze
