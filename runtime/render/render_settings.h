#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "runtime/render/antialiasing.h"
#include "runtime/render/camera_motion.h"
#include "runtime/settings/setting_row.h"

namespace gazeloop::render {

/// The settings render.*
struct RenderSettings {
    std::string method = "kfr";
    std::string scene = "raymarch";
    std::string camera = "still";
    std::string require = "scene";
    std::string lp_gaussian = "scene";
    bool specular_filter = true;
    bool footprint = false;
    std::int64_t footprint_taps = 1;
    std::int64_t post_filter_px = 0;
    bool over_frames = false;
    bool forget_at_landings = true;
    std::int64_t spp = 1;
    double scale = 1.0;
    bool profile = true;
    bool depth = true;
    bool hidden_area = true;
    std::int64_t frames_in_flight = 2;
    bool wait_before_latch = true;
};

/// What they say of antialiasing.
[[nodiscard]] Antialiasing antialiasing_of(const RenderSettings& render);

/// Whether a log-polar buffer's periphery is smoothed.
[[nodiscard]] FilterUse lp_gaussian_of(const RenderSettings& render);

/// What render.camera says.
[[nodiscard]] CameraMotion camera_of(const RenderSettings& render);

/// `methods`: the names that render.method may have.
[[nodiscard]] std::vector<settings::SettingRow> rows_of(RenderSettings& render,
                                                        std::vector<std::string> methods);

}  // namespace gazeloop::render
