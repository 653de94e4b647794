#pragma once

#include <cstdint>
#include <span>

#include "drivers/trace/clock/counter_wrap.h"
#include "drivers/trace/clock/lag_steps.h"
#include "runtime/memory/long_vector.h"

namespace gazeloop::drivers {

/// Host time less device time, over device time.
struct LagKnot {
    std::int64_t device_ns = 0;
    double lag_ns = 0.0;  ///< from the line's `base_ns`
};

/// How the lag of the quickest reports goes on over a stretch in which no clock was set.
struct LagLine {
    bool known = false;
    Wide base_ns = 0;
    memory::LongVector<LagKnot> knots;  ///< ascending; fewer than two: `slope` from the origin
    std::int64_t origin_ns = 0;         ///< device time of the stretch's first row
    double slope = 0.0;
    std::int64_t within_ns = 0;  ///< 0: not known
    bool steep = false;          ///< more so than the uncertainty explains

    /// From `base_ns`, between the knots and on beyond the outer ones.
    [[nodiscard]] double at(std::int64_t device_ns) const;
};

/// Fits a stretch as a live tracker's clock is fitted (time::ClockFit), 16 s at a time. What was
/// before the fit settled gets its lag by the first line. A slope of less than 5 s of rows, or of
/// lags that do not lie on one line from end to end, is none: then `within_ns` is as much wider.
/// ClockFit believes slopes up to 500 ppm; `about` is a slope that is known beforehand, or 0, from
/// which the line's may differ by so much, and by as much again where it comes out at that bound.
/// Precondition: at least one row. O(n).
[[nodiscard]] LagLine fit_lag_line(std::span<const LagRow> rows, std::int64_t origin_ns,
                                   double about = 0.0);

}  // namespace gazeloop::drivers
