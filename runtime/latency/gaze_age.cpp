#include "runtime/latency/gaze_age.h"

#include <algorithm>
#include <cmath>

namespace gazeloop::latency {

namespace {

/// By the runtime's account.
ShownFrame told_shown_frame(const frame::FrameStamps& stamps, std::int64_t period_ns) {
    ShownFrame shown{.at = stamps.shown, .in_time_known = stamps.display.known() && period_ns > 0};
    const __int128 late = static_cast<__int128>(stamps.shown.ns) - stamps.display.ns;
    if (shown.in_time_known && late > 0) {
        shown.periods_missed = static_cast<std::uint64_t>((2 * late + period_ns) / period_ns / 2);
    }
    return shown;
}

}  // namespace

ShownFrame shown_frame(const frame::FrameStamps& stamps, std::int64_t period_ns) {
    if (stamps.shown.known()) {
        return told_shown_frame(stamps, period_ns);
    }
    ShownFrame shown{.at = stamps.display,
                     .in_time_known = stamps.display.known() && stamps.gpu_end.known()};
    if (!shown.in_time_known || stamps.gpu_end.ns <= stamps.display.ns) {
        return shown;
    }
    if (period_ns <= 0) {
        return {.at = {}, .periods_missed = 1, .in_time_known = true};
    }
    const __int128 late = static_cast<__int128>(stamps.gpu_end.ns) - stamps.display.ns;
    const __int128 periods = (late + period_ns - 1) / period_ns;
    shown.periods_missed = static_cast<std::uint64_t>(periods);
    shown.at = {time::saturated(stamps.display.ns + periods * period_ns),
                time::StampKind::Modelled};
    return shown;
}

namespace {

/// Precondition: both are known.
time::Span sum(const time::Span& a, const time::Span& b) {
    return {time::saturated(static_cast<__int128>(a.ns) + b.ns), time::weaker(a.kind, b.kind)};
}

/// A method may draw before the gaze is read: what it then still does after the submit counts.
time::Stamp gpu_start(const frame::FrameStamps& stamps) {
    const time::Stamp& begin = stamps.gpu_begin;
    const time::Stamp& submit = stamps.submit;
    if (!begin.known() || !submit.known() || begin.ns >= submit.ns) {
        return begin;
    }
    return submit;
}

}  // namespace

GazeAge gaze_age(const gaze::FoveaPoint& fovea, const frame::FrameStamps& stamps,
                 const time::Stamp& shown, std::optional<std::int64_t> switching_ns,
                 std::optional<std::int64_t> row_ns) {
    GazeAge age;
    age.at_latch = time::between(fovea.sampled, stamps.latch);
    if (const time::Span late = time::between(stamps.begin, stamps.latch);
        age.at_latch.known() && late.known()) {
        age.read_at_begin = sum(age.at_latch, late);
    }
    age.at_display = time::between(fovea.sampled, shown);
    if (fovea.uncertainty_ns && age.at_display.known()) {
        age.uncertainty = {*fovea.uncertainty_ns, time::StampKind::Profile};
    }
    age.stages = {
        time::between(fovea.sampled, fovea.ready.known() ? fovea.ready : fovea.arrived),
        time::between(fovea.ready, fovea.arrived),
        time::between(fovea.arrived, stamps.latch),
        time::between(stamps.latch, stamps.filtered),
        time::between(stamps.filtered.known() ? stamps.filtered : stamps.latch, stamps.submit),
        time::between(gpu_start(stamps), stamps.gpu_end),
        time::between(stamps.gpu_end, stamps.present),
        time::between(stamps.present.known() ? stamps.present : stamps.gpu_end, shown),
        time::Span{},
        time::Span{}};
    const auto add = [&age](Stage stage, std::optional<std::int64_t> delay_ns) {
        if (delay_ns) {
            age.stages[static_cast<std::size_t>(stage)] = {*delay_ns, time::StampKind::Profile};
            age.at_display = {time::saturated(static_cast<__int128>(age.at_display.ns) + *delay_ns),
                              time::weaker(age.at_display.kind, time::StampKind::Profile)};
        }
    };
    if (fovea.filter_delay_ns) {
        const time::Span delay{*fovea.filter_delay_ns, time::StampKind::Modelled};
        time::Span& filter = age.stages[static_cast<std::size_t>(Stage::Filter)];
        filter = filter.known() ? sum(filter, delay) : delay;
        age.at_display = age.at_display.known() ? sum(age.at_display, delay) : age.at_display;
    }
    add(Stage::Row, row_ns);
    add(Stage::Switching, switching_ns);
    __int128 rest = age.at_display.ns;
    for (const time::Span& stage : age.stages) {
        rest -= stage.known() ? stage.ns : 0;
    }
    age.unaccounted = {time::saturated(rest), age.at_display.kind};
    return age;
}

std::optional<std::int64_t> row_delay_ns(std::optional<std::int64_t> rolling_ns, double y_px,
                                         std::uint32_t height_px) {
    if (!rolling_ns || height_px == 0 || std::isnan(y_px)) {
        return std::nullopt;
    }
    const double share = std::clamp(y_px / height_px, 0.0, 1.0);
    return std::llround((share - 0.5) * static_cast<double>(*rolling_ns));
}

gaze::Eye older_eye(const gaze::FrameFovea& fovea) {
    const auto& [left, right] = fovea.eyes;
    if (!left.sampled.known() || !right.sampled.known()) {
        return left.sampled.known() ? gaze::Eye::Right : gaze::Eye::Left;
    }
    return right.sampled.ns < left.sampled.ns ? gaze::Eye::Right : gaze::Eye::Left;
}

bool may_be_of_period(std::int64_t announced_ns, std::int64_t profile_ns) {
    constexpr double kTolerance = 0.01;
    constexpr double kMostPeriods = 4.0;
    if (announced_ns <= 0 || profile_ns <= 0) {
        return true;  // nothing speaks against it
    }
    const double periods = static_cast<double>(announced_ns) / static_cast<double>(profile_ns);
    const double whole = std::clamp(std::round(periods), 1.0, kMostPeriods);
    return std::abs(periods - whole) <= kTolerance * whole;
}

GazeAge frame_gaze_age(const frame::FrameRecord& frame, const frame::FrameStamps& stamps,
                       const time::Stamp& shown, std::optional<std::int64_t> switching_ns,
                       std::optional<std::int64_t> rolling_ns) {
    const std::size_t eye = gaze::index(older_eye(frame.fovea));
    const gaze::FoveaPoint& fovea = frame.fovea.eyes[eye];
    return gaze_age(fovea, stamps, shown, switching_ns,
                    row_delay_ns(rolling_ns, fovea.position.y_px, frame.views[eye].height_px));
}

}  // namespace gazeloop::latency
