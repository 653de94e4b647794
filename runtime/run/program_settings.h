#pragma once

#include "drivers/hid/hid_settings.h"
#include "drivers/steam_frame/steam_frame_settings.h"
#include "drivers/trace/trace_settings.h"
#include "runtime/error.h"
#include "runtime/gaze/gaze_settings.h"
#include "runtime/governor/governor_settings.h"
#include "runtime/methods/method_settings.h"
#include "runtime/openxr_layer/layer_settings.h"
#include "runtime/present/openxr/openxr_settings.h"
#include "runtime/profiles/profile_settings.h"
#include "runtime/render/render_settings.h"
#include "runtime/run/monitor_settings.h"
#include "runtime/run/target_settings.h"
#include "runtime/run/virtual_time_settings.h"
#include "runtime/scene/light_field_settings.h"
#include "runtime/settings/settings.h"
#include "runtime/vulkan/vulkan_settings.h"
#include "sim/gaze_simulation.h"

namespace gazeloop::run {

/// Everything that can be configured, with its built-in value. Each room declares its own group.
struct ProgramValues {
    gaze::GazeSettings gaze;
    governor::GovernorSettings governor;
    drivers::hid::HidSettings hid;
    openxr_layer::LayerSettings layer;
    scene::LightFieldSettings light_field;
    methods::MethodSettings methods;
    MonitorSettings monitor;
    present::OpenXrSettings openxr;
    profiles::ProfileSettings profile;
    render::RenderSettings render;
    sim::GazeSimulation sim;
    drivers::steam_frame::SteamFrameSettings steam_frame;
    TargetSettings target;
    drivers::TraceSettings trace;
    VirtualTimeSettings virtual_time;
    vulkan::VulkanSettings vulkan;
};

/// The settings of the whole program, with their values.
class ProgramSettings : public settings::Settings {
  public:
    ProgramSettings();

    [[nodiscard]] const ProgramValues& values() const { return values_; }

    /// Whether the settings fit together. Errors (Usage): names two that do not, and the remedy.
    [[nodiscard]] Expected<void> check() const;

  private:
    ProgramValues values_;
};

}  // namespace gazeloop::run
