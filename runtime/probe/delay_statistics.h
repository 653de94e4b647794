#pragma once

#include <cstdint>
#include <optional>
#include <span>

namespace gazeloop::probe {

/// How far off a camera's times may be.
struct CameraErrors {
    double frame_ms = 0.0;      ///< between two frames
    double rate_percent = 0.0;  ///< of its frame rate, either way
    double fixed_ms = 0.0;      ///< of every delay alike, either way: rows, overexposure
};

/// What is known of a delay from its trials, milliseconds. A percentile p is withheld below 1 / (1
/// - p) trials, as in summaries.
struct DelayStatistics {
    std::uint64_t trials = 0;
    std::optional<double> mean_ms{};
    std::optional<double> sd_ms{};  ///< from 2 trials on
    std::optional<double> min_ms{};
    std::optional<double> p50_ms{};
    std::optional<double> p95_ms{};
    std::optional<double> max_ms{};

    // The mean is uncertain by the sum of these, either way.
    /// With 95 % confidence: the greater of what the trials scatter (Student's t times SD over
    /// sqrt(trials)) and one camera frame over sqrt(trials), which also bounds what a camera in
    /// step with the display does not show as scatter. Unknown below 2 trials.
    std::optional<double> uncertain_scatter_ms{};
    double uncertain_rate_ms = 0.0;
    double uncertain_fixed_ms = 0.0;

    [[nodiscard]] std::optional<double> uncertain_ms() const {
        return uncertain_scatter_ms
                   ? std::optional(*uncertain_scatter_ms + uncertain_rate_ms + uncertain_fixed_ms)
                   : std::nullopt;
    }
};

[[nodiscard]] DelayStatistics delay_statistics(std::span<const double> delays_ms,
                                               const CameraErrors& camera);

/// The factor on the standard error that gives a mean's 95 % confidence interval: Student's t,
/// 0.975, exact for 1 and 2 degrees of freedom, else by the expansion of Abramowitz and
/// Stegun 26.7.5 (within 0.1 %). Precondition: degrees > 0.
[[nodiscard]] double student_t_975(std::uint64_t degrees);

}  // namespace gazeloop::probe
