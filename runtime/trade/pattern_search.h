#pragma once

#include <functional>
#include <span>
#include <vector>

#include "runtime/error.h"

namespace gazeloop::trade {

/// A place and what is lost there; infinite where it is impossible.
struct Tried {
    std::vector<double> place;
    double loss = 0.0;
};

struct PatternSearch {
    std::vector<double> start;
    double step = 0.4;        ///< both ways along each axis; halved where none of them helps
    double least_step = 0.1;  ///< the last one that is tried
    unsigned most_rounds = 40;
};

/// The losses at places, as many. An error ends the search.
using LossesAt =
    std::function<Expected<std::vector<double>>(std::span<const std::vector<double>> places)>;

/// The best place that a compass search finds (Hooke and Jeeves 1961): each round asks for all
/// neighbours at once, and for where the last move leads if it is made again. Takes no place that
/// is not better. Deterministic. Errors: those of `losses_at`. Precondition: a start.
[[nodiscard]] Expected<Tried> pattern_search(const PatternSearch& search,
                                             const LossesAt& losses_at);

}  // namespace gazeloop::trade
