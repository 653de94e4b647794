#pragma once

#include <memory>
#include <optional>
#include <span>

#include "runtime/run/frame_run.h"
#include "runtime/run/governed_frames.h"

namespace gazeloop::run {

/// Puts a governor over a run's frames, where governor.use asks for one; null: it does not. What it
/// gives must outlive the run. governor.use is "on" or "off" then, governor.levels holds the front,
/// and render.scale may have been fitted to this machine. Where the request is the replay of a
/// recorded session, its levels are the recorded ones.
/// @throws SetupError: a front that cannot be read (BadInput) or drawn, what a governed run cannot
/// do besides (Usage); where the scale is fitted, NoDevice
[[nodiscard]] std::unique_ptr<GovernedFrames> govern(ProgramSettings& settings,
                                                     FrameRunRequest& request);

/// The front of a run or a recording by its settings; none: it was not governed. Throws SetupError
/// (BadInput) for one that is damaged.
[[nodiscard]] std::optional<governor::Front> governed_front(std::span<const NamedValue> settings);

}  // namespace gazeloop::run
