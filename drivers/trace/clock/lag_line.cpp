#include "drivers/trace/clock/lag_line.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <optional>
#include <utility>

#include "runtime/time/clock_fit.h"
#include "runtime/time/span.h"

namespace gazeloop::drivers {
namespace {

constexpr std::int64_t kSecond_ns = 1'000'000'000;
/// What ClockFit's line rests on, without gaps; it is best in the middle.
constexpr std::int64_t kWindow_ns = 16 * kSecond_ns;
/// Gaps not counted. What a shorter stretch shows as a slope is as likely the last bit of jitter.
constexpr std::int64_t kShortestOfASlope_ns = 5 * kSecond_ns;
/// After a longer gap ClockFit begins anew.
constexpr std::int64_t kFitForgets_ns = 120 * kSecond_ns;

/// Whether the lowest lags of quarters of the rows lie on a line, rather than on both sides of a
/// step too short to be told from noise where it is.
bool is_gradual(std::span<const LagRow> rows) {
    constexpr std::size_t kParts = 4;
    if (rows.size() < 2 * kParts) {
        return true;
    }
    std::array<LagRow, kParts> lowest;
    for (std::size_t part = 0; part < kParts; ++part) {
        const std::size_t begin = rows.size() * part / kParts;
        const std::size_t end = rows.size() * (part + 1) / kParts;
        lowest[part] =
            *std::ranges::min_element(rows.subspan(begin, end - begin), {}, &LagRow::lag_ns);
    }
    const auto apart = [](const LagRow& from, const LagRow& to) {
        return static_cast<double>(to.device_ns - from.device_ns);
    };
    const auto total = static_cast<double>(lowest.back().lag_ns - lowest.front().lag_ns);
    const double slope = total / apart(lowest.front(), lowest.back());
    for (std::size_t i = 1; i < kParts; ++i) {
        const double off = static_cast<double>(lowest[i].lag_ns - lowest[i - 1].lag_ns) -
                           slope * apart(lowest[i - 1], lowest[i]);
        if (std::abs(off) > std::abs(total) / 2.0) {
            return false;
        }
    }
    return true;
}

}  // namespace

double LagLine::at(std::int64_t device_ns) const {
    if (knots.size() < 2) {
        return slope * static_cast<double>(device_ns - origin_ns);
    }
    auto after =
        std::upper_bound(knots.begin(), knots.end(), device_ns,
                         [](std::int64_t ns, const LagKnot& knot) { return ns < knot.device_ns; });
    after = std::clamp(after, knots.begin() + 1, knots.end() - 1);
    const LagKnot& a = *std::prev(after);
    const LagKnot& b = *after;
    return a.lag_ns + (b.lag_ns - a.lag_ns) * (static_cast<double>(device_ns - a.device_ns) /
                                               static_cast<double>(b.device_ns - a.device_ns));
}

namespace {

struct FittedLine {
    LagLine line;
    double slope = 0.0;  ///< of the fit's last line
};

/// Fits what the rows' lags are above a line of slope `about`, which is added again.
FittedLine fit_about(std::span<const LagRow> rows, std::int64_t origin_ns, double about) {
    LagLine line;
    line.origin_ns = origin_ns;
    line.known = true;
    line.base_ns = rows.front().lag_ns;

    time::ClockFit fit;
    std::int64_t window_from_ns = rows.front().device_ns;
    std::int64_t went_on_ns = 0;
    std::optional<LagKnot> last;
    double last_slope = 0.0;
    const auto lag_of_fit = [&](std::int64_t device_ns) {
        const double slope = fit.skew_ppm() * 1e-6;
        const auto from_last = static_cast<double>(device_ns - last->device_ns);
        return last->lag_ns + slope * from_last;
    };
    for (std::size_t i = 0; i < rows.size(); ++i) {
        const std::int64_t device_ns = rows[i].device_ns;
        // As the fit has it, host times are those since the stretch's first.
        const std::int64_t arrived_ns =
            time::saturated(rows[i].lag_ns - line.base_ns + device_ns -
                            std::llround(about * static_cast<double>(device_ns - origin_ns)));
        if (i > 0) {
            const std::int64_t step_ns = device_ns - rows[i - 1].device_ns;
            window_from_ns = step_ns > kFitForgets_ns ? device_ns : window_from_ns;
            went_on_ns += step_ns < kSecond_ns ? step_ns : 0;
        }
        const time::ClockReading reading = fit.add(device_ns, arrived_ns);
        if (reading.verdict == time::ClockVerdict::Unusable) {
            continue;
        }
        last = LagKnot{device_ns, static_cast<double>(fit.offset_ns())};
        last_slope = fit.skew_ppm() * 1e-6;
        line.within_ns = reading.uncertainty_ns;
        const std::int64_t middle_ns = device_ns - kWindow_ns / 2;
        const bool is_due =
            line.knots.empty() || middle_ns - line.knots.back().device_ns >= kWindow_ns / 2;
        if (device_ns - window_from_ns >= kWindow_ns && is_due) {
            if (line.knots.empty()) {
                line.knots.push_back({line.origin_ns, lag_of_fit(line.origin_ns)});
            }
            if (middle_ns > line.knots.back().device_ns) {
                line.knots.push_back({middle_ns, lag_of_fit(middle_ns)});
            }
        }
    }
    if (last) {
        if (line.knots.empty() && last->device_ns > line.origin_ns) {
            const auto length_ns = static_cast<double>(last->device_ns - line.origin_ns);
            line.knots.push_back({line.origin_ns, last->lag_ns - last_slope * length_ns});
        }
        if (!line.knots.empty() && last->device_ns > line.knots.back().device_ns) {
            line.knots.push_back(*last);
        }
    }
    for (LagKnot& knot : line.knots) {
        knot.lag_ns += about * static_cast<double>(knot.device_ns - origin_ns);
    }
    if (line.knots.size() >= 2) {
        const auto [least, most] = std::minmax_element(
            line.knots.begin(), line.knots.end(),
            [](const LagKnot& a, const LagKnot& b) { return a.lag_ns < b.lag_ns; });
        // Twice, for two knots; and a long trace has many, of which the odd one is off.
        constexpr double kNone_ns = 50e3;
        const double change_ns = most->lag_ns - least->lag_ns;
        line.steep = change_ns > std::max(2.0 * static_cast<double>(line.within_ns), kNone_ns) &&
                     went_on_ns >= kShortestOfASlope_ns;
        if (line.steep && !is_gradual(rows)) {
            line.steep = false;
            line.within_ns = std::max<std::int64_t>(line.within_ns, std::llround(change_ns));
        }
    }
    return {std::move(line), last_slope};
}

}  // namespace

LagLine fit_lag_line(std::span<const LagRow> rows, std::int64_t origin_ns, double about) {
    constexpr double kBound = 0.99 * time::ClockFit::kGreatestSkew;
    // What is in the midst of the fit's range anyhow needs no other; what is far beyond is noise.
    const bool helps = std::abs(about) > time::ClockFit::kGreatestSkew / 2.0 &&
                       std::abs(about) < 4.0 * time::ClockFit::kGreatestSkew;
    about = helps ? about : 0.0;
    FittedLine fitted = fit_about(rows, origin_ns, about);
    if (std::abs(fitted.slope) >= kBound) {
        fitted = fit_about(rows, origin_ns, about + fitted.slope);
    }
    return std::move(fitted.line);
}

}  // namespace gazeloop::drivers
