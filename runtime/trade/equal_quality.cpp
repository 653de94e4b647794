#include "runtime/trade/equal_quality.h"

#include <algorithm>
#include <cmath>

namespace gazeloop::trade {
namespace {

/// The first figure, turned so that less is better.
double loss_of(const SweepRow& row) {
    const quality::QualityFigure& figure = row.figures.front();
    return figure.lower_is_better ? figure.mean : -figure.mean;
}

struct CostAtLoss {
    double loss;
    double log_saving;
};

/// The points that no other one of them beats in both, least loss first.
std::vector<CostAtLoss> front_of(std::vector<CostAtLoss> points) {
    std::ranges::sort(points, [](const CostAtLoss& a, const CostAtLoss& b) {
        return a.loss != b.loss ? a.loss < b.loss : a.log_saving > b.log_saving;
    });
    std::vector<CostAtLoss> front;
    for (const CostAtLoss& point : points) {
        if (front.empty() || point.log_saving > front.back().log_saving) {
            front.push_back(point);
        }
    }
    return front;
}

std::optional<double> saving_on(const std::vector<CostAtLoss>& front, double loss) {
    const auto after = std::ranges::upper_bound(front, loss, {}, &CostAtLoss::loss);
    if (after == front.begin()) {
        return std::nullopt;
    }
    const CostAtLoss& below = *std::prev(after);
    if (after == front.end() || !std::isfinite(below.loss)) {
        return std::exp(below.log_saving);
    }
    const double share = (loss - below.loss) / (after->loss - below.loss);
    return std::exp(below.log_saving + share * (after->log_saving - below.log_saving));
}

std::optional<Saving> saving_at_loss(const std::vector<SweepRow>& rows, std::string_view method,
                                     double loss) {
    std::vector<CostAtLoss> by_cells;
    std::vector<CostAtLoss> by_time;
    for (const SweepRow& row : rows) {
        if (row.error.empty() && row.point.method == method) {
            by_cells.push_back({loss_of(row), std::log(row.fewer_cells)});
            by_time.push_back({loss_of(row), std::log(row.speedup)});
        }
    }
    const auto fewer = saving_on(front_of(std::move(by_cells)), loss);
    const auto faster = saving_on(front_of(std::move(by_time)), loss);
    return fewer && faster ? std::optional(Saving{*fewer, *faster}) : std::nullopt;
}

}  // namespace

std::optional<Saving> saving_at(const std::vector<SweepRow>& rows, std::string_view method,
                                double level) {
    const SweepRow* const some = row_with_figures(rows);
    return some == nullptr ? std::nullopt
                           : saving_at_loss(rows, method,
                                            some->figures.front().lower_is_better ? level : -level);
}

EqualQuality equal_quality(const std::vector<SweepRow>& rows) {
    EqualQuality equal;
    const SweepRow* const some = row_with_figures(rows);
    if (some == nullptr) {
        return equal;
    }
    equal.figure = some->figures.front().key;
    equal.lower_is_better = some->figures.front().lower_is_better;
    std::vector<double> losses;
    for (const SweepRow& row : rows) {
        if (row.error.empty() && (row.on_cells_front || row.on_time_front)) {
            losses.push_back(loss_of(row));
        }
        if (std::ranges::find(equal.methods, row.point.method, &EqualQuality::OfMethod::method) ==
            equal.methods.end()) {
            equal.methods.push_back({.method = row.point.method});
        }
    }
    std::ranges::sort(losses);
    const auto doubled = std::ranges::unique(losses);
    losses.erase(doubled.begin(), doubled.end());
    const std::size_t count = std::min(losses.size(), kMostLevels);
    for (std::size_t i = 0; i < count; ++i) {
        const double loss =
            count == 1 ? losses.front() : losses[i * (losses.size() - 1) / (count - 1)];
        equal.levels.push_back(equal.lower_is_better ? loss : -loss);
        for (EqualQuality::OfMethod& method : equal.methods) {
            method.at.push_back(saving_at_loss(rows, method.method, loss));
        }
    }
    return equal;
}

}  // namespace gazeloop::trade
