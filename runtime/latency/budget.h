#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "runtime/latency/gaze_age.h"

namespace gazeloop::latency {

/// The stages as files and programs name them, by Stage.
inline constexpr std::array<std::string_view, kStageCount> kStageKeys{
    "tracker",    "delivery",         "queue",       "filter",   "submit", "gpu",
    "compositor", "wait_for_display", "scan_to_row", "switching"};

/// Whether each key is its stage's name with underscores.
[[nodiscard]] constexpr bool stage_keys_match() {
    return std::ranges::equal(kStageKeys, kStageNames, [](auto key, auto name) {
        return std::ranges::equal(key, name,
                                  [](char k, char n) { return k == (n == ' ' ? '_' : n); });
    });
}
static_assert(stage_keys_match());

/// How old the gaze may be when its picture is seen, in all and by stage: config/budgets/NAME.toml.
/// A part without a limit has none; it is never 0.
struct LatencyBudget {
    std::string name;
    std::string description;
    std::string source;                      ///< who says so: author, year, figure
    std::optional<std::int64_t> total_ns{};  ///< of GazeAge::at_display
    std::array<std::optional<std::int64_t>, kStageCount> stages_ns{};  ///< by Stage
};

}  // namespace gazeloop::latency
