#pragma once

#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>

#include "runtime/frame/passes.h"
#include "runtime/latency/latency_summary.h"

namespace gazeloop::run {

/// What of its work a scene did not do, since nothing shown needs it.
struct LeftOut {
    std::span<const std::string> parts{};  ///< for people, each with its reason
    frame::PassList passes{};              ///< of the scene
};

/// A block of lines; empty where nothing was left out. A pass of the scene that ran in one frame
/// alone saved its time in all others: only that is known without doing the work.
[[nodiscard]] std::string left_out_text(const LeftOut& left_out,
                                        const latency::SummaryReport& report);

/// {"parts": [text], "ran_once": {PASS: {"ms": time, "frames_without": count}}}
[[nodiscard]] nlohmann::ordered_json left_out_json(const LeftOut& left_out,
                                                   const latency::SummaryReport& report);

}  // namespace gazeloop::run
