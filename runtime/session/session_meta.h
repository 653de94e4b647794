#pragma once

#include <span>
#include <string>
#include <vector>

#include "runtime/display/display_profile.h"
#include "runtime/latency/latency_summary.h"
#include "runtime/named_value.h"

namespace gazeloop::session {

/// What the table `meta` says of a run, without what the recorder itself keeps there.
struct SessionMeta {
    std::string program{};       ///< name and version
    std::string command_line{};  ///< as it was given
    std::string started_utc{};   ///< 2025-01-31T12:34:56Z
    latency::LoopClock clock = latency::LoopClock::Wall;
    std::string target{};         ///< where the pictures went
    std::string target_format{};  ///< of its pictures, as Vulkan names it
    /// XRT_METRICS_FILE of its environment, absolute: where Monado's service writes metrics of its
    /// own if it was started with the same.
    std::string runtime_metrics{};
    /// Name, period and everything that decides when photons come. Unknown values are absent,
    /// empty, or a refresh rate of 0.
    display::DisplayProfile display{};
};

/// The rows of `meta` for it. Unknown values have none.
std::vector<NamedValue> rows_of(const SessionMeta& meta);

/// What the rows say; the rest stays unknown. Rows of other names are ignored.
SessionMeta meta_of(std::span<const NamedValue> rows);

}  // namespace gazeloop::session
