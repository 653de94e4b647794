#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "runtime/quality/comparison.h"

namespace gazeloop::quality {

/// One row of a comparison: a figure of one metric over all frames.
struct QualityFigure {
    std::string key;      ///< "ssim_weighted"; as in JSON
    std::string meaning;  ///< for people, with the model that it rests on
    bool lower_is_better = true;
    /// The mean of the frames' values; of PSNR that of the mean squared error.
    double mean = 0.0;
    double worst = 0.0;
    std::uint64_t worst_frame = 0;  ///< from 0
};

/// Gathers what was found of frames, in memory that no number of frames changes.
class QualityTotals {
  public:
    void add(const FrameQuality& frame);

    [[nodiscard]] std::uint64_t frames() const { return frames_; }
    /// In the order of the metrics; those that were not asked for are missing. Precondition: there
    /// was a frame.
    [[nodiscard]] std::vector<QualityFigure> figures() const;

  private:
    struct Total {
        double sum = 0.0;
        double worst = 0.0;
        std::uint64_t worst_frame = 0;
        bool any = false;
    };
    static constexpr std::size_t kFigures = 6 + kMechanisms;

    std::array<Total, kFigures> totals_;
    double pixels_per_degree_ = 0.0;  ///< FLIP's, at the first frame's gaze
    std::uint64_t frames_ = 0;
};

/// The figures of one frame, by key, as they enter the means.
[[nodiscard]] std::vector<std::pair<std::string, double>> figures_of(const FrameQuality& frame);

}  // namespace gazeloop::quality
