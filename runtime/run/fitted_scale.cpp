#include "runtime/run/fitted_scale.h"

#include <fmt/core.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <cmath>

#include "runtime/present/scaled_extent.h"
#include "runtime/profiles/profiles_in_force.h"
#include "runtime/run/interrupt.h"
#include "runtime/run/run_timeline.h"
#include "sim/baked_light_field.h"

namespace gazeloop::run {
namespace {

constexpr double kSmall = 0.08;
constexpr double kLarger = 0.16;
constexpr double kLeastScale = 0.05;  // below, nothing is seen
/// Of the budget: dear places of the scene lie elsewhere, and a better level needs room.
constexpr double kRoom = 0.6;
constexpr vk::Extent2D kMostExtent{16384, 16384};

}  // namespace

std::optional<double> frame_ms(const vulkan::Context& context, render::FrameRenderer& renderer,
                               const gaze::StereoView& views) {
    constexpr int kFrames = 9;
    constexpr double kLongEnough_ms = 400.0;
    constexpr double kNsPerMs = 1e6;
    std::optional<double> least;
    double all_ms = 0.0;
    for (int i = 0; i < kFrames && all_ms < kLongEnough_ms; ++i) {
        const frame::FrameGpuRecord gpu = render::render_unseen(context, renderer, views);
        const std::int64_t ns = gpu.gpu_end.ns - gpu.gpu_begin.ns;
        if (i == 0 || !gpu.gpu_begin.known() || !gpu.gpu_end.known() || ns <= 0) {
            continue;  // the first one compiles shaders
        }
        const double ms = static_cast<double>(ns) / kNsPerMs;
        all_ms += ms;
        least = least ? std::min(*least, ms) : ms;
    }
    return least;
}

double scale_within(double budget_ms, double small, double small_ms, double larger,
                    double larger_ms) {
    const double per_area = (larger_ms - small_ms) / (larger * larger - small * small);
    if (!(per_area > 0.0) || !(small_ms > 0.0) || !(budget_ms > 0.0)) {
        // The picture's size costs nothing that could be measured, or nothing is known.
        return budget_ms > 0.0 && small_ms > budget_ms ? kLeastScale : 1.0;
    }
    const double fixed_ms = std::max(small_ms - per_area * small * small, 0.0);
    const double area = std::max(budget_ms - fixed_ms, 0.0) / per_area;
    return std::clamp(std::sqrt(area), kLeastScale, 1.0);
}

void fit_scale(const vulkan::Context& context, const render::MakePasses& passes,
               ProgramSettings& settings) {
    const ProgramValues& values = settings.values();
    const display::DisplayProfile display =
        value_or_throw(profiles::display_in_force(values.profile, settings));
    const auto scene = sim::make_scene(
        context, values.render.scene,
        {.require_all = values.render.require == "all", .light_field = values.light_field},
        [] { return !interrupted(); });
    const auto ms_at = [&](double scale) {
        const vk::Extent2D extent =
            present::scaled_extent({display.width_px, display.height_px}, scale, kMostExtent);
        render::FrameRenderer renderer(context, *scene, passes,
                                       {.samples = static_cast<std::uint32_t>(values.render.spp),
                                        .extents = {extent, extent},
                                        .unshaded = std::nullopt});
        return frame_ms(context, renderer, profile_views(display, {extent, extent}));
    };
    const std::optional<double> small_ms = ms_at(kSmall);
    const std::optional<double> larger_ms = ms_at(kLarger);
    if (!small_ms || !larger_ms) {
        spdlog::info("governor: this device tells no times: render.scale stays {}",
                     values.render.scale);
        return;
    }
    const double budget_ms = values.governor.budget_of(display.period_ns());
    const double scale =
        std::round(1e3 * scale_within(kRoom * budget_ms, kSmall, *small_ms, kLarger, *larger_ms)) /
        1e3;
    spdlog::info(
        "governor: frames take {:.2f} ms at a render.scale of {} and {:.2f} at {}: {} is "
        "what {:.1f} ms allow",
        *small_ms, kSmall, *larger_ms, kLarger, scale, budget_ms);
    value_or_throw(settings.set("render.scale", fmt::format("{}", scale), "the governor"));
}

}  // namespace gazeloop::run
