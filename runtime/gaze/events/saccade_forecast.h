#pragma once

#include <array>
#include <cstddef>

namespace gazeloop::gaze {

/// A saccade that is going on, as seen so far.
struct SaccadeInFlight {
    double travelled_deg = 0.0;  ///< from where it began; 0 or more
    double elapsed_s = 0.0;      ///< since it was noticed
    double speed_deg_per_s = 0.0;
    double peak_deg_per_s = 0.0;   ///< the greatest speed so far; at least speed_deg_per_s
    double speed_age_s = 0.0;      ///< how long ago the speed was that: half its window
    double step_deg_per_s = 0.0;   ///< from the sample before to the newest, along the way
    double step_age_s = 0.0;       ///< how long ago that was: half of the step
    double noise_deg_per_s = 0.0;  ///< what a resting gaze shows as speed
    /// Of the person: how fast their saccades are, 1 as usual.
    double vigour = 1.0;
};

/// How far it will have travelled on.
struct SaccadeTravel {
    double further_deg = 0.0;  ///< from now; 0 or more
    double sd_deg = 0.0;       ///< standard deviation of that
    /// So far at least, but for one time in four (up to 20 ms ahead) to fifty (from 40 ms on).
    double at_least_deg = 0.0;
};

/// A figure that depends on the horizon: `near` up to 20 ms ahead, `far` from 40 ms on, in between
/// in proportion.
[[nodiscard]] double by_horizon(double ahead_s, double near, double far);

/// When it will land.
struct SaccadeLanding {
    double in_s = 0.0;  ///< from now; 0 or more
    double sd_s = 0.0;  ///< standard deviation of that
};

/// Saccades of all amplitudes and of three vigours on the main sequence (main_sequence.h), large
/// ones with an early peak, each weighed by how well it explains what was seen, are the forecast.
/// Zeros where nothing explains it. No allocation.
class SaccadeForecast {
  public:
    /// Of no saccade: nothing explains it.
    SaccadeForecast() = default;
    explicit SaccadeForecast(const SaccadeInFlight& seen);

    /// `ahead_s` >= 0.
    [[nodiscard]] SaccadeTravel after(double ahead_s) const;
    [[nodiscard]] SaccadeLanding landing() const;

  private:
    static constexpr std::size_t kAmplitudes = 20;
    static constexpr std::size_t kVigourCount = 3;

    struct Explanation {
        std::size_t course = 0;  ///< of the amplitudes
        double weight = 0.0;
        double done = 0.0;  ///< share of its duration that has gone by
        double duration_s = 0.0;
    };

    void leave_out_unlikely();

    double travelled_deg_ = 0.0;
    std::array<Explanation, kAmplitudes * kVigourCount> explanations_{};
    std::size_t count_ = 0;  ///< of explanations_
    double weights_ = 0.0;
};

}  // namespace gazeloop::gaze
