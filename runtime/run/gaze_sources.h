#pragma once

#include <functional>
#include <memory>
#include <string_view>

#include "drivers/gaze_source.h"
#include "drivers/hid/tracker_session.h"
#include "drivers/psvr2/headset.h"
#include "runtime/error.h"
#include "runtime/gaze/gaze_trace.h"
#include "runtime/profiles/profiles.h"
#include "runtime/run/program_settings.h"
#include "runtime/settings/settings.h"
#include "sim/gaze_simulation.h"

namespace gazeloop::run {

using MakeSource = std::function<std::unique_ptr<drivers::GazeSource>(std::int64_t start_ns)>;

/// What --gaze names: hid, hid:/dev/hidrawN, psvr2, trace:FILE, fixed:AZ,EL or sim. Reads a trace
/// at once; a device may come later. Errors: Usage for an unknown source, otherwise the source's
/// own.
Expected<MakeSource> gaze_source_named(std::string_view text,
                                       const profiles::TrackerProfile& tracker,
                                       const ProgramValues& values);

/// Whether --gaze names a device, which may be there or not.
bool is_device(std::string_view gaze);

/// The options of HID trackers (node not chosen) as configured.
drivers::hid::HidOptions hid_options(const profiles::TrackerProfile& tracker,
                                     const ProgramValues& values);

/// The options of a PlayStation VR2 as configured.
drivers::psvr2::Psvr2Options psvr2_options(const profiles::TrackerProfile& tracker);

/// A source that is one certain tracker brings that tracker's profile along, unless another one is
/// configured.
Expected<void> default_tracker(std::string_view gaze, settings::Settings& settings);

/// Plays a trace, `speed` times as fast as it was recorded; every sample arrives `delay_ns` after
/// it was taken, later by as much as the trace says.
MakeSource trace_player(gaze::GazeTrace trace, std::int64_t delay_ns, double speed);

}  // namespace gazeloop::run
