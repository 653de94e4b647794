#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "runtime/display/display_profile.h"

namespace gazeloop::run {

/// What to say where the runtime's display has another period than the profile, by over 1 %. None:
/// they agree, or the runtime's is not known (0 or less).
[[nodiscard]] std::optional<std::string> display_mismatch(std::int64_t period_ns,
                                                          const display::DisplayProfile& profile);

}  // namespace gazeloop::run
