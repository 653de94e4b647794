#pragma once

#include <optional>
#include <string>
#include <vector>

#include "runtime/display/display_profile.h"
#include "runtime/foveation/eye/mar_line.h"
#include "runtime/quality/comparison.h"
#include "runtime/report/output_file.h"

namespace gazeloop::compare {

/// Which pictures are held against each other, by what, and where the result goes.
struct CompareQuestion {
    std::string reference;  ///< a PNG, or a folder of numbered PNG frames
    std::string test;       ///< the same
    display::DisplayProfile display{};
    gaze::Eye eye = gaze::Eye::Left;
    std::string gaze;  ///< see recordings::ComparedGaze::parse
    quality::MetricChoice metrics = quality::kEveryMetric;
    quality::ContrastOptions contrast{};
    foveation::MarLine line{};
    std::vector<std::string> limits{};  ///< see parse_limits
    /// Of a sequence; none: the display's refresh rate.
    std::optional<double> frames_per_second{};
    std::string heat_map;                    ///< a file, of a sequence a folder; empty: none
    std::string json;                        ///< "-": stdout; empty: not asked for
    std::vector<report::NamedFile> reads{};  ///< what else is read: none of it is written over
    bool quiet = false;                      ///< no table on stdout
};

/// Compares frame by frame, writes what was asked for, and gives whether every limit was kept.
/// @throws SetupError: Usage for what does not fit together, BadInput for pictures and gaze that
/// cannot be read or compared, and for outputs that cannot be written
[[nodiscard]] bool compare_pictures(const CompareQuestion& question);

}  // namespace gazeloop::compare
