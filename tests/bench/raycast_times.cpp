#include "tests/bench/raycast_times.h"

#include <fmt/core.h>

#include <algorithm>
#include <numeric>

namespace gazeloop::bench {
namespace {

double sum(const std::vector<double>& values) {
    return std::accumulate(values.begin(), values.end(), 0.0);
}

}  // namespace

void RaycastTimes::keep(const Contender& full, const Contender& method, const CostMap& costs,
                        const foveation::RadialMap& map) {
    full_ms_.push_back(full.median_ms());
    ms_.push_back(method.median_ms());
    pass_i_ms_.push_back(method.median_ms("pass_i"));
    disc_ms_.push_back(method.median_ms("disc"));
    resolve_ms_.push_back(method.median_ms("resolve"));
    predicted_ms_.push_back(resolve_ms_.back() + costs.predicted_ms(method.plan(), map));
    full_processor_ms_ += full.median_processor_ms();
    processor_ms_ += method.median_processor_ms();
    cells_.push_back(method.cells());
    full_cells_ = full.cells();
}

double RaycastTimes::speedup() const { return sum(full_ms_) / sum(ms_); }

double RaycastTimes::total_ms() const { return sum(ms_); }

double RaycastTimes::samples() const { return sum(cells_) / static_cast<double>(cells_.size()); }

void RaycastTimes::add_figures(std::string_view bench, std::string_view name,
                               std::string_view prefix, std::optional<double> target, bool passes,
                               std::vector<Figure>& figures) const {
    const auto add = [&](std::string_view metric, double value, std::string_view unit,
                         std::optional<double> bound, std::optional<double> goal,
                         std::string_view better) {
        figures.push_back({std::string(bench), std::string(name),
                           fmt::format("{}{}", prefix, metric), value, std::string(unit),
                           std::string(better), bound, goal});
    };
    const double frames = static_cast<double>(ms_.size());
    const double amdahl = sum(full_ms_) / sum(predicted_ms_);
    double least = speedup();
    for (std::size_t i = 0; i < ms_.size(); ++i) {
        least = std::min(least, full_ms_[i] / ms_[i]);
    }
    add("speedup", speedup(), "x", amdahl, target, "higher");
    add("speedup, processor", full_processor_ms_ / processor_ms_, "x", std::nullopt, std::nullopt,
        "higher");
    add("speedup, dearest view", least, "x", std::nullopt, std::nullopt, "higher");
    add("fewer samples", full_cells_ / samples(), "x", std::nullopt, std::nullopt, "higher");
    add("share of Amdahl", 100.0 * speedup() / amdahl, "%", 100.0, 90.0, "higher");
    if (!passes) {
        return;
    }
    for (const auto& [pass, times] : {std::pair{"full", &full_ms_},
                                      {"pass_i", &pass_i_ms_},
                                      {"disc", &disc_ms_},
                                      {"resolve", &resolve_ms_}}) {
        if (sum(*times) > 0.0) {
            add(pass, sum(*times) / frames, "ms", std::nullopt, std::nullopt, "lower");
        }
    }
}

}  // namespace gazeloop::bench
