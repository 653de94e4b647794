#include "runtime/trade/pattern_search.h"

#include <algorithm>
#include <cstddef>
#include <utility>

namespace gazeloop::trade {

Expected<Tried> pattern_search(const PatternSearch& search, const LossesAt& losses_at) {
    const auto first = losses_at(std::span(&search.start, 1));
    if (!first) {
        return std::unexpected(first.error());
    }
    Tried best{.place = search.start, .loss = first->front()};
    std::vector<double> moved(best.place.size());
    double step = search.step;
    for (unsigned round = 0; round < search.most_rounds && step >= search.least_step; ++round) {
        std::vector<std::vector<double>> places;
        for (std::size_t axis = 0; axis < best.place.size(); ++axis) {
            for (const double by : {-step, step}) {
                places.push_back(best.place);
                places.back()[axis] += by;
            }
        }
        if (std::ranges::any_of(moved, [](double by) { return by != 0.0; })) {
            places.push_back(best.place);
            for (std::size_t axis = 0; axis < moved.size(); ++axis) {
                places.back()[axis] += moved[axis];
            }
        }
        const auto losses = losses_at(places);
        if (!losses) {
            return std::unexpected(losses.error());
        }
        const auto least = std::ranges::min_element(*losses);
        if (!(*least < best.loss)) {
            step *= 0.5;
            std::ranges::fill(moved, 0.0);
            continue;
        }
        std::vector<double>& found = places[static_cast<std::size_t>(least - losses->begin())];
        for (std::size_t axis = 0; axis < moved.size(); ++axis) {
            moved[axis] = found[axis] - best.place[axis];
        }
        best = {.place = std::move(found), .loss = *least};
    }
    return best;
}

}  // namespace gazeloop::trade
