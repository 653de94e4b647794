#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "drivers/gaze_source.h"

namespace gazeloop::drivers {

/// What stands between a program and the eye gaze of an OpenXR runtime, in the order in which one
/// opens the next.
enum class GazeGate : std::size_t {
    Extension,   ///< the runtime lists XR_EXT_eye_gaze_interaction
    System,      ///< supportsEyeGazeInteraction
    Binding,     ///< the gaze action is bound to the eye gaze profile
    Focus,       ///< the session has the focus
    Active,      ///< the action is active: somebody wears it, and let us see
    Pose,        ///< the gaze's pose is tracked
    SampleTime,  ///< it is known when the eye was seen
};
inline constexpr std::size_t kGazeGateCount = 7;
/// As in names of checks.
inline constexpr std::array<std::string_view, kGazeGateCount> kGazeGateNames{
    "extension", "system", "binding", "focus", "active", "pose", "sample_time"};

/// "extension listed", and what opens the gate where it is shut for no special reason.
[[nodiscard]] std::string_view describe(GazeGate gate);
[[nodiscard]] std::string_view remedy(GazeGate gate);

struct GateState {
    bool open = false;
    // In words, which outlive everything (literals).
    std::string_view found;
    std::string_view remedy{};  ///< empty: the gate's own

    friend bool operator==(const GateState&, const GateState&) = default;
};

/// The gates of one run, and a line for each that changes. Pure.
class GazeGates {
  public:
    /// A gate that changes to and fro reports at most this many changes in such a time; after that,
    /// only the last of the changes in between.
    static constexpr std::uint32_t kMostChanges = 4;
    static constexpr std::int64_t kWindow_ns = 1'000'000'000;

    /// The state of a gate at `now_ns` (not before the previous call's). Allocates only where there
    /// is a change to report.
    void set(GazeGate gate, const GateState& state, std::int64_t now_ns);

    /// None before the gate was first reached.
    [[nodiscard]] const std::optional<GateState>& state(GazeGate gate) const;

    /// The first gate that is shut or was never reached; none if all are open.
    [[nodiscard]] std::optional<GazeGate> first_shut() const;

    /// The changes since the last call, "eye gaze: session focused: no (...)".
    [[nodiscard]] std::vector<SourceEvent> take_events();

  private:
    struct Gate {
        std::optional<GateState> now;
        std::optional<GateState> told;
        std::int64_t window_begin_ns = 0;
        std::uint32_t told_in_window = 0;
    };
    std::array<Gate, kGazeGateCount> gates_;
    std::vector<SourceEvent> events_;
};

}  // namespace gazeloop::drivers
