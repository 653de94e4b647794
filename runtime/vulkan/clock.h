#pragma once

#include <cstdint>
#include <span>

#include "runtime/time/stamp.h"
#include "runtime/vulkan/context.h"

namespace gazeloop::vulkan {

/// Turns GPU timestamps into CLOCK_MONOTONIC by VK_EXT_calibrated_timestamps, calibrated anew every
/// second, because the two clocks drift.
class GpuClock {
  public:
    explicit GpuClock(const Context& context);

    /// Whether a device with these time domains can relate its clock to CLOCK_MONOTONIC.
    [[nodiscard]] static bool relates(std::span<const vk::TimeDomainEXT> domains);

    /// From one timestamp of the queue to another, also through a wrap.
    [[nodiscard]] double elapsed_ns(std::uint64_t from_ticks, std::uint64_t to_ticks) const;

    /// Unknown where the device cannot relate its clock to CLOCK_MONOTONIC.
    [[nodiscard]] time::Stamp host_time(std::uint64_t gpu_ticks);

    /// The device's own bound on the calibration's error, of the last calibration.
    [[nodiscard]] std::uint64_t max_deviation_ns() const { return max_deviation_ns_; }

  private:
    void calibrate();

    const Context* context_;
    bool usable_ = false;
    std::uint64_t gpu_ticks_ = 0;
    std::uint64_t host_ns_ = 0;
    std::uint64_t max_deviation_ns_ = 0;
};

}  // namespace gazeloop::vulkan
