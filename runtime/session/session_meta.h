#pragma once

#include <span>
#include <string>
#include <vector>

#include "runtime/display/display_profile.h"
#include "runtime/latency/latency_summary.h"
#include "runtime/named_value.h"

namespace gazeloop::session {

/// What the table `meta` says of a run, beside what the recorder itself keeps there.
struct SessionMeta {
    std::string program{};       ///< name and version
    std::string command_line{};  ///< as it was given
    std::string started_utc{};   ///< 2025-01-31T12:34:56Z
    latency::LoopClock clock = latency::LoopClock::Wall;
    std::string target{};         ///< where the pictures went
    std::string target_format{};  ///< of its pictures, as Vulkan names it
    /// Name, period and all that decides when photons come. What is unknown is absent, empty, or
    /// a refresh rate of 0.
    display::DisplayProfile display{};
};

/// The rows that keep it; what is unknown has none.
std::vector<NamedValue> rows_of(const SessionMeta& meta);

/// What the rows say, as far as they do. Rows of other names mean nothing here.
SessionMeta meta_of(std::span<const NamedValue> rows);

}  // namespace gazeloop::session
