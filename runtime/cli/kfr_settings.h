#pragma once

#include "runtime/cli/settings.h"
#include "runtime/foveation/log_polar_map.h"

namespace gazeloop::cli {

/// What the settings kfr.* say. Errors: a polynomial that cannot be a kernel or is no list of
/// numbers, a missing table (Usage); a table that cannot be read (BadInput).
Expected<foveation::KfrParameters> kfr_parameters(const SettingValues& values);

}  // namespace gazeloop::cli
