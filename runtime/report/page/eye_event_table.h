#pragma once

#include "runtime/report/eye_event_rows.h"
#include "runtime/report/page/page_tables.h"

namespace gazeloop::report::page {

/// Ages and errors by what the eyes did; without rows where nobody knows it.
[[nodiscard]] Table eye_event_table(const EyeEventRows& rows, const Percentiles& percentiles);

}  // namespace gazeloop::report::page
