#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "runtime/trade/sweep_rows.h"

namespace gazeloop::trade {

/// How one quantity of a method follows its settings: quantity = factor * product of
/// setting^exponent, fitted to the logarithms by least squares.
struct PowerLaw {
    std::string quantity;  ///< "cells_per_frame", "time_ms" or the first figure's key
    double factor = 0.0;
    std::vector<std::pair<std::string, double>> exponents{};  ///< by setting
    /// Of measured over fitted: squares summed, over points less terms. So it may exceed the worst.
    double standard_error_percent = 0.0;  ///< as PowerLaw's
    double worst_percent = 0.0;           ///< the largest, either way
    std::string worst_at{};               ///< the point's settings
};

/// How a method's time follows what it shades: ms = fixed_ms + cells * ns_per_cell, fitted to
/// relative residuals by least squares.
struct TimeLine {
    double fixed_ms = 0.0;
    double ns_per_cell = 0.0;
    double standard_error_percent = 0.0;
    double worst_percent = 0.0;
    std::string worst_at{};
};

struct MethodFit {
    std::string method;
    std::size_t points = 0;
    std::vector<PowerLaw> laws{};
    std::optional<TimeLine> time{};
    /// What was left out, or why there is no fit: "kfr.kernel is no number".
    std::vector<std::string> notes{};
};

/// For each method that has points. A law needs more points than terms, and settings that vary
/// independently; a quantity that is 0 or infinite somewhere has none.
[[nodiscard]] std::vector<MethodFit> setting_fits(const std::vector<SweepRow>& rows);

}  // namespace gazeloop::trade
