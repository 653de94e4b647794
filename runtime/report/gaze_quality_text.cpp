#include "runtime/report/gaze_quality_text.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <optional>

#include "runtime/gaze/gaze_quality.h"
#include "runtime/gaze/smoothing.h"
#include "runtime/report/smoothing_text.h"
#include "runtime/report/wrapped_row.h"

namespace gazeloop::report {
namespace {

using Json = nlohmann::ordered_json;

std::string losses_text(const gaze::Losses& losses, double duration_s) {
    if (losses.count == 0) {
        return "none";
    }
    return fmt::format(
        "{}, median {:.0f} ms, longest {:.2f} s, {:.1f} % of the time; {} as long as blinks "
        "({:.1f} a minute)",
        losses.count, losses.median_ms, losses.longest_ms * 1e-3, losses.percent, losses.as_blinks,
        static_cast<double>(losses.as_blinks) * 60.0 / duration_s);
}

std::string noise_text(std::string_view whose, const gaze::EyePrecision& precision) {
    return fmt::format("{} {:.3f} deg from sample to sample (RMS), {:.3f} deg SD, BCEA {:.4f} deg2",
                       whose, precision.sample_to_sample_deg, precision.deviation_deg,
                       precision.bcea_deg2);
}

std::string precision_text(const gaze::PerEye<std::optional<gaze::EyePrecision>>& eyes) {
    const auto& [left, right] = eyes;
    std::string text;
    if (left && right && left->deviation_deg == right->deviation_deg &&
        left->sample_to_sample_deg == right->sample_to_sample_deg) {
        text = noise_text("both eyes", *left);
    } else {
        text = left ? noise_text("left eye", *left) : std::string{};
        text += left && right ? "; " : "";
        text += right ? noise_text("right eye", *right) : std::string{};
    }
    if (text.empty()) {
        return fmt::format("unknown: no {:.0f} ms in which an eye was seen all the time",
                           gaze::kQualityWindow_ms);
    }
    return text + fmt::format(" (the stiller half of {:.0f} ms windows)", gaze::kQualityWindow_ms);
}

std::string_view name_of(gaze::SmoothingVerdict verdict) {
    return gaze::kSmoothingVerdictNames[static_cast<std::size_t>(verdict)];
}

std::string_view answer_of(gaze::SmoothingVerdict verdict) {
    switch (verdict) {
        case gaze::SmoothingVerdict::Smoothed:
            return "yes";
        case gaze::SmoothingVerdict::NotSmoothed:
            return "no";
        default:
            return "unknown";
    }
}

Json precision_json(const std::optional<gaze::EyePrecision>& precision) {
    if (!precision) {
        return nullptr;
    }
    return {{"windows", precision->windows},
            {"sample_to_sample_deg", precision->sample_to_sample_deg},
            {"deviation_deg", precision->deviation_deg},
            {"bcea_deg2", precision->bcea_deg2},
            {"step_per_deviation", precision->step_per_deviation}};
}

}  // namespace

std::string quality_text(const GazeFindings& found) {
    const gaze::GazeQuality& quality = found.quality;
    std::string text;
    if (quality.intervals) {
        text += wrapped_row(
            "interval",
            fmt::format("{:.2f} ms median, {:.2f} to {:.2f} ms (5 to 95 %), {:.1f} % of the "
                        "samples missing",
                        quality.intervals->median_ms, quality.intervals->p05_ms,
                        quality.intervals->p95_ms, quality.intervals->missing_percent));
    }
    if (quality.losses) {
        text += wrapped_row("losses", losses_text(*quality.losses, quality.duration_s));
    }
    text += wrapped_row("noise", precision_text(quality.precision));
    const gaze::SmoothingFinding& smoothing = found.smoothing;
    return text + wrapped_row("smoothed", fmt::format("{}: {}", answer_of(smoothing.verdict),
                                                      smoothing_text(smoothing)));
}

void add_quality(const GazeFindings& found, Json& json) {
    const gaze::GazeQuality& quality = found.quality;
    json["intervals"] = nullptr;
    if (quality.intervals) {
        json["intervals"] = {{"median_ms", quality.intervals->median_ms},
                             {"p05_ms", quality.intervals->p05_ms},
                             {"p95_ms", quality.intervals->p95_ms},
                             {"missing_percent", quality.intervals->missing_percent}};
    }
    json["losses"] = nullptr;
    if (quality.losses) {
        json["losses"] = {{"count", quality.losses->count},
                          {"median_ms", quality.losses->median_ms},
                          {"longest_ms", quality.losses->longest_ms},
                          {"percent", quality.losses->percent},
                          {"as_long_as_blinks", quality.losses->as_blinks}};
    }
    json["precision"] = {{"left", precision_json(quality.precision[0])},
                         {"right", precision_json(quality.precision[1])}};
    const gaze::SmoothingFinding& smoothing = found.smoothing;
    json["smoothing"] = {
        {"verdict", name_of(smoothing.verdict)},
        {"why", smoothing_text(smoothing)},
        {"saccades", smoothing.saccades},
        {"speed", smoothing.speed ? Json(*smoothing.speed) : Json(nullptr)},
        {"time_constant_ms",
         smoothing.time_constant_ms ? Json(*smoothing.time_constant_ms) : Json(nullptr)}};
}

}  // namespace gazeloop::report
