#pragma once

#include <chrono>
#include <filesystem>
#include <string>
#include <vector>

#include "drivers/hid/tracker_session.h"
#include "runtime/display/display_profile.h"
#include "runtime/doctor/finding.h"
#include "runtime/doctor/probe.h"

namespace gazeloop::doctor {

using Findings = std::vector<Finding>;

struct VulkanChecks {
    std::string device;         ///< the setting vulkan.device
    std::string device_origin;  ///< where that was set
    bool validation = false;    ///< the setting vulkan.validation
};

/// Loader, each device, the one that the loop would choose, its clock, validation layers. In a
/// process of its own.
Findings check_vulkan(const VulkanChecks& asked, const ProbeLimits& limits);

struct OpenXrChecks {
    display::DisplayProfile display;
    double scale = 1.0;
    bool validation = false;
    bool vulkan_works = true;  ///< whether there is a device that could render
    bool is_target = true;     ///< the loop is to run over OpenXR: a failure stops it
};

/// Runtime, extensions, system, eye gaze gate by gate, clock, and the loop's own session. In
/// processes of their own.
Findings check_openxr(const OpenXrChecks& asked, const ProbeLimits& limits);

/// The eye gaze of the OpenXR runtime, gate by gate. If the runtime and the headset have it, gaze
/// is read for `seconds` in a session that shows nothing. In a process of its own. The last
/// finding, openxr.eye_gaze.samples, has what came as facts.
Findings check_eye_gaze(const OpenXrChecks& asked, double seconds, const ProbeLimits& limits);

struct HidChecks {
    drivers::hid::HidOptions options;
    std::chrono::milliseconds listen{2000};  ///< to all trackers at once
    drivers::StopRequested stop;             ///< asked by several threads
};

/// Trackers on HID: what their descriptors are good for, who may open their nodes, whether they
/// answer what they are asked, and whether anything comes from them.
Findings check_hid(const HidChecks& asked);

/// CLOCK_MONOTONIC and what it is read from.
Findings check_clocks(const std::filesystem::path& root);

/// Whether threads may run in real time, and how the processors are governed.
Findings check_scheduling(const std::filesystem::path& root);

/// Whether recordings can be written into a folder, and how fast.
Findings check_recording_folder(const std::filesystem::path& folder);

}  // namespace gazeloop::doctor
