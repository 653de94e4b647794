#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "runtime/foveation/log_polar/log_polar_map.h"
#include "runtime/settings/settings.h"

namespace gazeloop::methods {

/// The settings kfr.*
struct KfrSettings {
    double sigma = 1.8;
    std::string kernel = "power";
    double alpha = 4.0;
    std::string polynomial = "1";
    std::string kernel_samples;
    std::string kernel_table;
    std::int64_t lp_width = 0;
    std::int64_t lp_height = 0;
    double aspect = 0.0;
    bool disc = true;
    bool close_hole = false;
    double border_px = 6.0;
};

[[nodiscard]] std::vector<settings::SettingRow> rows_of(KfrSettings& kfr);

/// Whether they fit together. Errors (Usage): which two do not, where they were set, and what would
/// fit. `all`, here and below, holds the rows of KfrSettings.
[[nodiscard]] Expected<void> check_kfr(const settings::Settings& all);

/// Puts what the file kfr.kernel_table holds into kfr.kernel_samples, if the kernel is a table and
/// a file is stated; kfr.kernel_table is empty then. So a session holds the samples, and its replay
/// needs no file. Errors (BadInput): the file cannot be read or is no kernel.
Expected<void> take_kernel_table(const KfrSettings& kfr, settings::Settings& all);

/// The method's parameters by these settings. Errors, with the place where each was set. Usage: a
/// polynomial that cannot be a kernel or is no list of numbers, a missing table. BadInput: samples
/// that are no kernel. Precondition: take_kernel_table.
Expected<foveation::KfrParameters> parameters(const KfrSettings& kfr,
                                              const settings::Settings& all);

}  // namespace gazeloop::methods
