#include <nlohmann/json.hpp>

#include "runtime/probe/measurement.h"
#include "runtime/probe/video_result.h"

namespace gazeloop::probe {
namespace {

using Json = nlohmann::ordered_json;

Json or_null(const std::optional<double>& value) { return value ? Json(*value) : Json(nullptr); }

Json delays_json(const DelayStatistics& delays) {
    return {{"trials", delays.trials},
            {"mean_ms", or_null(delays.mean_ms)},
            {"uncertain_ms", or_null(delays.uncertain_ms())},
            {"uncertain_by",
             {{"scatter_and_frame_ms", or_null(delays.uncertain_scatter_ms)},
              {"camera_rate_ms", delays.uncertain_rate_ms},
              {"rows_and_exposure_ms", delays.uncertain_fixed_ms}}},
            {"sd_ms", or_null(delays.sd_ms)},
            {"min_ms", or_null(delays.min_ms)},
            {"p50_ms", or_null(delays.p50_ms)},
            {"p95_ms", or_null(delays.p95_ms)},
            {"max_ms", or_null(delays.max_ms)}};
}

Json light_json(const Region& region, const LightChanges& light) {
    return {{"region", {region.x, region.y, region.width, region.height}},
            {"changes", light.changes.size()},
            {"dark", light.levels.dark},
            {"bright", light.levels.bright},
            {"noise", light.levels.noise},
            {"pulsed", light.pulsed},
            {"pulse_period_frames", or_null(light.pulse_period_frames)},
            {"short_flashes", light.glitches}};
}

}  // namespace

Json video_json(const VideoResult& result) {
    Json trials = Json::array();
    for (const Trial& trial : result.paired.trials) {
        trials.push_back({{"lamp", trial.on ? "on" : "off"},
                          {"lamp_frame", trial.lamp_frame},
                          {"patch_frame", trial.patch_frame},
                          {"delay_ms", result.delay_ms(trial)}});
    }
    const VideoQuestion& question = result.question;
    return {
        {"format", kMeasurementFormat},
        {"version", kMeasurementVersion},
        {"eye_lost", delays_json(result.on)},
        {"eye_found", delays_json(result.off)},
        {"camera",
         {{"frames", result.frames},
          {"repeated_frames", result.repeated_frames},
          {"width", result.width},
          {"height", result.height},
          {"fps", question.camera_fps},
          {"fps_error_percent", question.fps_error_percent},
          {"readout_ms", or_null(question.readout_ms)}}},
        {"lamp", light_json(question.lamp, result.lamp)},
        {"patch", light_json(question.patch, result.patch)},
        {"unpaired", {{"lamp", result.paired.lamp_alone}, {"patch", result.paired.patch_alone}}},
        {"warnings", result.warnings},
        {"trials", trials}};
}

}  // namespace gazeloop::probe
