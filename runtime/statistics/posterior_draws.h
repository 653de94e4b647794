#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "runtime/statistics/people_posterior.h"

namespace gazeloop::statistics {

struct PosteriorDraw {
    PeoplePosterior::Parameters parameters;
    double weight = 0.0;  ///< of all draws' 1
};

/// Parameters as probable as the posterior has them, by importance sampling: draws from Student's
/// distribution about `best`, the top of the posterior, as wide as the information there; twice
/// anew about the mean and covariance of those before (population Monte Carlo, Cappe et al. 2004),
/// since the tails lie askew. The last third is kept. `draws`: at least 30 are made.
[[nodiscard]] std::vector<PosteriorDraw> draw_posterior(const PeoplePosterior& posterior,
                                                        const PeoplePosterior::Parameters& best,
                                                        std::uint64_t seed, std::size_t draws);

}  // namespace gazeloop::statistics
