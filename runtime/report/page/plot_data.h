#pragma once

#include <span>
#include <string>

#include "runtime/report/page/distribution.h"
#include "runtime/report/page/frame_plots.h"
#include "runtime/report/page/report_page.h"

namespace gazeloop::report::page {

/// What the page's script is told beside the packed frames, as JSON that may stand inside a script
/// element: nothing in it ends one.
[[nodiscard]] std::string plot_data(const PageContents& contents, const FramePlots& plots,
                                    std::span<const Violations> limits,
                                    std::span<const Distribution> at_latch_and_display);

}  // namespace gazeloop::report::page
