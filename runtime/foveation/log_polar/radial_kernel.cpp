#include "runtime/foveation/log_polar/radial_kernel.h"

#include <fmt/format.h>

namespace gazeloop::foveation {

std::string RadialKernel::description() const {
    std::string text{name()};
    if (const auto* const power = std::get_if<PowerKernel>(&kind_)) {
        text += fmt::format(" {}", power->alpha);
    } else if (const auto* const printed = std::get_if<PrintedPowerKernel>(&kind_)) {
        text += fmt::format(" {}", printed->alpha);
    } else if (const auto* const polynomial = std::get_if<PolynomialKernel>(&kind_)) {
        text += fmt::format(" {}", fmt::join(polynomial->coefficients(), ", "));
    } else if (const auto* const table = std::get_if<TableKernel>(&kind_)) {
        text += fmt::format(" of {} samples", table->samples());
    }
    return text;
}

Expected<void> RadialKernel::check() const {
    const auto* const power = std::get_if<PowerKernel>(&kind_);
    const auto* const printed = std::get_if<PrintedPowerKernel>(&kind_);
    if (power == nullptr && printed == nullptr) {
        return {};
    }
    const double alpha = power != nullptr ? power->alpha : printed->alpha;
    if (!(alpha >= PowerKernel::kMinAlpha && alpha <= PowerKernel::kMaxAlpha)) {
        return std::unexpected(
            Error{ErrorKind::Usage, fmt::format("kfr.alpha = {}: must lie in [{}, {}]", alpha,
                                                PowerKernel::kMinAlpha, PowerKernel::kMaxAlpha)});
    }
    return {};
}

}  // namespace gazeloop::foveation
