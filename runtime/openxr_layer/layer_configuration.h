#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "drivers/hid/hid_settings.h"
#include "drivers/steam_frame/steam_frame_settings.h"
#include "drivers/trace/trace_settings.h"
#include "runtime/calibration/eye_calibration.h"
#include "runtime/error.h"
#include "runtime/gaze/gaze_settings.h"
#include "runtime/named_value.h"
#include "runtime/openxr_layer/gaze_feed.h"
#include "runtime/openxr_layer/layer_settings.h"
#include "runtime/profiles/profile_settings.h"
#include "runtime/profiles/profiles.h"
#include "runtime/settings/settings.h"
#include "sim/gaze_simulation.h"

namespace gazeloop::openxr_layer {

/// What can be configured of the layer: the program's settings of the same names, and layer.*.
struct LayerValues {
    gaze::GazeSettings gaze;
    drivers::hid::HidSettings hid;
    LayerSettings layer;
    profiles::ProfileSettings profile;
    sim::GazeSimulation sim;
    drivers::steam_frame::SteamFrameSettings steam_frame;
    drivers::TraceSettings trace;
};

/// Settings for a launched application, "KEY=VALUE" each on a line of its own: as --set.
inline constexpr const char* kSettingsVariable = "GAZELOOP_LAYER_SETTINGS";

/// What the files and the environment say.
struct LayerConfiguration {
    LayerValues values;
    profiles::TrackerProfile tracker;
    std::optional<calibration::Calibration> calibration;
    std::vector<NamedValue> list;  ///< every setting in force
};

/// The program's own files (Settings::standard_files()), layer.toml beside the user's one, then
/// kSettingsVariable. Groups of settings that concern gazeloop's own pictures are passed over.
/// Errors: as Settings::load().
Expected<LayerConfiguration> load_configuration();

/// What `gazeloop layer enable` writes and load_configuration() reads; none where there is no home.
[[nodiscard]] std::optional<std::filesystem::path> layer_config_file();

/// Settings of the layer (KEY=VALUE) as a file of them, each checked. Errors: Usage as
/// Settings::set(), and for a setting that is none of the layer's; layer.gaze as check_gaze().
Expected<std::string> settings_file(const std::vector<std::string>& assignments);

/// Whether layer.gaze names a source that there is; a device may come later. Errors: the source's
/// own.
Expected<void> check_gaze(const LayerConfiguration& configuration);

/// The source that layer.gaze names, corrected and checked as in a run of gazeloop; null where it
/// names none. Sources of one name are one feed in a process, since a tracker has one reader.
/// Errors: the source's own.
Expected<std::shared_ptr<GazeFeed>> open_feed(const LayerConfiguration& configuration);

}  // namespace gazeloop::openxr_layer
