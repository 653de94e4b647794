#pragma once

#include <cstdint>

#include "sim/random.h"

namespace gazeloop::sim {

/// Which samples are lost: a given share, in gaps of a given mean length (a Markov chain of two
/// states; Gilbert 1960). If the mean length cannot give the share, gaps are longer.
class SampleLoss {
  public:
    /// `percent` 0 .. 100; 0 draws no numbers. `mean_samples`: of a gap; at least 1.
    SampleLoss(double percent, double mean_samples, const Random& random);

    /// Whether the next sample is lost.
    [[nodiscard]] bool next();

  private:
    double enter_ = 0.0;  ///< chance of a loss after a sample that was not lost
    double leave_ = 1.0;  ///< chance of a sample after a loss
    Random random_;
    bool lost_ = false;
};

}  // namespace gazeloop::sim
