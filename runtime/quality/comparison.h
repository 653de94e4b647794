#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "runtime/error.h"
#include "runtime/foveation/eye/mar_line.h"
#include "runtime/quality/flip.h"
#include "runtime/quality/foveated_contrast.h"
#include "runtime/quality/row_work.h"

namespace gazeloop::quality {

enum class Metric : std::size_t { Contrast, Flip, Ssim, Psnr };
inline constexpr std::size_t kMetrics = 4;
inline constexpr std::array<std::string_view, kMetrics> kMetricNames{"contrast", "flip", "ssim",
                                                                     "psnr"};

/// Which metrics are asked for.
using MetricChoice = std::array<bool, kMetrics>;
inline constexpr MetricChoice kEveryMetric{true, true, true, true};

/// Those of these names; every one where there is no name. Errors (Usage): a name that no metric
/// has, with the nearest one.
[[nodiscard]] Expected<MetricChoice> metrics_named(const std::vector<std::string>& names);

/// By what pictures are compared.
struct ComparisonQuestion {
    gaze::EyeView view;  ///< the display's geometry, with the pictures' size
    gaze::Eye eye = gaze::Eye::Left;
    MetricChoice metrics = kEveryMetric;
    ContrastOptions contrast{};
    foveation::MarLine line{};  ///< which weighs PSNR and SSIM
    /// For how long each frame of a sequence is shown; none: stills.
    std::optional<double> frame_seconds{};
    bool with_maps = false;

    [[nodiscard]] bool asks(Metric metric) const {
        return metrics[static_cast<std::size_t>(metric)];
    }
};

/// A value over all pixels alike, and weighed by what the eye resolves.
struct PlainAndWeighted {
    double plain = 0.0;
    double weighted = 0.0;
};

/// What the metrics say of one frame; those that were not asked for say nothing.
struct FrameQuality {
    std::optional<ContrastDifference> contrast;
    std::optional<FlipResult> flip;
    double flip_pixels_per_degree = 0.0;  ///< at the gaze
    std::optional<PlainAndWeighted> ssim;
    std::optional<PlainAndWeighted> psnr_db;  ///< infinite where nothing differs
};

/// Compares frame after frame by one question.
class Comparison {
  public:
    /// Errors: as FoveatedContrast::create; a line that check_mar_line refuses; no metric (Usage).
    static Expected<Comparison> create(const ComparisonQuestion& question);

    /// `gaze` in the view frame. Errors: as FoveatedContrast::still() and next(), ssim() and
    /// ldr_flip().
    Expected<FrameQuality> compare(const render::LinearPicture& reference,
                                   const render::LinearPicture& test, const glm::dvec3& gaze);

    /// The next frame is the first of a sequence again.
    void forget() { contrast_.forget(); }

  private:
    Comparison(const ComparisonQuestion& question, FoveatedContrast contrast)
        : question_(question), contrast_(std::move(contrast)), work_(question.contrast.threads) {}

    ComparisonQuestion question_;
    FoveatedContrast contrast_;
    RowWork work_;
};

}  // namespace gazeloop::quality
