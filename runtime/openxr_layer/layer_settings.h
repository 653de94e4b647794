#pragma once

#include <string>
#include <vector>

#include "runtime/settings/setting_row.h"

namespace gazeloop::openxr_layer {

/// The settings layer.*: what the OpenXR API layer does for applications that are not gazeloop.
struct LayerSettings {
    std::string eye_gaze = "where-lacking";   ///< when XR_EXT_eye_gaze_interaction is the layer's
    std::string foveation = "where-lacking";  ///< when foveation state is the layer's
    double blend = 0.2;
    double mar = 0.022;
    double periphery = 0.5;
    std::string quad_views = "where-lacking";  ///< when four views are the layer's
    std::string gaze;                          ///< a source, as run's --gaze; empty: none
    std::string record;                        ///< a session, or the folder for them; empty: none
    std::string unknown_applications = "allow";
};

[[nodiscard]] std::vector<settings::SettingRow> rows_of(LayerSettings& layer);

}  // namespace gazeloop::openxr_layer
