#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "runtime/foveation/eye/stela_csf.h"

namespace gazeloop::quality {

/// The mechanisms by which a difference is seen.
enum class Mechanism : std::size_t {
    Sustained,     ///< luminance that stays
    RedGreen,      ///< colour, L against M cones
    YellowViolet,  ///< colour, S against L and M cones
    Transient,     ///< luminance that changes
};
inline constexpr std::size_t kMechanisms = 4;
inline constexpr std::size_t kStillMechanisms = 3;  ///< those that a still picture reaches
inline constexpr std::array<const char*, kMechanisms> kMechanismNames{"achromatic", "red_green",
                                                                      "yellow_violet", "flicker"};

/// Sensitivity (1 / threshold contrast) at the fovea to a patch of a grating, its area pi square
/// degrees. Luminance: the sustained or the transient part of stelaCSF (Mantiuk et al. 2022).
/// Colour: castleCSF's (Ashraf et al. 2024). Contrasts are those of opponent_planes(), over
/// luminance. All without their response to time, which the temporal filters have. Preconditions:
/// frequency_cpd > 0, luminance in StelaConditions' range.
[[nodiscard]] double foveal_sensitivity(Mechanism mechanism, double frequency_cpd,
                                        double luminance_cd_m2);

/// How that falls with eccentricity. Colour: as on the temporal side, in all directions, since
/// castleCSF's figures for the nasal side rest on few data.
[[nodiscard]] foveation::StelaDecay sensitivity_decay(Mechanism mechanism, double nasal);

/// Foveal sensitivity as a table over the logarithms of frequency and luminance; within 2 % of the
/// formula from .25 to 64 cpd. Beyond its ends, as at them.
class SensitivityTable {
  public:
    explicit SensitivityTable(Mechanism mechanism);

    /// log2 of the sensitivity, of the logarithms to base 2 of cpd and cd/m2.
    [[nodiscard]] float log2_at(float log2_cpd, float log2_luminance) const {
        const Step f = step(log2_cpd, kLeastLog2Cpd, kPerOctave, kFrequencies);
        const Step l = step(log2_luminance, kLeastLog2Luminance, kPerDoubling, kLuminances);
        const float* const at = values_.data() + f.below * kLuminances + l.below;
        const float low = at[0] + l.share * (at[1] - at[0]);
        const float high = at[kLuminances] + l.share * (at[kLuminances + 1] - at[kLuminances]);
        return low + f.share * (high - low);
    }

  private:
    static constexpr float kLeastLog2Cpd = -2.0F;
    static constexpr float kPerOctave = 6.0F;
    static constexpr std::size_t kFrequencies = 49;  // to 64 cpd
    static constexpr float kLeastLog2Luminance = -9.0F;
    static constexpr float kPerDoubling = 2.0F;
    static constexpr std::size_t kLuminances = 45;  // to 2^13 cd/m2

    struct Step {
        std::size_t below;
        float share;
    };
    static Step step(float value, float least, float per_unit, std::size_t count) {
        const float most = static_cast<float>(count) - 1.001F;
        float at = (value - least) * per_unit;
        at = at > 0.0F ? at : 0.0F;
        at = at < most ? at : most;
        const auto below = static_cast<std::size_t>(at);
        return {below, at - static_cast<float>(below)};
    }

    std::vector<float> values_;
};

}  // namespace gazeloop::quality
