#pragma once

#include "runtime/foveation/log_polar/log_polar_map.h"
#include "runtime/settings/settings.h"

namespace gazeloop::methods {

/// Puts what the file kfr.kernel_table holds into kfr.kernel_samples, where the kernel is a table
/// and a file is stated; the file is then stated no more. So a session holds the samples, and its
/// replay needs no file. Errors (BadInput): the file cannot be read or is no kernel.
Expected<void> take_kernel_table(settings::Settings& settings);

/// What the settings kfr.* say. Errors: a polynomial that cannot be a kernel or is no list of
/// numbers, a missing table (Usage); samples that are no kernel (BadInput); with the
/// place where it was set. Precondition: take_kernel_table.
Expected<foveation::KfrParameters> kfr_parameters(const settings::Settings& settings);

}  // namespace gazeloop::methods
