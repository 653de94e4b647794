#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

#include "runtime/quality/quality_totals.h"

namespace gazeloop::quality {

/// What was compared, and by what, for people.
struct ComparedThings {
    std::string reference;
    std::string test;
    std::string display;
    std::string gaze;  ///< as it was asked for
    ComparisonQuestion question;
    /// Frames for which the gaze was held, since its trace had ended.
    std::uint64_t held_frames = 0;
};

/// A table of the figures; of a sequence, with the worst frame (from 1) of each.
[[nodiscard]] std::string comparison_text(const ComparedThings& things,
                                          const QualityTotals& totals);

/// The same without `frames`. What is infinite (PSNR of equal pictures) is null.
[[nodiscard]] nlohmann::ordered_json comparison_json(const ComparedThings& things,
                                                     const QualityTotals& totals);

/// One entry of `frames`: the figures of one frame.
[[nodiscard]] nlohmann::ordered_json frame_json(std::uint64_t frame, const FrameQuality& quality);

}  // namespace gazeloop::quality
