#include "runtime/run/run_checks.h"

#include <fmt/core.h>
#include <spdlog/spdlog.h>

#include <iterator>
#include <utility>

#include "runtime/methods/registry.h"
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
    (void)value_or_throw(
        methods::find_method(values.render.method)->passes(values.methods, *request.settings));
    if (request.openxr_gaze &&
        (values.target.name != "openxr" || request.clock != RunClock::Wall)) {
        throw SetupError(ErrorKind::Usage,
                         "--gaze openxr: the gaze comes with the session that the pictures go "
                         "to, as it happens: use it with --target openxr and --clock wall");
    }
    if (request.from_device && request.clock == RunClock::Virtual) {
        throw SetupError(ErrorKind::Usage,
                         fmt::format("--gaze {}: a device's samples come in real time, and virtual "
                                     "time waits for none: use it with --clock wall, or record it "
                                     "and replay that",
                                     request.gaze));
    }
    if (values.governor.use == "on" &&
        (request.chooser == nullptr || values.governor.levels.empty())) {
        throw SetupError(ErrorKind::Usage,
                         fmt::format("{}: governor.use: only run and replay are governed; use off",
                                     request.settings->origin("governor.use")));
    }
    if (request.record) {
        value_or_throw(session::SessionRecorder::check(*request.record));
    }
    check_results(request, {{"--json", request.json.value_or("")}});
}

void check_results(const FrameRunRequest& request, std::vector<report::NamedFile> results) {
    std::vector<report::NamedFile> reads = report::files_of(*request.settings);
    std::ranges::copy(request.reads, std::back_inserter(reads));
    value_or_throw(report::check_outputs(results, reads));
    // SessionRecorder has rules of its own.
    results.push_back({"--record", request.record.value_or("")});
    value_or_throw(report::check_apart(results, reads));
}

void check_recorded_target(const FrameRunRequest& request, const render::RendererConfig& config) {
    if (request.clock != RunClock::Recorded) {
        return;
    }
    for (const gaze::Eye eye : gaze::kEyes) {
        const gaze::EyeView& view = request.recording->views[gaze::index(eye)];
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

void check_picture(const FrameRunRequest& request, const render::RendererConfig& config) {
    const ProgramValues& values = request.settings->values();
    const methods::Method& method = *methods::find_method(values.render.method);
    if (method.check_picture == nullptr) {
        return;
    }
    const auto checked = method.check_picture(values.methods, *request.settings,
                                              {config.extents[0].width, config.extents[0].height});
    if (checked) {
        return;
    }
    if (request.clock != RunClock::Recorded) {
        throw SetupError(checked.error());
    }
    spdlog::warn("{}", checked.error().message);
}

}  // namespace gazeloop::run
