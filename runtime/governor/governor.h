#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "runtime/fixed_text.h"
#include "runtime/gaze/fovea_point.h"
#include "runtime/governor/front.h"

namespace gazeloop::governor {

/// What the eyes do, as far as levels depend on it.
enum class EyeState : std::uint8_t {
    Fixation,  ///< or pursuit, or nobody asked the event detector
    Saccade,   ///< or the oscillation after it
    Blink,     ///< or the gaze has been lost for so short a while that it is still held
    Lost,      ///< the fovea is on its way ahead, or there
};
inline constexpr std::size_t kEyeStateCount = 4;
inline constexpr std::array<std::string_view, kEyeStateCount> kEyeStateNames{"fixation", "saccade",
                                                                             "blink", "lost"};

/// What the foveae of the last frame tell.
struct SeenEyes {
    EyeState state = EyeState::Lost;
    bool events_known = false;  ///< saccades and fixations are told apart

    friend bool operator==(const SeenEyes&, const SeenEyes&) = default;
};
[[nodiscard]] SeenEyes seen_eyes(const gaze::FrameFovea& fovea);

/// Why a level was taken or kept.
enum class Reason : std::uint8_t {
    Start,       ///< the best level that is expected to keep the budget
    OverBudget,  ///< two of the last three frames took longer
    NowAndThen,  ///< more than one frame in a hundred did, which the next level would have kept
    Room,        ///< the better level would have kept it for long enough
    Floor,       ///< the eyes' state allows no level so far down
    Held,        ///< kept, over the budget: nothing that the floor allows takes less time
};
inline constexpr std::size_t kReasonCount = 6;

/// One decision.
struct Decision {
    std::size_t from = 0;
    std::size_t to = 0;
    Reason reason = Reason::Start;
    EyeState state = EyeState::Lost;
    double ms = 0.0;         ///< what frames took at `from`; 0: unknown
    double budget_ms = 0.0;  ///< 0: unknown

    friend bool operator==(const Decision&, const Decision&) = default;
};
/// "level 2 -> 3: over the budget: 13.10 ms of 11.10 (fixation)"; for people, the best is level 1.
[[nodiscard]] FixedText<240> decision_text(const Decision& decision);

/// How a governor behaves.
struct GovernorOptions {
    /// A level is expected to keep the budget if it takes this share of it, a better one this.
    double keep_share = 0.9;
    double room_share = 0.8;
    std::size_t settle_frames = 30;     ///< that a better level must have had room in, 2 or more
    std::size_t patience_frames = 180;  ///< that a better level waits for a saccade or a blink
    /// The worst level that each state allows, by its place in the front.
    std::array<std::size_t, kEyeStateCount> worst{kMostLevels, kMostLevels, kMostLevels,
                                                  kMostLevels};
};

/// The worst levels of a front whose loss is at most that of the state's floor; 0 is no floor.
/// Errors (Usage): no level is as good as that.
Expected<std::array<std::size_t, kEyeStateCount>> worst_levels(
    const Front& front, const std::array<double, kEyeStateCount>& floors);

/// Decides, frame by frame, by which level of a measured front to draw, so that frames take no
/// longer than their budget. Worse at once; better late, slowly and, where events are known, in
/// saccades and blinks, which hide the change; a better level that could not be kept is tried again
/// after twice as long. Pure: no clock, no memory after construction.
class Governor {
  public:
    /// `cost`: of each level, any unit: only ratios count. Preconditions: 1 to kMostLevels, each
    /// finite and above 0.
    Governor(const GovernorOptions& options, std::span<const double> cost);

    /// Once before each frame. `budget_ms`: 0, negative or not finite is unknown, and then only
    /// floors count. None: nothing was decided anew.
    std::optional<Decision> next(const SeenEyes& eyes, double budget_ms);

    /// What a frame took by a level. What is no time (0, negative, not finite, over an hour) and
    /// what is of another level than the present one tells nothing.
    void measured(std::size_t level, double ms);

    [[nodiscard]] std::size_t level() const { return level_; }

  private:
    [[nodiscard]] Decision start(const SeenEyes& eyes);
    [[nodiscard]] std::optional<Decision> worse(const SeenEyes& eyes);
    [[nodiscard]] std::optional<Decision> better(const SeenEyes& eyes);
    Decision move_to(std::size_t level, Reason reason, EyeState state);
    [[nodiscard]] std::size_t worst_in(EyeState state) const;
    [[nodiscard]] std::size_t cheapest(std::size_t worst) const;
    /// What a frame is expected to take at a level, given one of `ms` at the present one.
    [[nodiscard]] double expected_ms(std::size_t level, double ms) const {
        return ms * (cost_[level] / cost_[level_]);
    }
    /// Of the last three frames (two, where there are no more) the second longest; 0: fewer.
    [[nodiscard]] double recent_ms() const;
    void forget();

    static constexpr std::size_t kRecent = 3;

    GovernorOptions options_;
    std::array<double, kMostLevels> cost_{};
    std::size_t levels_ = 0;
    std::size_t level_ = 0;
    double budget_ms_ = 0.0;
    bool started_ = false;
    bool held_ = false;        ///< and said so
    std::uint64_t frame_ = 0;  ///< decisions so far
    // At the present level:
    std::array<double, kRecent> recent_{};
    std::size_t measured_ = 0;
    std::size_t in_hundred_ = 0;      ///< frames of the present hundred
    std::size_t misses_ = 0;          ///< of them, over the budget where the next level is not
    std::size_t in_window_ = 0;       ///< frames of the present window of settle_frames
    double longest_ms_ = 0.0;         ///< of them
    double second_longest_ms_ = 0.0;  ///< so that one odd frame decides nothing
    std::size_t roomy_windows_ = 0;   ///< on end
    std::size_t waited_ = 0;          ///< frames for a saccade or a blink
    std::optional<std::uint64_t> rose_at_;  ///< to the present level, and it is not proven yet
    /// Windows that must have room before a step up to each level.
    std::array<std::size_t, kMostLevels> caution_{};
};

}  // namespace gazeloop::governor
