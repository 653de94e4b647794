#pragma once

#include <cstdint>
#include <string>

namespace gazeloop::vulkan {

/// The processor's model as it names itself; empty where it has no name.
[[nodiscard]] std::string processor_name();

/// A hash of the bits that the processor's approximate inverse square root gives (RSQRTSS on x86),
/// 0 where there is none. Makers' tables differ, and lavapipe encodes sRGB by it: its pictures then
/// differ in their last bits, though device and driver have the same names
/// (findings/lavapipe-srgb-by-processor.sh).
[[nodiscard]] std::uint64_t inverse_square_root_hash();

}  // namespace gazeloop::vulkan
