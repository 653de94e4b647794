#pragma once

#include <cstdint>
#include <functional>
#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <vector>

#include "runtime/display/display_profile.h"
#include "runtime/render/render_settings.h"
#include "runtime/trade/page/sweep_outputs.h"
#include "runtime/trade/sweep.h"
#include "runtime/vulkan/vulkan_settings.h"

namespace gazeloop::trade {

/// Where the compared eye looks, in the head frame, so long after the first frame.
struct LookedAt {
    std::string text;  ///< as it was asked for
    std::function<glm::dvec3(std::int64_t time_ns)> direction_at;
};

/// Which methods and settings are held against each other, and where the result goes.
struct TradeRequest {
    std::string methods = "kfr,acuity";  ///< with commas between
    std::string sigmas{};                ///< values of kfr.sigma, with commas; empty: none
    std::string alphas{};                ///< of kfr.alpha
    std::string slopes{};                ///< of acuity.mar
    std::vector<std::string> varied{};   ///< see parse_varied
    std::string worth{};                 ///< a method: see worth_points(); empty: no such points
    double fewer = 12.0;                 ///< see FitQuestion
    bool published = false;              ///< also what published_grid() has
    std::string scenes{};                ///< with commas between; empty: the settings' scene
    std::vector<LookedAt> gazes{};       ///< each scene along each of them; not empty
    std::uint64_t frames = 4;            ///< at the display's rate; 1: a still
    std::uint64_t rounds = 3;
    std::uint64_t reference_samples = 16;
    gaze::Eye eye = gaze::Eye::Left;
    quality::MetricChoice metrics = quality::kEveryMetric;
    quality::ContrastOptions contrast{};
    std::string journal{};             ///< see SweepJournal; empty: none
    std::string shard = "1/1";         ///< see parse_shard
    std::vector<std::string> merge{};  ///< journals; not empty: nothing is measured
    std::optional<double> budget_ms{};
    std::vector<std::string> limits{};  ///< see parse_floor
    bool fit = false;
    std::string command_line{};  ///< for the page
    SweepOutputs outputs{};
};

/// By what all points are rendered.
struct TradeScene {
    display::DisplayProfile display;
    const render::RenderSettings& render;
    const vulkan::VulkanSettings& vulkan;
    const methods::MethodSettings& methods;
    const scene::LightFieldSettings& light_field;
};

/// Measures (or merges) all points, writes what was asked for, and gives whether each has figures
/// and something could be recommended; logs what not. `settings` hold the rows of what `scene`
/// refers to.
/// @throws SetupError: Usage for what does not fit together, and as measured_sweep() and
/// merged_sweep()
[[nodiscard]] bool trade_off(const TradeRequest& request, const TradeScene& scene,
                             settings::Settings& settings, const SweepHooks& hooks);

}  // namespace gazeloop::trade
