#include "runtime/foveation/eye/mar_line.h"

#include <fmt/core.h>

namespace gazeloop::foveation {

Expected<void> check_mar_line(const MarLine& line) {
    // Written so that NaN is refused too.
    if (!(line.slope >= MarLine::kMinSlope && line.slope <= MarLine::kMaxSlope)) {
        return std::unexpected(Error{
            ErrorKind::Usage, fmt::format("MAR slope m = {}: must lie in [{}, {}]", line.slope,
                                          MarLine::kMinSlope, MarLine::kMaxSlope)});
    }
    if (!(line.omega0_deg >= MarLine::kMinOmega0Deg && line.omega0_deg <= MarLine::kMaxOmega0Deg)) {
        return std::unexpected(
            Error{ErrorKind::Usage,
                  fmt::format("MAR at the fovea, omega0 = {} degrees per cycle: "
                              "must lie in [{}, {}]",
                              line.omega0_deg, MarLine::kMinOmega0Deg, MarLine::kMaxOmega0Deg)});
    }
    return {};
}

}  // namespace gazeloop::foveation
