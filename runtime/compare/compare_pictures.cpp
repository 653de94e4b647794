#include "runtime/compare/compare_pictures.h"

#include <fmt/core.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <glm/gtc/quaternion.hpp>
#include <nlohmann/json.hpp>
#include <utility>

#include "runtime/compare/compared_files.h"
#include "runtime/compare/limits.h"
#include "runtime/quality/comparison_report.h"
#include "runtime/quality/heat_map.h"
#include "runtime/quality/ssim.h"
#include "runtime/recordings/compared_gaze.h"
#include "runtime/render/png_file.h"
#include "runtime/report/output_file.h"
#include "runtime/report/summary_json.h"

namespace gazeloop::compare {
namespace {

namespace fs = std::filesystem;

void write_heat_map(const quality::FrameQuality& quality, const fs::path& file) {
    const render::Picture picture =
        quality.contrast ? quality::heat_map(quality.contrast->map, quality::kContrastMapMost)
                         : quality::heat_map(quality.flip->map, 1.0);
    value_or_throw(render::write_png(picture, file));
}

/// One file, or a folder for a sequence's.
void prepare_heat_maps(const CompareQuestion& question, bool sequence) {
    if (!question.metrics[static_cast<std::size_t>(quality::Metric::Contrast)] &&
        !question.metrics[static_cast<std::size_t>(quality::Metric::Flip)]) {
        throw SetupError(ErrorKind::Usage,
                         "--heat-map: only contrast and flip have one: ask for one of them");
    }
    if (!sequence) {
        value_or_throw(report::check_output(question.heat_map));
        return;
    }
    std::error_code failure;
    fs::create_directories(question.heat_map, failure);
    if (failure) {
        throw SetupError(ErrorKind::BadInput,
                         fmt::format("--heat-map {}: the folder cannot be made ({})",
                                     question.heat_map, failure.message()));
    }
}

/// A picture of another shape than the display's fills it all the same, with pixels that are not
/// square there.
void warn_of_shape(const render::LinearPicture& picture, const display::DisplayProfile& display) {
    const double shape = static_cast<double>(picture.width) / picture.height;
    const double of_display = static_cast<double>(display.width_px) / display.height_px;
    constexpr double kNear = 0.02;  // pictures are scaled to whole pixels
    if (std::abs(shape / of_display - 1.0) > kNear) {
        spdlog::warn(
            "the pictures have {}x{} pixels, the display {} {}x{}: taken as filling its "
            "field of view, with pixels that are not square; --display names another",
            picture.width, picture.height, display.name, display.width_px, display.height_px);
    }
}

}  // namespace

bool compare_pictures(const CompareQuestion& question) {
    const std::string& json_file = question.json;
    const std::array<report::NamedFile, 2> outputs{
        {{"--json", json_file}, {"--heat-map", question.heat_map}}};
    std::vector<report::NamedFile> inputs = question.reads;
    inputs.push_back({"the reference", question.reference});
    inputs.push_back({"the test", question.test});
    value_or_throw(report::check_apart(outputs, inputs));
    // Heat maps may be a folder.
    value_or_throw(report::check_outputs(std::span{outputs}.first(1), inputs));
    const std::vector<Limit> limits = parse_limits(question.limits, question.metrics);

    const ComparedFiles reference = ComparedFiles::find(question.reference);
    const ComparedFiles test = ComparedFiles::find(question.test);
    if (reference.folder() != test.folder()) {
        throw SetupError(ErrorKind::Usage,
                         "compare: one is a folder and the other is not: give two "
                         "pictures, or two folders of frames");
    }
    if (reference.count() != test.count()) {
        throw SetupError(
            ErrorKind::BadInput,
            fmt::format("{} has {} frames and {} has {}: compare frames of one run",
                        question.reference, reference.count(), question.test, test.count()));
    }
    const bool sequence = reference.folder();
    if (!sequence && question.frames_per_second) {
        throw SetupError(ErrorKind::Usage, "--fps: only folders of frames have a rate");
    }
    if (!question.heat_map.empty()) {
        prepare_heat_maps(question, sequence);
    }

    const recordings::ComparedGaze gaze =
        value_or_throw(recordings::ComparedGaze::parse(question.gaze, question.eye));
    const double frame_seconds =
        1.0 / question.frames_per_second.value_or(question.display.refresh_hz);

    quality::ComparedThings things{.reference = question.reference,
                                   .test = question.test,
                                   .display = question.display.name,
                                   .gaze = gaze.text(),
                                   .question = {},
                                   .held_frames = 0};
    std::optional<quality::Comparison> comparison;
    quality::QualityTotals totals;
    auto frames = nlohmann::ordered_json::array();
    for (std::uint64_t frame = 0; frame < reference.count(); ++frame) {
        const render::LinearPicture of_reference =
            value_or_throw(render::read_png(reference.file(frame)));
        const render::LinearPicture of_test = value_or_throw(render::read_png(test.file(frame)));
        if (!comparison) {
            // The first picture's size is that of all.
            warn_of_shape(of_reference, question.display);
            things.question = {
                .view = display::profile_view(question.display, question.eye, of_reference.width,
                                              of_reference.height),
                .eye = question.eye,
                .metrics = question.metrics,
                .contrast = question.contrast,
                .line = question.line,
                .frame_seconds = sequence ? std::optional(frame_seconds) : std::nullopt,
                .with_maps = !question.heat_map.empty()};
            comparison = value_or_throw(quality::Comparison::create(things.question));
        }
        const auto time_ns = std::llround(static_cast<double>(frame) * frame_seconds * 1e9);
        things.held_frames += gaze.end_ns() && time_ns > *gaze.end_ns() ? 1 : 0;
        const glm::dvec3 direction =
            glm::conjugate(things.question.view.pose.orientation) * gaze.direction_at(time_ns);
        const auto quality = comparison->compare(of_reference, of_test, direction);
        if (!quality) {
            const bool small =
                std::min(of_reference.width, of_reference.height) < quality::kSsimWindow_px;
            throw SetupError(quality.error().kind,
                             fmt::format("{} and {}: {}{}", reference.file(frame).string(),
                                         test.file(frame).string(), quality.error().message,
                                         small ? " (--metric contrast and --metric psnr judge "
                                                 "pictures of any size)"
                                               : ""));
        }
        totals.add(*quality);
        if (!json_file.empty()) {
            frames.push_back(quality::frame_json(frame, *quality));
        }
        if (!question.heat_map.empty()) {
            write_heat_map(*quality,
                           sequence ? fs::path(question.heat_map) / reference.file(frame).filename()
                                    : fs::path(question.heat_map));
        }
        constexpr std::uint64_t kEvery = 100;
        if ((frame + 1) % kEvery == 0) {
            spdlog::info("{} of {} frames compared", frame + 1, reference.count());
        }
    }
    if (json_file != "-" && !question.quiet) {
        value_or_throw(report::write_text("-", quality::comparison_text(things, totals)));
    }
    if (!json_file.empty()) {
        nlohmann::ordered_json json = quality::comparison_json(things, totals);
        json["frames"] = std::move(frames);
        value_or_throw(report::write_text(json_file, report::json_text(json)));
    }
    return within(limits, totals.figures());
}

}  // namespace gazeloop::compare
