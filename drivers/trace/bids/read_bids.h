#pragma once

#include <filesystem>
#include <string_view>

#include "drivers/trace/built_trace.h"
#include "drivers/trace/read_options.h"
#include "runtime/error.h"

namespace gazeloop::drivers {

inline constexpr std::string_view kBids = "bids";

/// Reads an eye tracking recording of BIDS 1.11: `file` is one eye's *_physio.tsv.gz, without a
/// header line. Its sidecars are found by the rule of inheritance (bids_files.h) and held against
/// bids_rules.h. Where its name has the entity recording-eye1, -eye2 or -eye3, the other eyes'
/// files beside it are read too, and rows of the same time become one sample.
///
/// - gaze-on-screen: by StimulusPresentation of the events' JSON (ScreenGeometry); pixel, m, cm,
/// mm.
/// - eye-in-head: x is taken for the azimuth, positive right, y for the elevation, positive up; deg
///   or rad.
/// - gaze-in-world and custom have no direction in a head, and are refused.
///
/// "n/a" in x or y is an eye that was not seen; so is one during an event of *_physioevents.tsv.gz
/// whose trial_type is "blink", or whose column blink is 1; onsets are timestamps, or rows where
/// OnsetSource is "n/a".
/// Columns that write_bids adds are read where they are: eye_openness, confidence, origin_x_m to
/// origin_z_m and head_x_m to head_qw.
///
/// Each file's clock is judged by itself before rows are put together (joined_eyes.h).
///
/// Errors (BadInput): no sidecar, a broken rule, an unknown unit, a row of another width, those of
/// CsvTable and TraceBuilder.
[[nodiscard]] Expected<BuiltTrace> read_bids(const std::filesystem::path& file,
                                             const ReadOptions& options);

}  // namespace gazeloop::drivers
