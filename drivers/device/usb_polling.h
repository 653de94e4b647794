#pragma once

#include <cstdint>
#include <string>

namespace gazeloop::drivers {

/// What a host that is not told otherwise asks for: 1 ms, a frame of USB at full speed.
inline constexpr std::int64_t kUsualPolling_ns = 1'000'000;

/// How often the host asks a USB device for input: the longest interval of the interrupt IN
/// endpoints of the USB interface above `syspath` (/sys/devices/...). It is computed as the kernel
/// does, from bInterval and the speed: 2^(bInterval-1) microframes of 125 us at high speed and
/// above, bInterval frames of 1 ms below. Controllers that know only powers of two ask more often,
/// never less. kUsualPolling_ns where the kernel does not say; 0 below /sys/devices/virtual, where
/// nobody asks.
[[nodiscard]] std::int64_t usb_polling_ns(const std::string& syspath);

}  // namespace gazeloop::drivers
