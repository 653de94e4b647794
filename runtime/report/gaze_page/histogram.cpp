#include "runtime/report/gaze_page/histogram.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "runtime/memory/long_vector.h"

namespace gazeloop::report::page {
namespace {

double round_width(double least) {
    const double decade = std::pow(10.0, std::floor(std::log10(least)));
    constexpr std::array kSteps{1.0, 2.0, 5.0};
    const auto* const step = std::ranges::find_if(
        kSteps, [&](double times) { return decade * times >= least * (1.0 - 1e-9); });
    return decade * (step != kSteps.end() ? *step : 10.0);
}

}  // namespace

Histogram histogram(memory::LongVector<double> values, double finest) {
    constexpr double kBins = 40.0;
    std::erase_if(values, [](double value) { return !std::isfinite(value); });
    Histogram found{.known = values.size()};
    if (values.empty()) {
        return found;
    }
    std::ranges::sort(values);
    const double last =
        values[static_cast<std::size_t>(0.99 * static_cast<double>(values.size() - 1))];
    found.width = round_width(std::max((last - values.front()) / kBins, finest));
    found.first = std::floor(values.front() / found.width) * found.width;
    const auto bins = static_cast<std::size_t>((last - found.first) / found.width) + 1;
    found.counts.resize(bins);
    for (const double value : values) {
        const double place = (value - found.first) / found.width;
        if (place < static_cast<double>(bins)) {
            ++found.counts[static_cast<std::size_t>(place)];
        } else {
            ++found.above;
        }
    }
    return found;
}

}  // namespace gazeloop::report::page
