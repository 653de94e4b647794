#include "runtime/trade/lp_shape.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

namespace gazeloop::trade {
namespace {

constexpr std::size_t kQuarters = 4;

}  // namespace

LpShape LpShape::power(double aspect, double alpha) {
    std::array<double, kQuarters> rise{};
    for (std::size_t q = 0; q < kQuarters; ++q) {
        rise[q] = std::pow(static_cast<double>(q + 1) / kQuarters, alpha) -
                  std::pow(static_cast<double>(q) / kQuarters, alpha);
    }
    return of(std::array{std::log(aspect), std::log(rise[0] / rise[3]), std::log(rise[1] / rise[3]),
                         std::log(rise[2] / rise[3])});
}

LpShape LpShape::of(std::span<const double> place) {
    LpShape shape;
    for (std::size_t i = 0; i < kNumbers; ++i) {
        shape.numbers[i] = std::clamp(place[i], -kMost, kMost);
    }
    return shape;
}

double LpShape::aspect() const { return std::exp(numbers[0]); }

std::array<double, LpShape::kNumbers - 1> LpShape::rises() const {
    const std::array rise{std::exp(numbers[1]), std::exp(numbers[2]), std::exp(numbers[3])};
    const double all = rise[0] + rise[1] + rise[2] + 1.0;
    return {rise[0] / all, (rise[0] + rise[1]) / all, (rise[0] + rise[1] + rise[2]) / all};
}

std::vector<std::pair<std::string, std::string>> LpShape::settings() const {
    const auto y = rises();
    return {{"kfr.aspect", fmt::format("{:.4g}", aspect())},
            {"kfr.kernel", "table"},
            {"kfr.kernel_samples",
             fmt::format("0,0;0.25,{:.6g};0.5,{:.6g};0.75,{:.6g};1,1", y[0], y[1], y[2])}};
}

}  // namespace gazeloop::trade
