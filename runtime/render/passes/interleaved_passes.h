#pragma once

#include <cstdint>
#include <memory>

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
};

/// KFR whose texels take turns: pass I and disc shade one cell of every block, keep
/// weaves them into what earlier frames left, resolve draws the picture. What is kept is forgotten
/// where a frame does not follow the one before, and at a cut (is_cut()), all of which a session
/// records. Throws SetupError (Usage) as lp_buffer_size reports.
[[nodiscard]] std::unique_ptr<MethodPasses> make_interleaved_passes(
    const PassSetup& setup, const InterleavedConfig& config,
    const foveation::KfrParameters& parameters);

/// Whether nothing of the last frame can be of use: the eye moved over kCutStep_m or turned over
/// kCutTurn_rad, or scene time went on or back by over kCutTime_s.
struct CutPlace {
    gaze::Pose pose{};
    double scene_time_s = 0.0;
};
inline constexpr double kCutStep_m = 0.5;
inline constexpr double kCutTurn_rad = 0.7;
inline constexpr double kCutTime_s = 2.0;
[[nodiscard]] bool is_cut(const CutPlace& before, const CutPlace& now);

}  // namespace gazeloop::render
