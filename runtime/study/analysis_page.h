#pragma once

#include <string>

#include "runtime/study/analysis.h"

namespace gazeloop::study {

/// The analysis as one HTML page that needs nothing else: bars of yes with standard error, the
/// fitted functions over the answers, histograms of the subjects' thresholds, tables. Text of the
/// plan is shown and never becomes a part of the page's own language.
[[nodiscard]] std::string analysis_page(const StudyResult& result);

}  // namespace gazeloop::study
