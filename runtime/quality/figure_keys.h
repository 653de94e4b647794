#pragma once

#include <string>
#include <vector>

#include "runtime/error.h"
#include "runtime/quality/comparison.h"

namespace gazeloop::quality {

/// The figures that a comparison by these metrics has.
[[nodiscard]] std::vector<std::string> figure_keys(const MetricChoice& metrics);

/// Whether it has one of that name. Errors (Usage): it has not (nearest one named).
[[nodiscard]] Expected<void> check_figure(const std::string& key, const MetricChoice& metrics);

}  // namespace gazeloop::quality
