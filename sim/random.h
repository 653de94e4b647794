#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>

namespace gazeloop::sim {

/// Every term of the simulation draws from a stream of its own, so that switching one on or off
/// changes the numbers of no other. The enumerators' numbers must not change: they decide what a
/// seed gives.
enum class Stream : std::uint64_t {
    Sway = 1,
    Targets,
    Fixations,
    Turns,
    SaccadeScatter,
    Distances,
    Pursuits,
    Drift,
    Microsaccades,
    Blinks,
    Bias,
    Noise,
    Jitter,
    Dropouts,
    EyeLosses,
    ObserverPeople,
    ObserverNoise,
    ObserverLapses,
    StudyOrder,
};

/// Random numbers that are the same with every standard library: SplitMix64 (Steele, Lea and Flood
/// 2014, "Fast splittable pseudorandom number generators") and distributions written out.
class Random {
  public:
    /// Streams of one seed are independent of each other. So are the events of one stream: what
    /// event 7 draws does not depend on how much event 6 drew.
    Random(std::uint64_t seed, Stream stream, std::uint64_t event = 0)
        : state_(mix(mix(seed + kStep) ^ (static_cast<std::uint64_t>(stream) * kStreamStep)) ^
                 mix(event + kStep)) {}

    /// 0 <= x < 1, in steps of 2^-53.
    [[nodiscard]] double uniform() { return static_cast<double>(next() >> 11U) * 0x1p-53; }
    [[nodiscard]] double uniform(double low, double high) { return low + (high - low) * uniform(); }

    /// Mean 0, standard deviation 1 (Box and Muller; the second value is not kept). At most 8.6
    /// from 0, because 1 - uniform() is at least 2^-53.
    [[nodiscard]] double normal() {
        const double radius = std::sqrt(-2.0 * std::log(1.0 - uniform()));
        return radius * std::cos(2.0 * std::numbers::pi * uniform());
    }

    /// At most 36.8 times the mean.
    [[nodiscard]] double exponential(double mean) { return -mean * std::log(1.0 - uniform()); }

    /// exp of a normal value: half the values lie below the median.
    [[nodiscard]] double log_normal(double median, double sigma) {
        return median * std::exp(sigma * normal());
    }

  private:
    static constexpr std::uint64_t kStep = 0x9E3779B97F4A7C15U;
    static constexpr std::uint64_t kStreamStep = 0xD1B54A32D192ED03U;

    static std::uint64_t mix(std::uint64_t mixed) {
        mixed = (mixed ^ (mixed >> 30U)) * 0xBF58476D1CE4E5B9U;
        mixed = (mixed ^ (mixed >> 27U)) * 0x94D049BB133111EBU;
        return mixed ^ (mixed >> 31U);
    }

    std::uint64_t next() {
        state_ += kStep;
        return mix(state_);
    }

    std::uint64_t state_;
};

}  // namespace gazeloop::sim
