#pragma once

#include <array>
#include <cstddef>

namespace gazeloop::gaze {

/// A saccade that is going on, as seen so far.
struct SaccadeInFlight {
    double travelled_deg = 0.0;  ///< from where it began; 0 or more
    double elapsed_s = 0.0;      ///< since it was noticed
    double speed_deg_per_s = 0.0;
    double peak_deg_per_s = 0.0;  ///< the greatest speed so far; at least speed_deg_per_s
    double speed_age_s = 0.0;     ///< how long ago the speed was that: half its window
    /// Of the person: how fast their saccades are, 1 as usual.
    double vigour = 1.0;
};

/// How far it will have travelled on.
struct SaccadeTravel {
    double further_deg = 0.0;  ///< from now; 0 or more
    double sd_deg = 0.0;       ///< standard deviation of that
};

/// When it will land.
struct SaccadeLanding {
    double in_s = 0.0;  ///< from now; 0 or more
    double sd_s = 0.0;  ///< standard deviation of that
};

/// Saccades of all amplitudes and of three vigours on the main sequence (main_sequence.h), each
/// weighed by how well it explains what was seen, are the forecast: their mean and deviation.
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
    static constexpr std::size_t kAmplitudes = 18;
    static constexpr std::size_t kVigourCount = 3;

    struct Explanation {
        std::size_t course = 0;  ///< of the amplitudes
        double weight = 0.0;
        double done = 0.0;  ///< share of its duration that has gone by
        double duration_s = 0.0;
    };

    double travelled_deg_ = 0.0;
    std::array<Explanation, kAmplitudes * kVigourCount> explanations_{};
    std::size_t count_ = 0;  ///< of explanations_
    double weights_ = 0.0;
};

}  // namespace gazeloop::gaze
