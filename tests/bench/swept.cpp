#include "tests/bench/swept.h"

#include <fmt/core.h>

#include <algorithm>

#include "runtime/run/program_settings.h"
#include "runtime/trade/measured_sweep.h"
#include "runtime/trade/sweep_report.h"

namespace gazeloop::bench {

trade::SweepQuestion question_of(const display::DisplayProfile& display, vk::Extent2D extent,
                                 const Options& options, std::uint32_t samples) {
    trade::SweepQuestion question{.views = {},
                                  .display = display.name,
                                  .samples = options.samples.value_or(samples),
                                  .reference_samples = 16,
                                  .frame_seconds = 1.0 / display.refresh_hz,
                                  .rounds = options.rounds};
    for (const gaze::Eye eye : gaze::kEyes) {
        question.views[gaze::index(eye)] =
            display::profile_view(display, eye, extent.width, extent.height);
    }
    question.comparison.view = question.views[0];
    question.comparison.metrics = {true, false, false, false};
    return question;
}

trade::SweepPoint published_kfr() {
    return {.method = "kfr", .settings = {{"kfr.sigma", "1.8"}, {"kfr.alpha", "4"}}};
}

trade::SweepPoint interleaved(const char* sigma, const char* every,
                              const std::vector<std::pair<std::string, std::string>>& more) {
    trade::SweepPoint point{.method = kInterleaved,
                            .settings = {{"kfr.sigma", sigma}, {"interleaved.every", every}}};
    point.settings.insert(point.settings.end(), more.begin(), more.end());
    return point;
}

std::vector<trade::SweepPoint> interleaved_points() {
    // A disc of which half is shaded in each frame: as the picture moves, most is lost there.
    const std::vector<std::pair<std::string, std::string>> half{{"interleaved.disc_every", "2"}};
    return {interleaved("1.4", "8", half), interleaved("1.6", "8", half),
            interleaved("1.8", "8", half), interleaved("2", "8", half),
            interleaved("1.8", "8"),       interleaved("2.2", "8")};
}

trade::CaseQuestion still(std::string_view scene, std::size_t frames) {
    return {.scene = std::string(scene),
            .gaze = "0,0",
            .directions = std::vector<gaze::PerEye<glm::dvec3>>(
                frames, {glm::dvec3(0.0, 0.0, -1.0), glm::dvec3(0.0, 0.0, -1.0)})};
}

std::vector<trade::SweepSheet> swept(
    const vulkan::Context& context, const trade::SweepQuestion& question,
    const std::vector<trade::SweepPoint>& points,
    const std::function<void(const trade::ComparedFrame&)>& compared) {
    run::ProgramSettings settings;
    const run::ProgramValues& values = settings.values();
    const auto say = [](const std::string& said) { fmt::print(stderr, "{}\n", said); };
    return trade::sheets_of(value_or_throw(trade::measured_sweep(
        context, question, points,
        {.methods = values.methods, .render = values.render, .light_field = values.light_field},
        settings, {},
        {.progress = say,
         .interrupted = [] { return false; },
         .judged = {},
         .timed = {},
         .compared = compared})));
}

const trade::SweepRow& row_of(const std::vector<trade::SweepRow>& rows,
                              const trade::SweepPoint& point) {
    const auto found = std::ranges::find(rows, point, &trade::SweepRow::point);
    if (found == rows.end() || !found->error.empty()) {
        throw SetupError(ErrorKind::Usage,
                         fmt::format("{}: {}", trade::point_text(point),
                                     found == rows.end() ? "was not swept" : found->error));
    }
    return *found;
}

}  // namespace gazeloop::bench
