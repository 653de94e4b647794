#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <numbers>
#include <optional>
#include <string_view>

#include "runtime/gaze/fovea_point.h"
#include "runtime/gaze/gaze_sample.h"

namespace gazeloop::gaze {

/// What counts as lost gaze, and what then becomes of the fovea.
struct LossPolicy {
    std::int64_t stale_ns = 100'000'000;  ///< a sample older than this at the latch is stale
    /// Hold for this long after the last valid sample; less than stale_ns lets the fovea jump.
    std::int64_t hold_ns = 300'000'000;
    std::int64_t return_ns = 150'000'000;  ///< then return to straight ahead in this time
    double minimum_confidence = 0.6;       ///< a sample that states less is not valid
    /// In place of hold_ns while a blink, or an unplugged tracker, is the cause.
    std::int64_t blink_hold_ns = 300'000'000;
    std::int64_t unplugged_hold_ns = 300'000'000;
    /// After a blink, samples of so long are not used: gaze jumps while the lids still cover part
    /// of the pupil.
    std::int64_t reopen_ns = 0;
    double closed_below = 0.0;  ///< an eye that is less open than this is shut; 0: none is
    /// Gaze farther than this from straight ahead is none, radians.
    double field_rad = std::numbers::pi;
    bool hold_for_ever = false;  ///< never return to straight ahead
};

/// Where the machine is. Age comes on top: gaze that is Seen may be stale at the latch.
enum class GazePresence : std::uint8_t {
    Never,    ///< no valid sample yet
    Seen,     ///< the newest sample has a valid eye
    Shut,     ///< no eye is seen and one is closed, or they were lost since they closed
    Opening,  ///< open again, for less than reopen_ns
    Lost,     ///< no valid eye, for another cause
};
inline constexpr std::array<std::string_view, 5> kGazePresenceNames{"never", "seen", "shut",
                                                                    "opening", "lost"};

/// What of a sample can be used. An eye is valid if the tracker says so, its direction is finite
/// and not zero, its confidence is unknown or high enough, it is open, and it looks within the
/// field.
struct JudgedSample {
    PerEye<std::optional<glm::dvec3>> directions;  ///< unit vectors
    PerEye<LossCause> causes{};                    ///< why an eye has none
    /// Whether a direction may steer the fovea: not while the eyes are just opening.
    bool usable = false;
};

/// What the fovea is to do at a time.
struct LossCondition {
    FoveaState state = FoveaState::Ahead;  ///< of both eyes: never OtherEye
    LossReason reason = LossReason::Never;
    LossCause cause = LossCause::None;
    double returned = 0.0;  ///< 0 at the held point .. 1 straight ahead
};

/// Decides whether there is gaze, as a machine of explicit states that samples move:
///
///     from          sample                     to
///     any           usable, not after a blink  Seen
///     Seen, Lost    shut, no eye seen          Shut
///     Shut          open                       Opening, or Seen where reopen_ns is 0
///     Opening       open for reopen_ns         Seen
///     Opening       shut                       Shut
///     Shut, Opening lost while it was shut     as it was: a closed eye has no pupil to see
///     Seen, Lost    lost for another cause     Lost (that cause)
///     any but Never the tracker is gone        Lost (unplugged)
///
/// From Never only the first leads away. Time is an argument of condition(), and changes no state:
/// gaze that is Seen and stale has stopped; what was lost is held, returns, and rests ahead. Pure.
class LossMachine {
  public:
    explicit LossMachine(const LossPolicy& policy) : policy_(policy) {}

    /// A sample in the order of arrival. A sample whose time is before that of the sample added
    /// last changes nothing but the cause, should gaze become stale then. None for such a sample.
    std::optional<JudgedSample> add(const GazeSample& sample);

    /// The condition of the fovea of a frame whose gaze is read at this time. A sample is as old as
    /// its time says, and at least as old as its arrival. If neither is known, it counts as stale.
    [[nodiscard]] LossCondition condition(std::int64_t latched_ns) const;

    [[nodiscard]] GazePresence presence() const { return presence_; }
    /// Of Lost and Shut; None else.
    [[nodiscard]] LossCause cause() const { return cause_; }

  private:
    /// When a sample was taken and came.
    struct Times {
        time::Stamp sampled;
        time::Stamp arrived;
    };

    [[nodiscard]] LossCause why_unusable(const EyeRay& ray) const;
    [[nodiscard]] std::int64_t hold_ns(LossCause cause) const;
    [[nodiscard]] bool still_opening(const Times& now);
    void move(const JudgedSample& judged, bool gone, const Times& now);
    static std::int64_t age_ns(const Times& times, std::int64_t now_ns);

    LossPolicy policy_;
    GazePresence presence_ = GazePresence::Never;
    LossCause cause_ = LossCause::None;
    time::Stamp sampled_before_;   ///< of the sample added last, ignored or not
    bool went_back_ = false;       ///< that one was ignored
    std::optional<Times> newest_;  ///< of the sample taken last
    std::optional<Times> last_usable_;
    std::optional<std::int64_t> opened_ns_;  ///< since when the eyes are open again
};

}  // namespace gazeloop::gaze
