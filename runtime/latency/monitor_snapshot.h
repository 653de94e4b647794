#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

#include "runtime/gaze/fovea_point.h"
#include "runtime/latency/budget.h"
#include "runtime/latency/gaze_age.h"
#include "runtime/time/stamp.h"

namespace gazeloop::latency {

/// What a monitor watches in each frame: the gaze's age at display, the stages that it is made of,
/// and what of it no stage accounts for.
inline constexpr std::size_t kAgePart = 0;
inline constexpr std::size_t kFirstStagePart = 1;
inline constexpr std::size_t kUnaccountedPart = kFirstStagePart + kStageCount;
inline constexpr std::size_t kMonitorPartCount = kUnaccountedPart + 1;

/// The parts' names in that order.
[[nodiscard]] constexpr std::array<std::string_view, kMonitorPartCount> monitor_parts(
    std::string_view age, const std::array<std::string_view, kStageCount>& stages) {
    std::array<std::string_view, kMonitorPartCount> parts{age};
    std::ranges::copy(stages, parts.begin() + kFirstStagePart);
    parts[kUnaccountedPart] = "unaccounted";
    return parts;
}

/// For people and for programs.
inline constexpr auto kMonitorPartNames = monitor_parts("gaze age at display", kStageNames);
inline constexpr auto kMonitorPartKeys = monitor_parts("gaze_age_at_display", kStageKeys);

/// One part, over the window and over the run so far. Of frames whose foveae rest on a fresh
/// sample.
struct MonitorPart {
    std::optional<std::int64_t> limit_ns{};  ///< none: nothing is broken or kept
    bool broken = false;                     ///< see BudgetMonitor

    // Over the window. A percentile that too few frames support is withheld.
    std::uint64_t known = 0;    ///< frames that know it
    std::uint64_t unknown = 0;  ///< and that do not
    std::optional<std::int64_t> p50_ns{};
    std::optional<std::int64_t> p95_ns{};
    std::optional<std::int64_t> p99_ns{};

    // Over the run.
    std::uint64_t all_known = 0;
    std::uint64_t all_unknown = 0;
    std::uint64_t violations = 0;          ///< frames above the limit
    std::uint64_t longest_run_frames = 0;  ///< of violations without a frame that kept it between
    std::int64_t longest_run_ns = 0;       ///< see BudgetMonitor
};

/// Where a run stands with its budget.
struct MonitorSnapshot {
    time::Stamp time;                                  ///< the last frame in it woke up
    std::uint64_t frame = 0;                           ///< its index
    std::uint64_t frames = 0;                          ///< rendered, over the run
    std::uint64_t with_gaze = 0;                       ///< of them with fresh gaze
    std::uint64_t missed = 0;                          ///< of them shown later than announced
    gaze::FoveaState state = gaze::FoveaState::Ahead;  ///< of the last frame's worse eye

    std::int64_t window_ns = 0;       ///< from its first frame's wake-up to its last one's
    std::uint64_t window_frames = 0;  ///< rendered
    bool window_cut = false;          ///< it held more frames than there is room for
    /// Of the window's frames, by the state of the worse eye.
    std::array<std::uint64_t, gaze::kFoveaStateNames.size()> by_state{};
    /// How the ages in the window were obtained, percent of their length by stamp kind; the
    /// unaccounted part counts as unknown. Absent if no frame knows its age.
    std::optional<std::array<double, time::kStampKindCount>> share_by_kind_percent;
    std::array<MonitorPart, kMonitorPartCount> parts{};
};

}  // namespace gazeloop::latency
