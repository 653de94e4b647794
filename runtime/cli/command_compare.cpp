#include <fmt/core.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <glm/gtc/quaternion.hpp>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "runtime/cli/commands.h"
#include "runtime/cli/quality_options.h"
#include "runtime/cli/run_options.h"
#include "runtime/probe/frame_files.h"
#include "runtime/profiles/profiles_in_force.h"
#include "runtime/quality/comparison_report.h"
#include "runtime/quality/heat_map.h"
#include "runtime/recordings/compared_gaze.h"
#include "runtime/render/png_file.h"
#include "runtime/report/output_file.h"
#include "runtime/report/summary_json.h"
#include "runtime/settings/nearest_name.h"

namespace gazeloop::cli {
namespace {

namespace fs = std::filesystem;

struct CompareCommand {
    RunOptions options;
    std::string reference;
    std::string test;
    QualityOptions quality;
    std::vector<std::string> limits;
    std::optional<double> frames_per_second;
    std::string heat_map;
};

/// The pictures of one side: one file, or a folder's numbered frames.
class ComparedFiles {
  public:
    static ComparedFiles find(const fs::path& path) {
        ComparedFiles files;
        files.path_ = path;
        if (fs::is_directory(path)) {
            files.frames_ = value_or_throw(probe::FrameFiles::find(path));
        }
        return files;
    }
    [[nodiscard]] bool folder() const { return frames_.has_value(); }
    [[nodiscard]] std::uint64_t count() const { return frames_ ? frames_->count() : 1; }
    [[nodiscard]] fs::path file(std::uint64_t frame) const {
        return frames_ ? frames_->file(frame) : path_;
    }

  private:
    fs::path path_;
    std::optional<probe::FrameFiles> frames_;
};

/// A figure that must not be worse than this.
struct Limit {
    std::string key;
    double value;
};

Limit parse_limit(const std::string& text) {
    const std::size_t equals = text.find('=');
    Limit limit{.key = text.substr(0, equals), .value = 0.0};
    const char* const end = text.data() + text.size();
    const char* const begin = equals == std::string::npos ? end : text.data() + equals + 1;
    const auto [stopped, error] = std::from_chars(begin, end, limit.value);
    if (error != std::errc{} || stopped != end || !std::isfinite(limit.value)) {
        throw SetupError(
            ErrorKind::Usage,
            fmt::format("--limit: '{}' must be FIGURE=NUMBER, e.g. contrast=0.5", text));
    }
    return limit;
}

/// Whether all limits are kept; says which are not.
bool within(const std::vector<Limit>& limits, const std::vector<quality::QualityFigure>& figures) {
    bool kept = true;
    for (const Limit& limit : limits) {
        const auto found = std::ranges::find(figures, limit.key, &quality::QualityFigure::key);
        const bool worse =
            found->lower_is_better ? found->mean > limit.value : found->mean < limit.value;
        if (worse) {
            spdlog::error("{} is {:.4f}, worse than the limit of {:g}", limit.key, found->mean,
                          limit.value);
            kept = false;
        }
    }
    return kept;
}

/// Refuses limits of figures that this comparison will not have.
void check_limits(const std::vector<Limit>& limits, const quality::MetricChoice& metrics) {
    quality::QualityTotals all;
    quality::FrameQuality any;
    const auto asked = [&](quality::Metric metric) {
        return metrics[static_cast<std::size_t>(metric)];
    };
    if (asked(quality::Metric::Contrast)) {
        any.contrast.emplace();
    }
    if (asked(quality::Metric::Flip)) {
        any.flip.emplace();
    }
    if (asked(quality::Metric::Ssim)) {
        any.ssim.emplace();
    }
    if (asked(quality::Metric::Psnr)) {
        any.psnr_db.emplace();
    }
    std::vector<std::string> keys;
    for (const auto& [key, value] : quality::figures_of(any)) {
        keys.push_back(key);
    }
    for (const Limit& limit : limits) {
        if (std::ranges::find(keys, limit.key) == keys.end()) {
            throw SetupError(
                ErrorKind::Usage,
                fmt::format("--limit: {}", settings::unknown_name("figure", limit.key, keys)));
        }
    }
}

void write_heat_map(const quality::FrameQuality& quality, const fs::path& file) {
    const render::Picture picture =
        quality.contrast ? quality::heat_map(quality.contrast->map, quality::kContrastMapMost)
                         : quality::heat_map(quality.flip->map, 1.0);
    value_or_throw(render::write_png(picture, file));
}

/// One file, or a folder for a sequence's.
void prepare_heat_maps(const CompareCommand& command, const quality::MetricChoice& metrics,
                       bool sequence) {
    if (!metrics[static_cast<std::size_t>(quality::Metric::Contrast)] &&
        !metrics[static_cast<std::size_t>(quality::Metric::Flip)]) {
        throw SetupError(ErrorKind::Usage,
                         "--heat-map: only contrast and flip have one: ask for one of them");
    }
    if (!sequence) {
        value_or_throw(report::check_output(command.heat_map));
        return;
    }
    std::error_code failure;
    fs::create_directories(command.heat_map, failure);
    if (failure) {
        throw SetupError(ErrorKind::BadInput,
                         fmt::format("--heat-map {}: the folder cannot be made ({})",
                                     command.heat_map, failure.message()));
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

ExitCode compare(const CompareCommand& command) {
    run::ProgramSettings settings;
    value_or_throw(command.options.apply_to(settings, true));
    if (command.options.print_config) {
        fmt::print("{}", settings.describe());
        return ExitCode::Ok;
    }
    value_or_throw(settings.check());
    const std::string& json_file = command.options.json;
    if (!json_file.empty()) {
        value_or_throw(report::check_output(json_file));
    }
    const std::array<report::NamedFile, 2> outputs{
        {{"--heat-map", command.heat_map}, {"--json", json_file}}};
    const std::array<report::NamedFile, 2> inputs{
        {{"the reference", command.reference}, {"the test", command.test}}};
    value_or_throw(report::check_apart(outputs, inputs));
    const display::DisplayProfile display =
        value_or_throw(profiles::display_in_force(settings.values().profile, settings));
    const quality::MetricChoice metrics = command.quality.metric_choice();
    std::vector<Limit> limits;
    for (const std::string& text : command.limits) {
        limits.push_back(parse_limit(text));
    }
    check_limits(limits, metrics);

    const ComparedFiles reference = ComparedFiles::find(command.reference);
    const ComparedFiles test = ComparedFiles::find(command.test);
    if (reference.folder() != test.folder()) {
        throw SetupError(ErrorKind::Usage,
                         "compare: one is a folder and the other is not: give two "
                         "pictures, or two folders of frames");
    }
    if (reference.count() != test.count()) {
        throw SetupError(
            ErrorKind::BadInput,
            fmt::format("{} has {} frames and {} has {}: compare frames of one run",
                        command.reference, reference.count(), command.test, test.count()));
    }
    const bool sequence = reference.folder();
    if (!sequence && command.frames_per_second) {
        throw SetupError(ErrorKind::Usage, "--fps: only folders of frames have a rate");
    }
    if (!command.heat_map.empty()) {
        prepare_heat_maps(command, metrics, sequence);
    }

    const gaze::Eye eye = command.quality.which_eye();
    const recordings::ComparedGaze gaze =
        value_or_throw(recordings::ComparedGaze::parse(command.quality.gaze, eye));
    const double frame_seconds = 1.0 / command.frames_per_second.value_or(display.refresh_hz);

    quality::ComparedThings things{.reference = command.reference,
                                   .test = command.test,
                                   .display = display.name,
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
            warn_of_shape(of_reference, display);
            things.question = {
                .view =
                    display::profile_view(display, eye, of_reference.width, of_reference.height),
                .eye = eye,
                .metrics = metrics,
                .contrast = command.quality.contrast(),
                .line = {.slope = settings.values().methods.acuity.mar},
                .frame_seconds = sequence ? std::optional(frame_seconds) : std::nullopt,
                .with_maps = !command.heat_map.empty()};
            comparison = value_or_throw(quality::Comparison::create(things.question));
        }
        const auto time_ns = std::llround(static_cast<double>(frame) * frame_seconds * 1e9);
        things.held_frames += gaze.end_ns() && time_ns > *gaze.end_ns() ? 1 : 0;
        const glm::dvec3 direction =
            glm::conjugate(things.question.view.pose.orientation) * gaze.direction_at(time_ns);
        const auto quality = comparison->compare(of_reference, of_test, direction);
        if (!quality) {
            throw SetupError(quality.error().kind,
                             fmt::format("{} and {}: {}", reference.file(frame).string(),
                                         test.file(frame).string(), quality.error().message));
        }
        totals.add(*quality);
        if (!json_file.empty()) {
            frames.push_back(quality::frame_json(frame, *quality));
        }
        if (!command.heat_map.empty()) {
            write_heat_map(*quality,
                           sequence ? fs::path(command.heat_map) / reference.file(frame).filename()
                                    : fs::path(command.heat_map));
        }
        constexpr std::uint64_t kEvery = 100;
        if ((frame + 1) % kEvery == 0) {
            spdlog::info("{} of {} frames compared", frame + 1, reference.count());
        }
    }
    if (json_file != "-" && !command.options.log.quiet) {
        fmt::print("{}", quality::comparison_text(things, totals));
    }
    if (!json_file.empty()) {
        nlohmann::ordered_json json = quality::comparison_json(things, totals);
        json["frames"] = std::move(frames);
        value_or_throw(report::write_text(json_file, report::json_text(json)));
    }
    return within(limits, totals.figures()) ? ExitCode::Ok : ExitCode::GateFailed;
}

}  // namespace

void add_compare_command(Command program) {
    Command app = program.command(
        "compare", "what a picture, or a sequence of them, lost against a reference, at its gaze");
    const auto command = std::make_shared<CompareCommand>();
    RunOptions& options = command->options;
    options.aliases = {
        {"--display", "profile.display", "display profile, by name or .toml file", ""},
        {"--mar", "acuity.mar", "slope of the acuity line that weighs PSNR and SSIM", ""},
    };
    options.switches.clear();
    options.log.add_to(app);
    options.add_settings_to(app);
    app.option("reference", command->reference, "a PNG, or a folder of numbered PNG frames")
        .required()
        .type("REFERENCE");
    app.option("test", command->test, "the same of what is to be judged").required().type("TEST");
    command->quality.add_to(app);
    app.option("--fps", command->frames_per_second,
               "frames per second of a sequence; the display's refresh rate without it")
        .number_between(0.1, 1e4);
    app.option("--limit", command->limits,
               "exit code 1 if this figure's mean is worse; may be repeated")
        .type("FIGURE=NUMBER");
    app.option("--heat-map", command->heat_map,
               "where the pictures differ, as PNG: contrast in thresholds, else FLIP; a folder for "
               "a sequence")
        .type("FILE|DIR");
    app.option("--json", options.json, "write the result as JSON; without a file, to stdout")
        .value_optional("-")
        .type("[FILE]");
    app.does([=] {
        command->options.log.apply();
        return compare(*command);
    });
}

}  // namespace gazeloop::cli
