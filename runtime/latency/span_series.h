#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "runtime/latency/duration_histogram.h"
#include "runtime/time/span.h"

namespace gazeloop::latency {

/// One quantity over many frames, milliseconds. Nothing known: no figures; too few samples for a
/// percentile: that percentile is withheld.
struct DurationRow {
    std::uint64_t count = 0;  ///< frames that know it
    /// Frames by how it was obtained; those under unknown are not in the figures.
    std::array<std::uint64_t, time::kStampKindCount> frames_by_kind{};
    std::optional<double> min_ms;
    std::optional<double> mean_ms;
    std::optional<double> p50_ms;
    std::optional<double> p95_ms;
    std::optional<double> p99_ms;
    std::optional<double> max_ms;

    /// The least certain kind among the known ones; unknown where no frame knows it.
    [[nodiscard]] time::StampKind kind() const;
    /// Whether frames of more than one known kind are in the figures.
    [[nodiscard]] bool mixed() const;
};

/// Gathers a DurationRow in fixed memory.
class SpanSeries {
  public:
    void add(const time::Span& span);
    [[nodiscard]] DurationRow row() const;

  private:
    DurationHistogram histogram_;
    std::array<std::uint64_t, time::kStampKindCount> frames_by_kind_{};
};

}  // namespace gazeloop::latency
