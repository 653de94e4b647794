#include "runtime/quality/comparison.h"

#include <fmt/core.h>

#include <algorithm>

#include "runtime/foveation/picture/gaze_field.h"
#include "runtime/quality/acuity_weights.h"
#include "runtime/quality/compared_pictures.h"
#include "runtime/quality/psnr.h"
#include "runtime/quality/ssim.h"
#include "runtime/settings/nearest_name.h"

namespace gazeloop::quality {

Expected<MetricChoice> metrics_named(const std::vector<std::string>& names) {
    if (names.empty()) {
        return kEveryMetric;
    }
    const std::vector<std::string> known(kMetricNames.begin(), kMetricNames.end());
    MetricChoice choice{};
    for (const std::string& name : names) {
        const auto found = std::ranges::find(known, name);
        if (found == known.end()) {
            return std::unexpected(
                Error{ErrorKind::Usage,
                      fmt::format("--metric: {}", settings::unknown_name("metric", name, known))});
        }
        choice[static_cast<std::size_t>(found - known.begin())] = true;
    }
    return choice;
}

Expected<Comparison> Comparison::create(const ComparisonQuestion& question) {
    if (std::ranges::none_of(question.metrics, [](bool asked) { return asked; })) {
        return std::unexpected(Error{ErrorKind::Usage,
                                     "no metric is asked for: name one or more of contrast, flip, "
                                     "ssim, psnr"});
    }
    if (auto checked = foveation::check_mar_line(question.line); !checked) {
        return std::unexpected(checked.error());
    }
    auto contrast = FoveatedContrast::create(question.view, question.eye, question.contrast);
    if (!contrast) {
        return std::unexpected(contrast.error());
    }
    return Comparison(question, std::move(*contrast));
}

Expected<FrameQuality> Comparison::compare(const render::LinearPicture& reference,
                                           const render::LinearPicture& test,
                                           const glm::dvec3& gaze) {
    if (auto checked = check_pictures(reference, test, question_.view); !checked) {
        return std::unexpected(checked.error());
    }
    const auto field = foveation::GazeField::create(question_.view, gaze);
    if (!field) {
        return std::unexpected(field.error());
    }
    FrameQuality quality;
    if (question_.asks(Metric::Contrast)) {
        auto difference = question_.frame_seconds
                              ? contrast_.next(reference, test, gaze, *question_.frame_seconds,
                                               question_.with_maps)
                              : contrast_.still(reference, test, gaze, question_.with_maps);
        if (!difference) {
            return std::unexpected(difference.error());
        }
        quality.contrast = std::move(*difference);
    }
    if (question_.asks(Metric::Flip)) {
        quality.flip_pixels_per_degree =
            foveation::pixels_per_degree(question_.view, field->frame().nearest_in_view()).mean;
        auto flip = ldr_flip(reference, test, quality.flip_pixels_per_degree, work_);
        if (!flip) {
            return std::unexpected(flip.error());
        }
        quality.flip = std::move(*flip);
    }
    if (!question_.asks(Metric::Ssim) && !question_.asks(Metric::Psnr)) {
        return quality;
    }
    const Plane equal = equal_weights(reference.width, reference.height);
    const Plane weights = acuity_weights(*field, question_.line, work_);
    if (question_.asks(Metric::Ssim)) {
        const auto map = ssim_map(reference, test, work_);
        if (!map) {
            return std::unexpected(map.error());
        }
        quality.ssim = {mean_ssim(*map, equal), mean_ssim(*map, weights)};
    }
    if (question_.asks(Metric::Psnr)) {
        quality.psnr_db = {psnr_db(reference, test, equal, work_),
                           psnr_db(reference, test, weights, work_)};
    }
    return quality;
}

}  // namespace gazeloop::quality
