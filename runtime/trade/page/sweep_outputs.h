#pragma once

#include <span>
#include <string>

#include "runtime/report/output_file.h"
#include "runtime/trade/sweep_report.h"

namespace gazeloop::trade {

/// Where a sweep's report goes; empty: nowhere, "-": stdout, which then has nothing else.
struct SweepOutputs {
    std::string csv{};
    std::string json{};
    std::string html{};
    std::string fitted{};  ///< fitted_toml(); written before anything is measured
    std::string front{};   ///< a governor's levels
    bool text = true;
};

/// Checks all before a long sweep. Errors: as report::check_outputs().
Expected<void> check_outputs(const SweepOutputs& outputs,
                             std::span<const report::NamedFile> inputs);

/// Writes all. Errors: as choose(); a file that cannot be written (BadInput).
Expected<void> write_outputs(const SweepReport& report, const SweepOutputs& outputs);

}  // namespace gazeloop::trade
