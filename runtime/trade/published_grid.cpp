#include "runtime/trade/published_grid.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>

namespace gazeloop::trade {
namespace {

constexpr std::array kAlphas{"1", "2", "3", "4"};
constexpr std::array kSigmas{"1.0", "1.2", "1.4", "1.6", "1.8", "2.0", "2.2",
                             "2.4", "2.6", "2.8", "3.0", "3.2", "3.4", "3.6"};

SweepPoint point_of(const std::string& sigma, const std::string& alpha) {
    return {.method = "kfr", .settings = {{"kfr.sigma", sigma}, {"kfr.alpha", alpha}}};
}

const SweepRow* find(const std::vector<SweepRow>& rows, const SweepPoint& point) {
    const auto found = std::ranges::find(rows, point, &SweepRow::point);
    return found == rows.end() || !found->error.empty() ? nullptr : &*found;
}

}  // namespace

std::vector<SweepPoint> published_grid() {
    std::vector<SweepPoint> points;
    for (const char* const sigma : kSigmas) {
        for (const char* const alpha : kAlphas) {
            points.push_back(point_of(sigma, alpha));
        }
    }
    points.push_back(point_of("1.8", "5"));
    points.push_back(point_of("1.8", "6"));
    return points;
}

SweepPoint published_choice() { return point_of("1.8", "4"); }

std::vector<std::string> against_published(const std::vector<SweepRow>& rows) {
    const SweepRow* const choice = find(rows, published_choice());
    if (choice == nullptr) {
        return {};
    }
    const quality::QualityFigure& figure = choice->figures.front();
    std::vector<std::string> lines{fmt::format(
        "Published choice (Meng et al. 2018: sigma 1.8, alpha 4; at least 80 % of answers "
        "\"identical\"): {:.2f}x fewer cells, {:.2f}x faster, {} {:.4g}",
        choice->fewer_cells, choice->speedup, figure.key, figure.mean)};
    for (const char* const alpha : kAlphas) {
        const char* last = nullptr;   // that is no worse than the choice
        const char* first = nullptr;  // that is worse
        for (const char* const sigma : kSigmas) {
            const SweepRow* const row = find(rows, point_of(sigma, alpha));
            if (row == nullptr || first != nullptr) {
                continue;
            }
            const double mean = row->figures.front().mean;
            const bool within = figure.lower_is_better ? mean <= figure.mean : mean >= figure.mean;
            (within ? last : first) = sigma;
        }
        if (last == nullptr && first == nullptr) {
            continue;
        }
        lines.push_back(
            last == nullptr
                ? fmt::format("alpha {}: worse than that from sigma {} on", alpha, first)
            : first == nullptr
                ? fmt::format("alpha {}: no worse than that up to sigma {}", alpha, last)
                : fmt::format("alpha {}: no worse than that up to sigma {}, worse at {}", alpha,
                              last, first));
    }
    return lines.size() > 1 ? lines : std::vector<std::string>();
}

}  // namespace gazeloop::trade
