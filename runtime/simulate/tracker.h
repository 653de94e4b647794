#pragma once

#include <cstdint>

#include "runtime/simulate/played_gaze.h"

namespace gazeloop::simulate {

/// Plugs in a HID eye tracker (sim/virtual_tracker.h) and plays the gaze again and again, each
/// sample at its time, to whoever has started it. Gives how many reports were sent.
/// @throws SetupError: BadInput for a trace that is refused; as sim::UhidDevice
std::uint64_t play_as_tracker(const PlayedGaze& gaze, const Interrupted& interrupted);

}  // namespace gazeloop::simulate
