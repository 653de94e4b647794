#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "runtime/frame/frame_record.h"
#include "runtime/latency/gaze_age.h"

namespace gazeloop::preview {

/// A text of fixed size, ended by zero: bars cross from one process to another as plain bytes.
using BarText = std::array<char, 24>;

/// One stage of a bar. An unknown duration has no length, and its name says that it is unknown.
struct BarSegment {
    BarText name;
    double ms = 0.0;
    bool known = false;
};

/// As many as the longest bar can have: none is left out.
inline constexpr std::size_t kBarSegments = std::max(latency::kStageCount, frame::kMostPasses);

/// Stages that follow each other.
struct StageBar {
    BarText title;
    std::array<BarSegment, kBarSegments> segments;
    std::uint32_t count = 0;
    double total_ms = 0.0;
    bool total_known = false;
};

/// Where one frame's time went: from the eye to the photon, and on the GPU.
struct StageBars {
    std::uint64_t frame = 0;
    bool any = false;        ///< false: no frame has been finished yet
    double budget_ms = 0.0;  ///< the display's period
    std::array<StageBar, 2> bars;
};

/// Of the display's profile, as latency::gaze_age.h has them.
struct DisplayTimes {
    std::int64_t period_ns = 0;
    std::optional<std::int64_t> switching_ns;
    std::optional<std::int64_t> rolling_ns;
};

/// The bars of a frame that the GPU has finished. `passes` are those of the run.
/// Precondition: both records are of the same frame.
[[nodiscard]] StageBars stage_bars(const frame::FrameRecord& frame,
                                   const frame::FrameGpuRecord& gpu, const frame::PassList& passes,
                                   const DisplayTimes& display);

/// How far the scale of both bars reaches: past the longest bar and the budget. At least 1 ms.
[[nodiscard]] double bar_scale_ms(const StageBars& bars);

}  // namespace gazeloop::preview
