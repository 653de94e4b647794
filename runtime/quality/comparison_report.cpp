#include "runtime/quality/comparison_report.h"

#include <fmt/core.h>

#include <cmath>
#include <nlohmann/json.hpp>

namespace gazeloop::quality {
namespace {

using nlohmann::ordered_json;

std::string figure_text(double value) {
    return std::isfinite(value) ? fmt::format("{:.4f}", value) : std::string("identical");
}

ordered_json figure_json(double value) {
    return std::isfinite(value) ? ordered_json(value) : ordered_json();
}

}  // namespace

std::string comparison_text(const ComparedThings& things, const QualityTotals& totals) {
    const ComparisonQuestion& question = things.question;
    const DisplayLight& light = question.contrast.light;
    std::string text = fmt::format(
        "reference {}\ntest      {}\n{}, {} eye, {}x{} px, white {:g} cd/m2, black {:g}, gaze {}\n",
        things.reference, things.test, things.display, gaze::kEyeNames[gaze::index(question.eye)],
        question.view.width_px, question.view.height_px, light.peak_cd_m2 + light.black_cd_m2,
        light.black_cd_m2, things.gaze);
    const bool sequence = question.frame_seconds.has_value();
    if (sequence) {
        text += fmt::format("{} frames, {:g} ms each\n", totals.frames(),
                            1e3 * *question.frame_seconds);
    }
    if (things.held_frames > 0) {
        text += fmt::format("the gaze's trace ended before the last {} frames: held\n",
                            things.held_frames);
    }
    text += fmt::format("\n{:24} {:>11} {}{:6}  {}\n", "", sequence ? "mean" : "value",
                        sequence ? fmt::format("{:>11} {:>7}  ", "worst", "frame") : "", "better",
                        "what it is");
    for (const QualityFigure& figure : totals.figures()) {
        text += fmt::format("{:24} {:>11} {}{:6}  {}\n", figure.key, figure_text(figure.mean),
                            sequence ? fmt::format("{:>11} {:>7}  ", figure_text(figure.worst),
                                                   figure.worst_frame + 1)
                                     : "",
                            figure.lower_is_better ? "lower" : "higher", figure.meaning);
    }
    return text;
}

ordered_json comparison_json(const ComparedThings& things, const QualityTotals& totals) {
    const ComparisonQuestion& question = things.question;
    const DisplayLight& light = question.contrast.light;
    ordered_json json{
        {"reference", things.reference},
        {"test", things.test},
        {"display", things.display},
        {"eye", gaze::kEyeNames[gaze::index(question.eye)]},
        {"width_px", question.view.width_px},
        {"height_px", question.view.height_px},
        {"peak_cd_m2", light.peak_cd_m2},
        {"black_cd_m2", light.black_cd_m2},
        {"gaze", things.gaze},
        {"gaze_held_frames", things.held_frames},
        {"frame_count", totals.frames()},
        {"frame_seconds",
         question.frame_seconds ? ordered_json(*question.frame_seconds) : ordered_json()}};
    auto figures = ordered_json::object();
    for (const QualityFigure& figure : totals.figures()) {
        figures[figure.key] = {{"mean", figure_json(figure.mean)},
                               {"worst", figure_json(figure.worst)},
                               {"worst_frame", figure.worst_frame + 1},
                               {"better", figure.lower_is_better ? "lower" : "higher"}};
    }
    json["figures"] = std::move(figures);
    return json;
}

ordered_json frame_json(std::uint64_t frame, const FrameQuality& quality) {
    ordered_json json{{"frame", frame + 1}};
    for (const auto& [key, value] : figures_of(quality)) {
        json[key] = figure_json(value);
    }
    return json;
}

}  // namespace gazeloop::quality
