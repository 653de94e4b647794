#include <fmt/core.h>
#include <fmt/format.h>

#include <iterator>

#include "runtime/probe/video_result.h"

namespace gazeloop::probe {
namespace {

std::string number(const std::optional<double>& ms) {
    return ms ? fmt::format("{:.2f}", *ms) : "-";
}

void append_row(std::string& text, std::string_view what, const DelayStatistics& delays) {
    fmt::format_to(std::back_inserter(text), "{:<26}{:>7}{:>9}{:>9}{:>9}{:>9}{:>9}{:>9}{:>9}\n",
                   what, delays.trials, number(delays.mean_ms), number(delays.uncertain_ms()),
                   number(delays.sd_ms), number(delays.min_ms), number(delays.p50_ms),
                   number(delays.p95_ms), number(delays.max_ms));
}

void append_parts(std::string& text, const DelayStatistics& delays) {
    if (!delays.uncertain_scatter_ms) {
        text += "The uncertainty is unknown: it takes two trials.\n";
        return;
    }
    fmt::format_to(std::back_inserter(text),
                   "Eye-to-photon is uncertain by {:.2f} ms (95 %): {:.2f} ms by scatter of the "
                   "trials and one\ncamera frame over sqrt(trials), {:.2f} ms by the camera's "
                   "rate, {:.2f} ms by rows and exposure.\n",
                   *delays.uncertain_ms(), *delays.uncertain_scatter_ms, delays.uncertain_rate_ms,
                   delays.uncertain_fixed_ms);
}

void append_light(std::string& text, std::string_view name, const LightChanges& light) {
    fmt::format_to(std::back_inserter(text),
                   "{:<8} {} changes, dark {:.3f}, bright {:.3f} of white", name,
                   light.changes.size(), light.levels.dark, light.levels.bright);
    if (light.pulse_period_frames) {
        fmt::format_to(std::back_inserter(text), ", in pulses every {:.2f} frames",
                       *light.pulse_period_frames);
    }
    if (light.glitches > 0) {
        fmt::format_to(std::back_inserter(text), ", {} shorter flashes left out", light.glitches);
    }
    text += "\n";
}

}  // namespace

std::string video_text(const VideoResult& result) {
    std::string text = fmt::format(
        "eye-to-photon, measured by lamp and camera: {} frames at {} fps, {:.2f} ms each\n\n",
        result.frames, result.question.camera_fps, result.frame_ms());
    fmt::format_to(std::back_inserter(text), "{:<26}{:>7}{:>9}{:>9}{:>9}{:>9}{:>9}{:>9}{:>9}\n",
                   "milliseconds", "trials", "mean", "+-", "SD", "min", "p50", "p95", "max");
    append_row(text, "eye lost (eye-to-photon)", result.on);
    append_row(text, "eye found again", result.off);
    text += "-: unknown, or withheld because a percentile p needs 1 / (1 - p) trials\n";
    append_parts(text, result.on);
    text += "Trackers lose and find the eye with different delays: take the first row.\n\n";
    append_light(text, "lamp", result.lamp);
    append_light(text, "patch", result.patch);
    fmt::format_to(std::back_inserter(text),
                   "unpaired {} changes of the lamp that the patch did not follow, {} of the patch "
                   "alone (blinks)\n",
                   result.paired.lamp_alone, result.paired.patch_alone);
    for (const std::string& warning : result.warnings) {
        text += "warning: " + warning + "\n";
    }
    text += "\ntrial  lamp    at frame     ms\n";
    for (std::size_t i = 0; i < result.paired.trials.size(); ++i) {
        const Trial& trial = result.paired.trials[i];
        fmt::format_to(std::back_inserter(text), "{:>5}  {:<4}{:>12.2f}{:>7.2f}\n", i + 1,
                       trial.on ? "on" : "off", trial.lamp_frame, result.delay_ms(trial));
    }
    return text;
}

}  // namespace gazeloop::probe
