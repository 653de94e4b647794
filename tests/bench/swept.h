#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "runtime/display/display_profile.h"
#include "runtime/trade/sweep.h"
#include "runtime/trade/sweep_question.h"
#include "runtime/trade/sweep_rows.h"
#include "runtime/vulkan/context.h"
#include "tests/bench/bench.h"

namespace gazeloop::bench {

/// A sweep without cases over pictures of this size, judged by the contrast metric. `samples` per
/// texel or pixel where the options do not say.
trade::SweepQuestion question_of(const display::DisplayProfile& display, vk::Extent2D extent,
                                 const Options& options, std::uint32_t samples);

/// KFR as its paper chose it: sigma 1.8, alpha 4.
[[nodiscard]] trade::SweepPoint published_kfr();

inline constexpr const char* kInterleaved = "interleaved";

/// With one of so many texels shaded in each frame, and what else is set: key, text.
trade::SweepPoint interleaved(const char* sigma, const char* every,
                              const std::vector<std::pair<std::string, std::string>>& more = {});

/// From better than the published point of KFR to much fewer samples.
std::vector<trade::SweepPoint> interleaved_points();

/// So many frames of a scene with the gaze ahead.
trade::CaseQuestion still(std::string_view scene, std::size_t frames);

/// Measures it, with progress on stderr; `compared` is told of each frame. @throws SetupError for
/// what cannot be measured
std::vector<trade::SweepSheet> swept(
    const vulkan::Context& context, const trade::SweepQuestion& question,
    const std::vector<trade::SweepPoint>& points,
    const std::function<void(const trade::ComparedFrame&)>& compared = {});

/// @throws SetupError (Usage) for a point that has no figures
const trade::SweepRow& row_of(const std::vector<trade::SweepRow>& rows,
                              const trade::SweepPoint& point);

}  // namespace gazeloop::bench
