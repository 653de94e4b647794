#include "runtime/run/run_checks.h"

#include <fmt/core.h>
#include <spdlog/spdlog.h>

#include "runtime/foveation/log_polar/degenerate_map.h"
#include "runtime/report/output_file.h"
#include "runtime/session/session_recorder.h"

namespace gazeloop::run {

void check_request(const FrameRunRequest& request) {
    const ProgramValues& values = request.settings->values();
    if (values.target.name == "openxr" && !values.vulkan.device.empty()) {
        throw SetupError(
            ErrorKind::Usage,
            fmt::format("{}: vulkan.device: over OpenXR the runtime chooses the device; use it "
                        "with --target headless",
                        request.settings->origin("vulkan.device")));
    }
    if (values.render.method == "kfr") {
        (void)value_or_throw(methods::parameters(values.methods.kfr, *request.settings));
    }
    if (request.openxr_gaze &&
        (values.target.name != "openxr" || request.clock != RunClock::Wall)) {
        throw SetupError(ErrorKind::Usage,
                         "--gaze openxr: the gaze comes with the session that the pictures go "
                         "to, as it happens: use it with --target openxr and --clock wall");
    }
    if (request.record) {
        value_or_throw(session::SessionRecorder::check(*request.record));
    }
    if (request.json) {
        value_or_throw(report::check_output(*request.json));
    }
}

void check_recorded_target(const FrameRunRequest& request, const render::RendererConfig& config) {
    if (request.clock != RunClock::Recorded) {
        return;
    }
    for (const gaze::Eye eye : gaze::kEyes) {
        const gaze::EyeView& view = request.session->frames.front().frame.views[gaze::index(eye)];
        const vk::Extent2D extent = config.extents[gaze::index(eye)];
        if (extent != vk::Extent2D(view.width_px, view.height_px)) {
            throw SetupError(
                ErrorKind::Usage,
                fmt::format("the recording's pictures have {}x{} px, the target's {}x{}: replay "
                            "it with --target headless, or with the display it was recorded on",
                            view.width_px, view.height_px, extent.width, extent.height));
        }
    }
}

void check_map(const FrameRunRequest& request, const render::RendererConfig& config) {
    if (config.method != render::Method::Kfr) {
        return;
    }
    const foveation::ImageSize image{config.extents[0].width, config.extents[0].height};
    const gaze::PixelPosition middle{image.width_px / 2.0, image.height_px / 2.0};
    const foveation::LpSize lp = value_or_throw(foveation::lp_buffer_size(config.kfr, image));
    foveation::SamplingPlan plan;
    foveation::plan_kfr(config.kfr, lp, image, middle, plan);
    const std::string why =
        foveation::why_degenerate(foveation::LogPolarMap(config.kfr.kernel, image, middle), lp,
                                  plan.disc_radius_px - plan.disc_border_px);
    if (why.empty()) {
        return;
    }
    const std::string text = fmt::format(
        "kfr draws nothing worth seeing with {}x{} texels for {}x{} px: {}: use a smaller "
        "kfr.sigma, a larger kfr.lp_width, or another kfr.alpha or kfr.kernel (gazeloop plan "
        "shows what each does)",
        lp.width, lp.height, image.width_px, image.height_px, why);
    if (request.clock != RunClock::Recorded) {
        throw SetupError(ErrorKind::Usage, text);
    }
    spdlog::warn("{}", text);
}

}  // namespace gazeloop::run
