#pragma once

#include <string>
#include <vector>

#include "runtime/quality/quality_totals.h"

namespace gazeloop::compare {

/// A figure that must not be worse than this.
struct Limit {
    std::string key;
    double value;
};

/// "FIGURE=NUMBER" each. @throws SetupError (Usage) for another text, and for a figure that a
/// comparison by `metrics` does not have
[[nodiscard]] std::vector<Limit> parse_limits(const std::vector<std::string>& texts,
                                              const quality::MetricChoice& metrics);

/// Whether all limits are kept; logs which are not. Precondition: each has a figure.
[[nodiscard]] bool within(const std::vector<Limit>& limits,
                          const std::vector<quality::QualityFigure>& figures);

}  // namespace gazeloop::compare
