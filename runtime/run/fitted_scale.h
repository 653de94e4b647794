#pragma once

#include <optional>

#include "runtime/gaze/view.h"
#include "runtime/render/off_screen.h"
#include "runtime/run/program_settings.h"

namespace gazeloop::run {

/// What a frame takes on the GPU with the gaze straight ahead, ms: the shortest of eight after the
/// first (of fewer where they are slow), since what comes on top is somebody else's. None: the
/// device does not tell.
[[nodiscard]] std::optional<double> frame_ms(const vulkan::Context& context,
                                             render::FrameRenderer& renderer,
                                             const gaze::StereoView& views);

/// Sets render.scale to the greatest, up to 1, at which `passes` are expected to keep the
/// governor's budget on this device, by frames of two sizes that nobody sees; says so in the log.
/// Leaves it alone where the device tells no times. Throws SetupError: as scene::make_scene().
void fit_scale(const vulkan::Context& context, const render::MakePasses& passes,
               ProgramSettings& settings);

/// The scale at which a frame takes `budget_ms`, given what it takes at two scales: a fixed part,
/// and one that grows with the picture's area. In [.05, 1] for any times.
[[nodiscard]] double scale_within(double budget_ms, double small, double small_ms, double larger,
                                  double larger_ms);

}  // namespace gazeloop::run
