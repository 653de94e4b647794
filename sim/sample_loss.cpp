#include "sim/sample_loss.h"

#include <algorithm>

namespace gazeloop::sim {

SampleLoss::SampleLoss(double percent, double mean_samples, const Random& random)
    : random_(random) {
    const double share = std::min(percent / 100.0, 1.0);
    if (share <= 0.0) {
        return;
    }
    if (share == 1.0) {
        enter_ = 1.0;
        leave_ = 0.0;
    } else {
        // Independent losses have gaps of 1 / (1 - share) on average; shorter ones would have to
        // avoid each other.
        leave_ = 1.0 / std::max(mean_samples, 1.0 / (1.0 - share));
        enter_ = std::min(1.0, leave_ * share / (1.0 - share));
    }
    lost_ = random_.uniform() < share;  // as if it had run for ever
}

bool SampleLoss::next() {
    if (enter_ > 0.0) {
        lost_ = random_.uniform() < (lost_ ? 1.0 - leave_ : enter_);
    }
    return lost_;
}

}  // namespace gazeloop::sim
