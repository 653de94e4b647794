#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "tests/bench/bench.h"
#include "tests/bench/raycast_setup.h"

namespace gazeloop::bench {

/// What full resolution and one foveated method took for the same frames, and what Amdahl's law
/// predicts of it: every sample at what full resolution pays at its place, and the resolve.
class RaycastTimes {
  public:
    /// Keeps the medians of both since their reset. `map` is that of the method's last plan.
    void keep(const Contender& full, const Contender& method, const CostMap& costs,
              const foveation::RadialMap& map);

    [[nodiscard]] bool empty() const { return ms_.empty(); }
    [[nodiscard]] double speedup() const;
    [[nodiscard]] double total_ms() const;
    /// Cells that were shaded, the mean of the frames.
    [[nodiscard]] double samples() const;

    /// speedup with its bound, the same in processor time, that of the dearest frame, fewer
    /// samples, share of Amdahl's prediction; with passes, also the mean time of each. Metrics
    /// start with `prefix`.
    void add_figures(std::string_view bench, std::string_view name, std::string_view prefix,
                     std::optional<double> target, bool passes, std::vector<Figure>& figures) const;

  private:
    double full_processor_ms_ = 0.0;  ///< summed over the frames
    double processor_ms_ = 0.0;       ///< likewise
    std::vector<double> full_ms_;
    std::vector<double> ms_;
    std::vector<double> pass_i_ms_;
    std::vector<double> disc_ms_;
    std::vector<double> resolve_ms_;
    std::vector<double> predicted_ms_;
    std::vector<double> cells_;
    double full_cells_ = 0.0;
};

}  // namespace gazeloop::bench
