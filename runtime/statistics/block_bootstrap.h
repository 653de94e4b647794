#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

namespace gazeloop::statistics {

// How far a figure of one run differs from that of another, and how much of that is chance. Frames
// are not independent: a slow one is followed by slow ones. So whole blocks of neighbours are
// resampled (the circular block bootstrap of Politis and Romano 1992), long enough that one block
// says little of the next.

/// Resampling that gives the same figures for the same seed on every machine.
struct BootstrapOptions {
    std::uint64_t seed = 1;
    std::size_t resamples = 1000;  ///< at least 100
    double level = 0.95;           ///< of the interval, in (0, 1)
};

/// One figure before and after, in the unit of the values.
struct Difference {
    double before = 0.0;
    double after = 0.0;
    double low = 0.0;   ///< of the interval of after - before
    double high = 0.0;  ///< likewise

    [[nodiscard]] double change() const { return after - before; }
    /// Whether the interval leaves no change out.
    [[nodiscard]] bool may_be_chance() const { return low <= 0.0 && high >= 0.0; }
};

/// The number of neighbours that one block should have for the mean of these values, by the rule
/// of Politis and White (2004) as corrected by Patton, Politis and White (2009). At least 1, at
/// most a third of the values. Values are finite.
[[nodiscard]] std::size_t block_length(std::span<const double> values);

/// Of the means. None: one of the runs has fewer than 8 blocks, which bound nothing. Values are
/// finite, in the order of time.
[[nodiscard]] std::optional<Difference> difference_of_means(std::span<const double> before,
                                                            std::span<const double> after,
                                                            const BootstrapOptions& options = {});

/// Of a percentile (nearest rank), `percent` in (0, 100). A resample's percentile is read off the
/// run's own distribution, at the rank by which the resampled share of values up to the percentile
/// differs from the run's (Bahadur 1966; Woodruff 1952). None: as above, or fewer than 10 values
/// lie beyond the percentile in one of the runs.
[[nodiscard]] std::optional<Difference> difference_of_percentiles(
    std::span<const double> before, std::span<const double> after, double percent,
    const BootstrapOptions& options = {});

}  // namespace gazeloop::statistics
