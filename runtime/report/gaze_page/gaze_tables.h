#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "runtime/gaze/gaze_comparison.h"
#include "runtime/report/gaze_findings.h"
#include "runtime/report/gaze_page/gaze_bins.h"
#include "runtime/report/gaze_page/histogram.h"
#include "runtime/report/page/table.h"

namespace gazeloop::report::page {

/// Least, mean and greatest of two series in parts of the recording.
[[nodiscard]] Table angle_table(const GazeBins& bins, std::size_t first, std::size_t second,
                                const std::string& first_name, const std::string& second_name);
/// Means of two series and how far apart they are.
[[nodiscard]] Table difference_table(const GazeBins& bins, std::size_t first, std::size_t second);
/// The share of samples by event in parts of the recording.
[[nodiscard]] Table event_share_table(const GazeBins& bins);
[[nodiscard]] Table histogram_table(const Histogram& histogram, const std::string& quantity,
                                    const std::string& what);

/// Noise, and how often each eye was seen.
[[nodiscard]] Table precision_table(const GazeFindings& found);
[[nodiscard]] Table event_kind_table(const gaze::EventStatistics& statistics);
/// What was fitted beside what is published; no rows where nothing could be.
[[nodiscard]] Table sequence_table(const gaze::EventStatistics& statistics);
/// Saccades in bins of their amplitude, with what is published.
[[nodiscard]] Table saccade_table(std::span<const gaze::RecordedEvent> events);
/// Time in fixations by where the gaze was, 10 deg by 10 deg.
[[nodiscard]] Table place_table(std::span<const gaze::RecordedEvent> events);
[[nodiscard]] Table agreement_table(const gaze::GazeComparison& comparison);
/// The correlation every 100 ms.
[[nodiscard]] Table lag_table(const gaze::GazeComparison& comparison);

}  // namespace gazeloop::report::page
