#include "drivers/device/sample_clock.h"

#include <fmt/format.h>

#include <algorithm>

#include "runtime/time/span.h"

namespace gazeloop::drivers {
namespace {

using time::ClockVerdict;
using time::StampKind;

/// Of the 63 reports that hidraw keeps, nearly all: a reader that late has lost what came after.
constexpr std::uint64_t kBacklog = 48;

}  // namespace

void SampleClock::stamp(std::uint64_t ticks, std::int64_t arrived_ns, gaze::GazeSample& sample) {
    const __int128 passed_ns =
        static_cast<__int128>(arrived_ns) - last_stamped_ns_.value_or(arrived_ns);
    last_stamped_ns_ = arrived_ns;
    sample.device_ns = counter_.to_ns(ticks, time::saturated(passed_ns));
    sample.arrived = {arrived_ns, StampKind::Measured};
    sample.sampled = {};
    sample.ready = {};
    sample.uncertainty_ns.reset();

    const time::ClockReading reading = fit_.add(sample.device_ns, arrived_ns);
    unusable_in_a_row_ = reading.verdict == ClockVerdict::Unusable ? unusable_in_a_row_ + 1 : 0;
    if (reading.verdict != ClockVerdict::Unusable) {
        sample.ready = {reading.host_ns, StampKind::Measured};
        sample.sampled = {reading.host_ns - delay_.least_ns, StampKind::Profile};
        sample.uncertainty_ns = reading.uncertainty_ns + delay_.uncertainty_ns;
    }

    lost_ = 0;
    const std::int64_t period_ns = fit_.period_ns();
    if (last_device_ns_ && period_ns > 0) {
        const auto step =
            time::saturated(static_cast<__int128>(sample.device_ns) - *last_device_ns_);
        // A clock that was set leaves the sample's time unknown, and is no loss.
        if (backlog_ >= kBacklog && sample.ready.known() && step > period_ns + period_ns / 2) {
            const bool up = step % period_ns >= period_ns - period_ns / 2;
            lost_ = static_cast<std::uint64_t>(step / period_ns - (up ? 0 : 1));
        }
    }
    last_device_ns_ = sample.device_ns;
    backlog_ = 0;
    count_backlog(arrived_ns);
}

void SampleClock::pass(std::int64_t arrived_ns) { count_backlog(arrived_ns); }

void SampleClock::count_backlog(std::int64_t arrived_ns) {
    const bool queued = arrived_ns - last_arrived_ns_ < fit_.period_ns() / 4;
    queued_in_a_row_ = queued ? queued_in_a_row_ + 1 : 0;
    backlog_ = std::max(backlog_, queued_in_a_row_);
    last_arrived_ns_ = arrived_ns;
}

std::optional<std::string> SampleClock::take_change() {
    const bool unusable = fit_.last().verdict == ClockVerdict::Unusable;
    const bool lasts = unusable_in_a_row_ >= kReadingsToTell;
    const bool calm = told_ns_ && last_arrived_ns_ - *told_ns_ < kCalm_ns;
    if (calm && (!lasts || told_verdict_ == ClockVerdict::Unusable)) {
        return std::nullopt;
    }
    const bool set = fit_.steps() != told_steps_ && fit_.trouble() != time::ClockTrouble::Restless;
    told_steps_ = fit_.steps();
    std::optional<std::string> text;
    if (set && !lasts) {
        text = "clock: the tracker's clock was set";
    } else if ((!unusable || lasts) && told_verdict_ != fit_.last().verdict) {
        told_verdict_ = fit_.last().verdict;
        text = describe(fit_);
    }
    if (text) {
        told_ns_ = last_arrived_ns_;
    }
    return text;
}

std::string describe(const time::ClockFit& fit) {
    const time::ClockReading& reading = fit.last();
    const auto verdict = time::kClockVerdictNames[static_cast<std::size_t>(reading.verdict)];
    const auto trouble = time::kClockTroubleNames[static_cast<std::size_t>(fit.trouble())];
    if (reading.verdict == ClockVerdict::Unusable) {
        return fmt::format("clock: unusable ({}), so the age of the gaze is unknown", trouble);
    }
    const std::string why =
        fit.trouble() == time::ClockTrouble::None ? std::string() : fmt::format(" ({})", trouble);
    return fmt::format("clock: {}{}, within {:.2f} ms, skew {:+.0f} ppm", verdict, why,
                       static_cast<double>(reading.uncertainty_ns) * 1e-6, fit.skew_ppm());
}

}  // namespace gazeloop::drivers
