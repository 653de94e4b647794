#include "runtime/trade/sweep_question.h"

#include <algorithm>
#include <iterator>

#include "runtime/foveation/eye/fewest_samples.h"
#include "runtime/foveation/eye/guenter_acuity.h"
#include "runtime/foveation/picture/gaze_field.h"
#include "runtime/version.h"

namespace gazeloop::trade {
namespace {

/// By the comparison's line, both eyes, mean of the frames.
Expected<double> fewest_cells(const SweepQuestion& question, const CaseQuestion& of_case) {
    const auto model = foveation::GuenterAcuity::create(question.comparison.line);
    if (!model) {
        return std::unexpected(model.error());
    }
    double sum = 0.0;
    double of_frame = 0.0;
    for (std::size_t frame = 0; frame < of_case.directions.size(); ++frame) {
        if (frame > 0 && of_case.directions[frame] == of_case.directions[frame - 1]) {
            sum += of_frame;
            continue;
        }
        of_frame = 0.0;
        for (const gaze::Eye one : gaze::kEyes) {
            const std::size_t e = gaze::index(one);
            const auto field =
                foveation::GazeField::create(question.views[e], of_case.directions[frame][e]);
            if (!field) {
                return std::unexpected(field.error());
            }
            of_frame += foveation::fewest_samples(*field, **model, one);
        }
        sum += of_frame;
    }
    return sum / static_cast<double>(of_case.directions.size());
}

}  // namespace

Expected<SweepRecord> begin_record(const SweepQuestion& question,
                                   const std::vector<SweepPoint>& points,
                                   const settings::Settings& settings, std::string device) {
    const quality::ComparisonQuestion& asked = question.comparison;
    SweepRecord record{.subject = {.program = kVersion,
                                   .device = std::move(device),
                                   .display = question.display,
                                   .eye = std::string(gaze::kEyeNames[gaze::index(asked.eye)]),
                                   .width_px = asked.view.width_px,
                                   .height_px = asked.view.height_px,
                                   .frames = question.cases.front().directions.size(),
                                   .frame_seconds = question.frame_seconds,
                                   .samples = question.samples,
                                   .reference_samples = question.reference_samples,
                                   .rounds = question.rounds,
                                   .peak_cd_m2 = asked.contrast.light.peak_cd_m2,
                                   .black_cd_m2 = asked.contrast.light.black_cd_m2},
                       .cases = {},
                       .points = {{.method = "full"}},
                       .shard = question.shard};
    for (std::size_t metric = 0; metric < quality::kMetrics; ++metric) {
        if (asked.metrics[metric]) {
            record.subject.metrics.emplace_back(quality::kMetricNames[metric]);
        }
    }
    for (const NamedValue& setting : settings.list()) {
        if (!settings.is_built_in(setting.name)) {
            record.subject.settings.emplace_back(setting.name, setting.value);
        }
    }
    for (const CaseQuestion& of_case : question.cases) {
        const auto fewest = fewest_cells(question, of_case);
        if (!fewest) {
            return std::unexpected(fewest.error());
        }
        record.cases.push_back(
            {.scene = of_case.scene, .gaze = of_case.gaze, .fewest_cells = *fewest});
    }
    std::ranges::copy_if(points, std::back_inserter(record.points), [](const SweepPoint& point) {
        return point.method != "full" || !point.settings.empty();
    });
    return record;
}

}  // namespace gazeloop::trade
