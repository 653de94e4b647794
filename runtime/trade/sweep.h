#pragma once

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "runtime/methods/method_settings.h"
#include "runtime/quality/comparison.h"
#include "runtime/quality/quality_totals.h"
#include "runtime/settings/settings.h"
#include "runtime/trade/sweep_points.h"
#include "runtime/vulkan/context.h"

namespace gazeloop::trade {

/// What every point of a sweep renders: the same frames, both eyes, into pictures that no display
/// shows; one eye's are compared.
struct SweepQuestion {
    gaze::StereoView views;
    std::string scene;
    std::uint32_t samples = 1;             ///< per texel or pixel
    std::uint32_t reference_samples = 16;  ///< of full resolution, which is the reference
    /// Each eye's direction of gaze in its view frame, by frame; not empty.
    std::vector<gaze::PerEye<glm::dvec3>> gaze{};
    double frame_seconds = 1.0 / 90.0;
    unsigned rounds = 3;  ///< of which times are the medians
    /// Its view is that of its eye. More than one frame: a sequence.
    quality::ComparisonQuestion comparison{};
};

/// A time in ms: the median of the rounds' means over the frames, and their extremes.
struct SweepTime {
    double median_ms = 0.0;
    double least_ms = 0.0;
    double greatest_ms = 0.0;
};

struct SweepRow {
    SweepPoint point;
    std::string error;   ///< why it could not be rendered; all else is then empty
    double cells = 0.0;  ///< shaded per frame, both eyes; each takes `samples` rays
    SweepTime time;      ///< of all passes of a frame
    /// How much faster than full resolution with as many samples per pixel, by the rounds' ratios.
    double speedup = 0.0;
    double fewer_cells = 0.0;  ///< than full resolution
    /// Cells over the fewest that the comparison's acuity line asks for, both eyes, mean of the
    /// frames (foveation::fewest_samples).
    double cells_over_fewest = 0.0;
    std::vector<std::pair<std::string, double>> pass_ms{};  ///< medians of the rounds, by pass
    std::vector<quality::QualityFigure> figures{};
    /// Whether no other point is both cheaper (cells; time) and better by the first figure.
    bool on_cells_front = false;
    bool on_time_front = false;
};

struct SweepHooks {
    std::function<void(const std::string& said)> progress;
    std::function<bool()> interrupted;
};

/// Renders and compares. The first row is full resolution with the same samples as the others.
/// Quality first, each point with a history of its own and new; then the timed rounds, in turns.
/// `values` are those whose rows `settings` hold; they are as before in the end. A point that fails
/// says so in its row. Errors: as scene and device (SetupError is thrown); Usage where the
/// reference's frames take more than kMostReferenceBytes, Interrupted.
Expected<std::vector<SweepRow>> sweep(const vulkan::Context& context, const SweepQuestion& question,
                                      const std::vector<SweepPoint>& points,
                                      const methods::MethodSettings& values,
                                      settings::Settings& settings, const SweepHooks& hooks);

inline constexpr std::uint64_t kMostReferenceBytes = std::uint64_t{4} << 30U;

}  // namespace gazeloop::trade
