#include "drivers/trace/trace_settings.h"

#include "drivers/trace/axes_correction.h"

namespace gazeloop::drivers {

std::vector<settings::SettingRow> rows_of(TraceSettings& trace) {
    using settings::Concerns;
    return {
        {"trace.accept_repairs", "read a trace of which much was dropped or changed",
         &trace.accept_repairs, Concerns::Input},
        {"trace.axes", "how a trace's directions are turned: none, -x, swap-eyes, -z or -x-z",
         settings::Choice{.value = &trace.axes,
                          .names = {kAxesCorrectionNames.begin(), kAxesCorrectionNames.end()},
                          .what = "correction"},
         Concerns::Input},
        {"trace.longest_gap_s", "a longer time without rows of a trace is played this long, s",
         settings::Number{&trace.longest_gap_s, 1e-3, 1e6}, Concerns::Input},
    };
}

ReadOptions read_options(const TraceSettings& trace) {
    return {.format = "auto",
            .axes = axes_correction_named(trace.axes),
            .accept_repairs = trace.accept_repairs,
            .longest_gap_s = trace.longest_gap_s};
}

}  // namespace gazeloop::drivers
