#include "runtime/run/run_target.h"

#include <fmt/core.h>

#include "runtime/present/headless_target.h"
#include "runtime/present/scaled_extent.h"
#include "runtime/profiles/profiles_in_force.h"

namespace gazeloop::run {
namespace {

constexpr std::uint32_t kMaxSide_px = 16384;  // of an image, on today's devices

vk::Format format_named(std::string_view text) {
    for (const vk::Format format : {vk::Format::eR8G8B8A8Srgb, vk::Format::eB8G8R8A8Srgb,
                                    vk::Format::eR8G8B8A8Unorm, vk::Format::eB8G8R8A8Unorm}) {
        if (text == vk::to_string(format)) {
            return format;
        }
    }
    throw SetupError(ErrorKind::BadInput,
                     fmt::format("the session was rendered in the format '{}', which this version "
                                 "does not know",
                                 text));
}

gaze::PerEye<vk::Extent2D> scaled_extents(const display::DisplayProfile& display, double scale) {
    const vk::Extent2D extent = present::scaled_extent({display.width_px, display.height_px}, scale,
                                                       {kMaxSide_px, kMaxSide_px});
    return {extent, extent};
}

}  // namespace

display::DisplayProfile display_of(const FrameRunRequest& request) {
    const ProgramValues& values = request.settings->values();
    if (request.clock != RunClock::Recorded || values.target.name != "headless") {
        return value_or_throw(profiles::display_in_force(values.profile, *request.settings));
    }
    display::DisplayProfile display = request.recording->session->info().header.meta.display;
    if (display.refresh_hz <= 0.0) {
        constexpr double kUnrecorded_hz = 60.0;
        display.refresh_hz = kUnrecorded_hz;
    }
    return display;
}

std::unique_ptr<present::OpenXrTarget> make_openxr_target(const FrameRunRequest& request,
                                                          const display::DisplayProfile& display) {
    const ProgramValues& values = request.settings->values();
    present::OpenXrOptions options{.display = display,
                                   .scale = values.render.scale,
                                   .validation = values.target.validation,
                                   .depth = values.render.depth,
                                   .patience_s = values.openxr.patience_s};
    if (request.openxr_gaze) {
        options.extensions.push_back(drivers::kEyeGazeExtension);
    }
    return present::make_openxr_target(options);
}

std::unique_ptr<present::FrameTarget> make_headless_target(const FrameRunRequest& request,
                                                           const display::DisplayProfile& display) {
    const ProgramValues& values = request.settings->values();
    present::HeadlessTarget::Options options{
        .display = display,
        .extents = scaled_extents(display, values.render.scale),
        .paced = request.clock == RunClock::Wall};
    if (request.clock == RunClock::Recorded) {
        for (const gaze::Eye eye : gaze::kEyes) {
            const gaze::EyeView& view = request.recording->views[gaze::index(eye)];
            options.extents[gaze::index(eye)] = vk::Extent2D(view.width_px, view.height_px);
        }
        const auto& format = request.recording->session->info().header.meta.target_format;
        if (!format.empty()) {
            options.format = format_named(format);
        }
    }
    return std::make_unique<present::HeadlessTarget>(options);
}

}  // namespace gazeloop::run
