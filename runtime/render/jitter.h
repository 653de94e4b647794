#pragma once

#include <cstdint>
#include <glm/vec2.hpp>

namespace gazeloop::render {

/// Where in their cells the samples of a frame lie, for what accumulates over frames: the Halton
/// sequence of bases 2 and 3, less its mean. Phase 0 begins anew where the history does.
class Jitter {
  public:
    /// Period of the sequence, frames.
    static constexpr std::uint32_t kPhases = 8;

    void reset() { phase_ = 0; }
    void advance() { phase_ = (phase_ + 1) % kPhases; }

    /// In cells, in (-.5, .5) each; the mean over a period is 0.
    [[nodiscard]] glm::dvec2 offset() const {
        const auto at = [](std::uint32_t phase) {
            return glm::dvec2(radical_inverse(2, phase + 1), radical_inverse(3, phase + 1));
        };
        glm::dvec2 mean(0.0);
        for (std::uint32_t phase = 0; phase < kPhases; ++phase) {
            mean += at(phase) / double{kPhases};
        }
        return at(phase_) - mean;
    }

  private:
    /// The digits of n mirrored at the point, in [0, 1).
    static double radical_inverse(std::uint32_t base, std::uint32_t n) {
        double value = 0.0;
        double digit = 1.0;
        for (; n > 0; n /= base) {
            digit /= base;
            value += digit * (n % base);
        }
        return value;
    }

    std::uint32_t phase_ = 0;
};

}  // namespace gazeloop::render
