#pragma once

#include <array>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>

#include "runtime/error.h"
#include "runtime/foveation/log_polar/closed_form_kernels.h"
#include "runtime/foveation/log_polar/polynomial_kernel.h"
#include "runtime/foveation/log_polar/power_kernel.h"
#include "runtime/foveation/log_polar/table_kernel.h"

namespace gazeloop::foveation {

/// In the order of RadialKernel's alternatives.
inline constexpr std::array<std::string_view, 6> kKernelNames{
    "power", "power-as-printed", "polynomial", "sin", "exp", "table"};

/// The kernel of a log-polar map: a continuous K that rises from K(0) = 0 to K(1) = 1. With its
/// inverse and derivative, in double precision. One of the kinds in kKernelNames.
class RadialKernel {
  public:
    using Kind = std::variant<PowerKernel, PrintedPowerKernel, PolynomialKernel, SineKernel,
                              ExponentialKernel, TableKernel>;

    RadialKernel() = default;
    /// The power kernel of this alpha, variant B.
    RadialKernel(double alpha) : kind_(PowerKernel{alpha}) {}
    /// One of Kind's alternatives.
    template <typename K>
        requires(std::is_class_v<std::remove_cvref_t<K>> && std::is_constructible_v<Kind, K> &&
                 !std::is_same_v<std::remove_cvref_t<K>, RadialKernel>)
    RadialKernel(K&& kernel) : kind_(std::forward<K>(kernel)) {}

    /// K at x in [0, 1].
    [[nodiscard]] double operator()(double x) const {
        return std::visit([x](const auto& kernel) { return kernel(x); }, kind_);
    }
    /// The x in [0, 1] with K(x) = y, y in [0, 1].
    [[nodiscard]] double inverse(double y) const {
        return std::visit([y](const auto& kernel) { return kernel.inverse(y); }, kind_);
    }
    /// dK/dx; may be infinite at x = 0, and may be 0 at either end.
    [[nodiscard]] double derivative(double x) const {
        return std::visit([x](const auto& kernel) { return kernel.derivative(x); }, kind_);
    }

    [[nodiscard]] std::string_view name() const { return kKernelNames[kind_.index()]; }
    /// Name and parameters: "power 4", "table of 17 samples".
    [[nodiscard]] std::string description() const;
    [[nodiscard]] const Kind& kind() const { return kind_; }

    /// Errors (Usage): an alpha out of its range or not a number. The other kinds cannot be made
    /// from invalid parameters.
    [[nodiscard]] Expected<void> check() const;

  private:
    Kind kind_ = PowerKernel{};
};

}  // namespace gazeloop::foveation
