#pragma once

#include <optional>
#include <string>
#include <vector>

#include "runtime/trade/sweep_rows.h"

namespace gazeloop::trade {

/// What a method saves where its pictures are as good as a level asks.
struct Saving {
    double fewer_cells = 0.0;
    double speedup = 0.0;
};

/// What each method needs for the same quality.
struct EqualQuality {
    std::string figure;  ///< the sweep's first
    bool lower_is_better = true;
    std::vector<double> levels{};  ///< the best one first
    struct OfMethod {
        std::string method;
        std::vector<std::optional<Saving>> at{};  ///< by level; none: no point is as good
    };
    std::vector<OfMethod> methods{};  ///< in the order of the rows
};

/// At the quality of the points on the fronts; of many, kMostLevels, evenly chosen, best and worst
/// among them. Between two points of a method (each as cheap as no better one of its own) the
/// logarithms of both savings are taken as straight in the figure; beyond its cheapest point it
/// saves what that one does. Empty: nothing was measured.
[[nodiscard]] EqualQuality equal_quality(const std::vector<SweepRow>& rows);

/// What a method saves at one level of the first figure; none: none of its points is as good.
[[nodiscard]] std::optional<Saving> saving_at(const std::vector<SweepRow>& rows,
                                              std::string_view method, double level);

inline constexpr std::size_t kMostLevels = 8;

}  // namespace gazeloop::trade
