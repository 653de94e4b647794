#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "runtime/trade/sweep.h"

namespace gazeloop::trade {

/// What the rows rest on, for people.
struct SweepSubject {
    std::string display;
    std::string gaze;
    std::string device;  ///< the Vulkan device's name
};

/// A table, dearest point first.
[[nodiscard]] std::string sweep_text(const SweepSubject& subject, const SweepQuestion& question,
                                     std::vector<SweepRow> rows);
/// A line per point, in the order in which they were asked for; what is infinite is "inf".
[[nodiscard]] std::string sweep_csv(const std::vector<SweepRow>& rows);
/// What is infinite is null.
[[nodiscard]] nlohmann::ordered_json sweep_json(const SweepSubject& subject,
                                                const SweepQuestion& question,
                                                const std::vector<SweepRow>& rows);

}  // namespace gazeloop::trade
