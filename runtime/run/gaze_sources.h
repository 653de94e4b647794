#pragma once

#include <functional>
#include <memory>
#include <string_view>

#include "drivers/gaze_source.h"
#include "drivers/hid/hid_settings.h"
#include "drivers/hid/tracker_session.h"
#include "drivers/psvr2/headset.h"
#include "drivers/steam_frame/eye_service.h"
#include "drivers/steam_frame/steam_frame_settings.h"
#include "drivers/trace/trace_settings.h"
#include "runtime/error.h"
#include "runtime/gaze/gaze_trace.h"
#include "runtime/profiles/profiles.h"
#include "runtime/settings/settings.h"
#include "sim/gaze_simulation.h"

namespace gazeloop::run {

using MakeSource = std::function<std::unique_ptr<drivers::GazeSource>(std::int64_t start_ns)>;

/// The settings that sources are made of, those of gazeloop itself or of its OpenXR API layer.
/// They must outlive this.
struct SourceValues {
    template <typename Values>
    SourceValues(const Values& values)  // NOLINT(google-explicit-constructor): it is a view
        : hid(values.hid), sim(values.sim), steam_frame(values.steam_frame), trace(values.trace) {}

    const drivers::hid::HidSettings& hid;
    const sim::GazeSimulation& sim;
    const drivers::steam_frame::SteamFrameSettings& steam_frame;
    const drivers::TraceSettings& trace;
};

/// The source that --gaze names: hid, hid:/dev/hidrawN, psvr2, steam-frame, steam-frame:FILE,
/// trace:FILE, fixed:AZ,EL or sim. Reads a trace at once; a device may come later. Errors: Usage
/// for an unknown source, otherwise the source's own.
Expected<MakeSource> gaze_source_named(std::string_view text,
                                       const profiles::TrackerProfile& tracker,
                                       const SourceValues& values);

/// Whether --gaze names a device, connected or not.
bool is_device(std::string_view gaze);

/// The configured options of HID trackers. Their device node is left open.
drivers::hid::HidOptions hid_options(const profiles::TrackerProfile& tracker,
                                     const SourceValues& values);

/// The configured options of a PlayStation VR2.
drivers::psvr2::Psvr2Options psvr2_options(const profiles::TrackerProfile& tracker);

/// The configured options of a Steam Frame.
drivers::steam_frame::SteamFrameOptions steam_frame_options(const profiles::TrackerProfile& tracker,
                                                            const SourceValues& values);

/// The name of the profile of a source that is one certain tracker; empty for any other.
std::string_view certain_tracker(std::string_view gaze);

/// Sets the tracker's profile if the source is one certain tracker, and how open an eye counts as
/// shut where it states that; unless they are configured.
Expected<void> default_tracker(std::string_view gaze, settings::Settings& settings);

/// Sets the error and the noise that gaze.widen counts with to what the profile states, unless they
/// are configured.
Expected<void> default_widening(const profiles::TrackerProfile& tracker,
                                settings::Settings& settings);

/// Plays a trace, `speed` times as fast as it was recorded. Every sample arrives `delay_ns` after
/// it was taken, plus the delay that the trace gives.
MakeSource trace_player(gaze::GazeTrace trace, std::int64_t delay_ns, double speed);

}  // namespace gazeloop::run
