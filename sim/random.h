#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>

namespace gazeloop::sim {

/// Random numbers that are the same with every standard library: SplitMix64 (Steele, Lea and Flood
/// 2014, "Fast splittable pseudorandom number generators") and distributions written out.
class Random {
  public:
    /// Streams of one seed are independent, so that drawing more from one changes no other.
    Random(std::uint64_t seed, std::uint64_t stream)
        : state_(mix(seed + kStep) ^ (stream * 0xD1B54A32D192ED03U)) {}

    /// 0 <= x < 1, in steps of 2^-53.
    [[nodiscard]] double uniform() { return static_cast<double>(next() >> 11U) * 0x1p-53; }
    [[nodiscard]] double uniform(double low, double high) { return low + (high - low) * uniform(); }

    /// Mean 0, standard deviation 1 (Box and Muller; the second value is not kept).
    [[nodiscard]] double normal() {
        const double radius = std::sqrt(-2.0 * std::log(1.0 - uniform()));
        return radius * std::cos(2.0 * std::numbers::pi * uniform());
    }

    [[nodiscard]] double exponential(double mean) { return -mean * std::log(1.0 - uniform()); }

    /// exp of a normal value: half the values lie below the median.
    [[nodiscard]] double log_normal(double median, double sigma) {
        return median * std::exp(sigma * normal());
    }

  private:
    static constexpr std::uint64_t kStep = 0x9E3779B97F4A7C15U;

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
