#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "runtime/display/display_profile.h"
#include "runtime/render/render_settings.h"
#include "runtime/trade/sweep.h"
#include "runtime/vulkan/vulkan_settings.h"

namespace gazeloop::trade {

/// Which methods and settings are held against each other, and where the result goes.
struct TradeRequest {
    std::string methods = "kfr,acuity";  ///< with commas between
    std::string sigmas;                  ///< values of kfr.sigma, with commas between; empty: none
    std::string alphas;                  ///< of kfr.alpha
    std::string slopes;                  ///< of acuity.mar
    std::vector<std::string> varied;     ///< see parse_varied
    std::uint64_t frames = 4;            ///< at the display's rate; 1: a still
    std::uint64_t rounds = 3;
    std::uint64_t reference_samples = 16;
    gaze::Eye eye = gaze::Eye::Left;
    std::string gaze;  ///< see recordings::ComparedGaze::parse
    quality::MetricChoice metrics = quality::kEveryMetric;
    quality::ContrastOptions contrast{};
    std::string csv;     ///< "-": stdout; empty: not asked for
    std::string json;    ///< the same
    bool quiet = false;  ///< no table on stdout
};

/// By what all points are rendered.
struct TradeScene {
    display::DisplayProfile display;
    const render::RenderSettings& render;
    const vulkan::VulkanSettings& vulkan;
    const methods::MethodSettings& methods;
};

/// Renders all points, writes what was asked for, and gives whether each could be rendered; logs
/// which could not. `settings` hold the rows of what `scene` refers to.
/// @throws SetupError: Usage for what does not fit together, and as sweep()
[[nodiscard]] bool trade_off(const TradeRequest& request, const TradeScene& scene,
                             settings::Settings& settings, const SweepHooks& hooks);

}  // namespace gazeloop::trade
