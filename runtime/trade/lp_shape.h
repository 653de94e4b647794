#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace gazeloop::trade {

/// The shape of a log-polar buffer as few numbers that may be anything, for a search: the logarithm
/// of its width over its height, and of the kernel's rise over each quarter but the last of [0, 1]
/// relative to that over the last. A kernel of these rises always (TableKernel).
struct LpShape {
    static constexpr std::size_t kNumbers = 4;
    /// Beyond these logarithms a quarter holds nothing, or all: the least rise is 7e-9.
    static constexpr double kMost = 9.0;

    std::array<double, kNumbers> numbers{};

    /// Of an aspect and the kernel x^alpha.
    [[nodiscard]] static LpShape power(double aspect, double alpha);
    /// Of a search's place; what lies beyond kMost is cut to it. Precondition: kNumbers numbers.
    [[nodiscard]] static LpShape of(std::span<const double> place);

    [[nodiscard]] double aspect() const;
    /// The kernel at a quarter, a half and three quarters.
    [[nodiscard]] std::array<double, kNumbers - 1> rises() const;
    /// kfr.aspect, kfr.kernel and kfr.kernel_samples.
    [[nodiscard]] std::vector<std::pair<std::string, std::string>> settings() const;
};

}  // namespace gazeloop::trade
