#pragma once

#include <cstdint>
#include <string>

namespace gazeloop::vulkan {

/// The processor's model as it names itself; empty where it has no name.
[[nodiscard]] std::string processor_name();

/// A hash of the bits that the processor's approximate inverse square root gives (RSQRTSS on x86),
/// 0 where there is none. Makers' tables differ, and a driver that renders on the processor uses
/// the instruction: lavapipe's pictures then differ in their last bits, though device and driver
/// have the same names.
[[nodiscard]] std::uint64_t inverse_square_root_hash();

}  // namespace gazeloop::vulkan
