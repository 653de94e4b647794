// Takes the place of sim/random.h where this folder is searched first: the same numbers, counted.
#pragma once

#define Random UncountedRandom
#include GAZELOOP_UNCOUNTED_RANDOM
#undef Random

#include <array>
#include <cstddef>
#include <cstdint>

namespace gazeloop::sim {

/// Numbers drawn from each stream so far, by Stream.
inline std::array<std::size_t, 16> g_draws{};

class Random {
  public:
    Random(std::uint64_t seed, Stream stream, std::uint64_t event = 0)
        : random_(seed, stream, event), stream_(stream) {}

    [[nodiscard]] double uniform() { return counted().uniform(); }
    [[nodiscard]] double uniform(double low, double high) { return counted().uniform(low, high); }
    [[nodiscard]] double normal() { return counted().normal(); }
    [[nodiscard]] double exponential(double mean) { return counted().exponential(mean); }
    [[nodiscard]] double log_normal(double median, double sigma) {
        return counted().log_normal(median, sigma);
    }

  private:
    UncountedRandom& counted() {
        ++g_draws.at(static_cast<std::size_t>(stream_));
        return random_;
    }

    UncountedRandom random_;
    Stream stream_;
};

}  // namespace gazeloop::sim
