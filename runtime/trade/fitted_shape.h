#pragma once

#include <string>
#include <vector>

#include "runtime/error.h"
#include "runtime/trade/sweep.h"

namespace gazeloop::trade {

/// What is fitted: of a log-polar method (kfr, interleaved), the shape of its buffer (LpShape), and
/// of interleaved how many texels take turns, at so many times fewer samples than the picture has
/// pixels (mean over the cases' first frames, as planned).
struct FitQuestion {
    std::string method;
    double fewer = 12.0;
};

struct FittedShape {
    SweepPoint before;  ///< as the settings are, with the kfr.sigma that gives as few samples
    SweepPoint after;
    double loss_before = 0.0;  ///< mean over the cases of the first figure
    double loss_after = 0.0;
    unsigned tried = 0;  ///< shapes that were rendered
};

/// Looks for the shape that loses least by the first metric, along the question's cases. Errors
/// (Usage): a method that has no such buffer, a number of samples that no kfr.sigma gives, a metric
/// of which higher is better; as sweep().
Expected<FittedShape> fitted_shape(const vulkan::Context& context, const SweepQuestion& question,
                                   const SweptValues& values, settings::Settings& settings,
                                   const SweepHooks& hooks, const FitQuestion& fit);

/// The fitted settings as a file for --config; lines end in newlines. `made_by`: a command line.
[[nodiscard]] std::string fitted_toml(const FittedShape& fitted, const FitQuestion& fit,
                                      const SweepQuestion& question, const std::string& made_by);

}  // namespace gazeloop::trade
