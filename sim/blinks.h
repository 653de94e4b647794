#pragma once

#include <cstdint>
#include <vector>

#include "sim/gaze_simulation.h"

namespace gazeloop::sim {

/// When the lids close. Pauses are at least half a second, exponential beyond; closures last 100 to
/// 400 ms (uniform), a third of it closing. The lids are open at 0 s.
class Blinks {
  public:
    Blinks(const EyeTerms& terms, std::uint64_t seed);

    /// Plans up to a time; to be called before anything is asked about that time.
    void plan_until(double time_s);

    /// 1 open .. 0 closed, at a time >= 0 s that was planned.
    [[nodiscard]] double openness(double time_s) const;

  private:
    struct Blink {
        double begin_s = 0.0;
        double duration_s = 0.0;
    };
    void add_blink();

    double mean_pause_s_ = 0.0;  ///< beyond the shortest; 0: no blinks
    std::uint64_t seed_;
    std::vector<Blink> blinks_;
};

}  // namespace gazeloop::sim
