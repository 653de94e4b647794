#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace gazeloop::statistics {

/// A share of yeses and the interval in which it lies at a level.
struct Proportion {
    std::uint64_t yes = 0;
    std::uint64_t trials = 0;
    double share = 0.0;  ///< NaN without trials
    double low = 0.0;    ///< in [0, share]
    double high = 1.0;   ///< in [share, 1]
};

/// By the score interval of Wilson (1927), which holds for few trials and for shares of 0 and 1
/// too. Without trials nothing is known: [0, 1]. Preconditions: yes <= trials, level in (0, 1).
[[nodiscard]] Proportion wilson_interval(std::uint64_t yes, std::uint64_t trials,
                                         double level = 0.95);

/// Of subjects whose answers changed from one treatment to the other: so many said yes to the
/// first alone, so many to the second alone. The two-sided p of McNemar's test (1947), exact by the
/// binomial distribution, within 1e-12. 1 if nobody's changed.
[[nodiscard]] double mcnemar_p(std::uint64_t first_alone, std::uint64_t second_alone);

/// Raises p values of tests made together, so that one false alarm among all of them stays as rare
/// as each of them promises (Holm 1979). In the order given; each is at most 1.
[[nodiscard]] std::vector<double> holm(std::span<const double> p);

}  // namespace gazeloop::statistics
