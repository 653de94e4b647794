#include "runtime/vulkan/clock.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "runtime/time/tick_range.h"

namespace gazeloop::vulkan {
namespace {

constexpr double kCalibrateAgainNs = 1e9;

}  // namespace

GpuClock::GpuClock(const Context& context) : context_(&context) {
    if (context.has_calibrated_timestamps()) {
        usable_ = relates(context.physical().getCalibrateableTimeDomainsEXT());
    }
    if (usable_) {
        calibrate();
    }
}

bool GpuClock::relates(std::span<const vk::TimeDomainEXT> domains) {
    return std::ranges::find(domains, vk::TimeDomainEXT::eClockMonotonic) != domains.end() &&
           std::ranges::find(domains, vk::TimeDomainEXT::eDevice) != domains.end();
}

void GpuClock::calibrate() {
    const std::array<vk::CalibratedTimestampInfoEXT, 2> infos{
        vk::CalibratedTimestampInfoEXT(vk::TimeDomainEXT::eDevice),
        vk::CalibratedTimestampInfoEXT(vk::TimeDomainEXT::eClockMonotonic)};
    std::array<std::uint64_t, 2> stamps{};
    std::uint64_t deviation_ns = 0;
    // This form, because it allocates nothing: it runs between frames.
    if ((*context_->device())
            .getCalibratedTimestampsEXT(
                static_cast<std::uint32_t>(infos.size()), infos.data(), stamps.data(),
                &deviation_ns, *context_->device().getDispatcher()) != vk::Result::eSuccess) {
        return;  // the last relation stands
    }
    gpu_ticks_ = stamps[0];
    host_ns_ = stamps[1];
    max_deviation_ns_ = deviation_ns;
}

double GpuClock::elapsed_ns(std::uint64_t from_ticks, std::uint64_t to_ticks) const {
    return static_cast<double>(time::tick_difference(
               from_ticks, to_ticks, time::TickRange::of_bits(context_->timestamp_bits()))) *
           context_->timestamp_period_ns();
}

time::Stamp GpuClock::host_time(std::uint64_t gpu_ticks) {
    if (!usable_) {
        return {};
    }
    // Negative where the stamp lies before the calibration.
    const auto since_calibration_ns = [&] { return elapsed_ns(gpu_ticks_, gpu_ticks); };
    if (std::abs(since_calibration_ns()) > kCalibrateAgainNs) {
        calibrate();
    }
    return {static_cast<std::int64_t>(host_ns_) + std::llround(since_calibration_ns()),
            time::StampKind::Measured};
}

}  // namespace gazeloop::vulkan
