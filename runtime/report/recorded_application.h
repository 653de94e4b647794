#pragma once

#include "runtime/report/lag_facts.h"

namespace gazeloop::report {

/// Whether what drew the frames was another program, which the OpenXR API layer recorded: settings
/// of gazeloop's pictures and of its loop are none of its.
[[nodiscard]] inline bool is_of_another_program(const LagFacts& facts) {
    return !facts.device_value("application").empty();
}

}  // namespace gazeloop::report
