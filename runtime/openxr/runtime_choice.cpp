#include "runtime/openxr/runtime_choice.h"

#include <fmt/core.h>
#include <spdlog/spdlog.h>

#include <cstdlib>
#include <filesystem>
#include <numbers>
#include <optional>
#include <string_view>
#include <vector>

#include "runtime/environment.h"
#include "runtime/error.h"
#include "runtime/files/cache_folder.h"

namespace gazeloop::openxr {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kRemedy =
    "run ./dev setup to build Monado, name a runtime's JSON file in XR_RUNTIME_JSON, or use "
    "--target headless";

bool is_there(const fs::path& file) {
    std::error_code ignored;
    return fs::exists(file, ignored);
}

/// Where the loader looks for the system's choice, in its order.
std::vector<fs::path> active_runtime_folders() {
    std::vector<fs::path> folders;
    if (const auto config = environment_value("XDG_CONFIG_HOME")) {
        folders.emplace_back(*config);
    } else if (const auto home = environment_value("HOME")) {
        folders.emplace_back(fs::path(*home) / ".config");
    }
    for (const std::string& folder :
         split_list(environment_value("XDG_CONFIG_DIRS").value_or("/etc/xdg"))) {
        folders.emplace_back(folder);
    }
    folders.emplace_back("/etc");
    folders.emplace_back("/usr/local/etc");
    return folders;
}

/// Keeps what the user has set.
void set_default(const char* name, const std::string& value) { setenv(name, value.c_str(), 0); }

std::string fov_text(const gaze::FieldOfView& fov) {
    constexpr double kDegrees = 180.0 / std::numbers::pi;
    return fmt::format("{},{},{},{}", fov.left_rad * kDegrees, fov.right_rad * kDegrees,
                       fov.up_rad * kDegrees, fov.down_rad * kDegrees);
}

void simulate_display(const display::DisplayProfile& display) {
    if (display.cant_outward_rad != gaze::PerEye<double>{}) {
        spdlog::warn(
            "display '{}' has canted views, the simulated headset does not: its views are "
            "parallel; use --target headless to see them as they are",
            display.name);
    }
    set_default("SIMULATED_ENABLE", "1");
    set_default("XRT_COMPOSITOR_NULL", "1");
    set_default("XRT_NO_STDIN", "1");
    // Monado warns of every late frame; the summary says it once.
    set_default("XRT_LOG", "error");
    set_default("XRT_COMPOSITOR_LOG", "error");
    set_default("PROBER_LOG", "warn");
    set_default("SIMULATED_LOG", "warn");
    set_default("OXR_NO_PRINTING", "1");
    // The pacer would overshoot when frames are slower than the display.
    set_default("U_PACING_APP_USE_MIN_FRAME_PERIOD", "1");
    set_default("GAZELOOP_DISPLAY_WIDTH_PX", fmt::format("{}", display.width_px));
    set_default("GAZELOOP_DISPLAY_HEIGHT_PX", fmt::format("{}", display.height_px));
    set_default("GAZELOOP_DISPLAY_REFRESH_HZ", fmt::format("{}", display.refresh_hz));
    set_default("GAZELOOP_DISPLAY_IPD_MM", fmt::format("{}", display.ipd_m * 1e3));
    set_default("GAZELOOP_DISPLAY_FOV_LEFT", fov_text(display.fov[0]));
    set_default("GAZELOOP_DISPLAY_FOV_RIGHT", fov_text(display.fov[1]));
}

}  // namespace

RuntimeChoice choose_runtime(const display::DisplayProfile& display) {
    const fs::path ours = files::cache_folder() / "monado/share/openxr/1/openxr_monado.json";
    if (const auto chosen = environment_value("XR_RUNTIME_JSON")) {
        if (!is_there(*chosen)) {
            throw SetupError(
                ErrorKind::NoDevice,
                fmt::format("no OpenXR runtime: XR_RUNTIME_JSON names '{}', which does "
                            "not exist; {}",
                            *chosen, kRemedy));
        }
        std::error_code ignored;
        if (fs::equivalent(*chosen, ours, ignored)) {
            simulate_display(display);
        }
        return {*chosen, "XR_RUNTIME_JSON"};
    }
    for (const fs::path& folder : active_runtime_folders()) {
        const fs::path manifest = folder / "openxr/1/active_runtime.json";
        if (is_there(manifest)) {
            return {manifest, "active runtime of the system"};
        }
    }
    if (is_there(ours)) {
        setenv("XR_RUNTIME_JSON", ours.c_str(), 1);
        simulate_display(display);
        return {ours, "built by ./dev setup"};
    }
    const fs::path packaged = "/usr/share/openxr/1/openxr_monado.json";
    if (is_there(packaged)) {
        setenv("XR_RUNTIME_JSON", packaged.c_str(), 1);
        return {packaged, "package of the system"};
    }
    throw SetupError(ErrorKind::NoDevice, fmt::format("no OpenXR runtime: {}", kRemedy));
}

}  // namespace gazeloop::openxr
