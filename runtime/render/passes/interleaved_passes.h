#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <string_view>

#include "runtime/foveation/log_polar/log_polar_map.h"
#include "runtime/foveation/plans/cell_turns.h"
#include "runtime/render/passes/method_passes.h"

namespace gazeloop::render {

struct InterleavedConfig {
    /// Most visits that a texel's radiance is a mean of; 1: the last one alone.
    static constexpr std::uint32_t kMostVisits = 14;

    foveation::CellTurns texels{4};
    foveation::CellTurns pixels{4};  ///< of the disc
    std::uint32_t visits = 8;        ///< [1, kMostVisits]
    bool jitter = true;              ///< another place in their texel for the samples of each visit
    bool follow = true;  ///< what is kept follows view and gaze; else it stays in its texel
    bool hold = true;    ///< what is kept is held to what is shaded around it, where that changes
    /// What of it is resampled by Catmull and Rom's spline as it follows; the rest is bilinearly.
    enum class Sharp : std::uint8_t { Nothing, Disc, All };
    static constexpr std::array<std::string_view, 3> kSharpNames{"nothing", "disc", "all"};
    Sharp sharp = Sharp::All;
    bool refill = true;  ///< where nothing of use is kept, all places are shaded at once
};

/// KFR whose texels take turns: pass I and disc shade one cell of every block, keep
/// weaves them into what earlier frames left, resolve draws the picture. What is kept is forgotten
/// where a frame does not follow the one before, and at a cut (is_cut()), all of which a session
/// records. Throws SetupError (Usage) as lp_buffer_size reports.
[[nodiscard]] std::unique_ptr<MethodPasses> make_interleaved_passes(
    const PassSetup& setup, const InterleavedConfig& config,
    const foveation::KfrParameters& parameters);

}  // namespace gazeloop::render
