#include "runtime/run/calibration_run.h"

#include <fmt/core.h>

#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>

#include "drivers/rehearsal/rehearsal_source.h"
#include "runtime/calibrate/personal_file.h"
#include "runtime/calibrate/result_json.h"
#include "runtime/calibrate/target_observer.h"
#include "runtime/calibration/calibration_file.h"
#include "runtime/report/output_file.h"
#include "runtime/report/summary_json.h"
#include "runtime/run/run_checks.h"

namespace gazeloop::run {

std::optional<ErrorKind> calibration_run(const CalibrationRun& wanted, FrameRunRequest request,
                                         ProgramSettings& settings) {
    // What is measured is the tracker without a calibration, and points have no depth of the scene.
    // So the file that was in use until now is not read, and may be written anew.
    value_or_throw(settings.set("gaze.calibration", "", "gazeloop calibrate"));
    value_or_throw(settings.set("gaze.calibration_values", "", "gazeloop calibrate"));
    value_or_throw(settings.set("gaze.calibration_device", "", "gazeloop calibrate"));
    value_or_throw(settings.set("render.depth", "false", "gazeloop calibrate"));
    const std::string user = wanted.user.empty() ? calibrate::login_name() : wanted.user;
    const std::filesystem::path file = wanted.out.empty()
                                           ? calibrate::personal_file(user, wanted.gaze)
                                           : std::filesystem::path(wanted.out);
    if (wanted.gaze == "sim") {
        request.make_source = [&, simulation = settings.values().sim](std::int64_t start_ns) {
            return std::make_unique<drivers::RehearsalSource>(
                wanted.schedule, simulation,
                wanted.bad_point ? std::optional(std::size_t{*wanted.bad_point} - 1) : std::nullopt,
                start_ns);
        };
    } else if (wanted.bad_point) {
        throw SetupError(ErrorKind::Usage,
                         "--bad-point: only a simulated person (--gaze sim) can be "
                         "told to look aside");
    }
    const std::string& json = wanted.json;
    const bool quiet = wanted.quiet;
    request.json.reset();  // the calibration's own result goes there
    request.quiet = true;
    check_results(request, {{"--out", file}, {"--json", json}});
    std::FILE* const out = json == "-" ? stderr : stdout;
    if (!quiet) {
        fmt::print(out,
                   "Look at the white dot until the next one appears, nine times, {:.0f} s in "
                   "all.\n",
                   wanted.schedule.length_s());
        std::fflush(out);
    }
    calibration::CalibrationSamples samples(wanted.schedule,
                                            settings.values().gaze.minimum_confidence);
    request.make_overlay = [&](const vulkan::Context& context,
                               const render::RendererConfig& config) {
        return std::make_unique<calibrate::TargetObserver>(context, config.frames_in_flight,
                                                           wanted.schedule, samples);
    };
    request.loop.end_with_source = false;
    request.loop.stop = [&samples]() -> std::optional<LoopEnd> {
        return samples.over() ? std::optional(LoopEnd::Limit) : std::nullopt;
    };
    if (const auto failure = frame_run(request)) {
        return failure;
    }
    const calibration::CalibrationResult result = calibration::result_of(samples);
    if (result.any()) {
        calibration::CalibrationFile made{
            .user = user, .device = wanted.gaze, .calibration = result.calibration()};
        for (std::size_t eye = 0; eye < gaze::kEyeCount; ++eye) {
            if (result.eyes[eye]) {
                made.expected_error_deg[eye] = result.eyes[eye]->leave_one_out_median_deg;
            }
        }
        value_or_throw(calibration::write_calibration(made, file));
    }
    if (!quiet) {
        fmt::print(out, "{}", calibration::result_text(result));
        fmt::print(out, "{}",
                   result.any()
                       ? fmt::format("written to {}: --set gaze.calibration={} applies it\n",
                                     file.string(), file.string())
                       : std::string("nothing was written\n"));
    }
    if (!json.empty()) {
        value_or_throw(report::write_text(json, report::json_text(calibrate::result_json(
                                                    result, result.any() ? file.string() : ""))));
    }
    return result.any() ? std::nullopt : std::optional(ErrorKind::GateFailed);
}

}  // namespace gazeloop::run
