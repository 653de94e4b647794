#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "runtime/error.h"
#include "runtime/trade/sweep_rows.h"

namespace gazeloop::trade {

/// A figure that must be at least this good.
struct QualityFloor {
    std::string key;
    double value = 0.0;
};

/// "FIGURE=NUMBER". Errors (Usage): not that, or a number that is not finite.
Expected<QualityFloor> parse_floor(const std::string& text);

/// What a user can afford, and what it must look like.
struct ChoiceQuestion {
    std::optional<double> budget_ms{};  ///< for all passes of a frame, median
    std::vector<QualityFloor> floors{};

    [[nodiscard]] bool asked() const { return budget_ms || !floors.empty(); }
    /// "at most 11.1 ms, contrast at most 1.5".
    [[nodiscard]] std::string text(const std::vector<SweepRow>& rows) const;
};

/// Of the rows that keep budget and floors: the fastest where there is a floor, else the best by
/// the first figure. None: no row keeps them. Errors (Usage): a floor of a figure that the rows do
/// not have.
Expected<std::optional<std::size_t>> choose(const std::vector<SweepRow>& rows,
                                            const ChoiceQuestion& question);

}  // namespace gazeloop::trade
