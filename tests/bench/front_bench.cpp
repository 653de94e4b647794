#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "runtime/methods/registry.h"
#include "runtime/profiles/profiles.h"
#include "runtime/render/off_screen.h"
#include "runtime/run/program_settings.h"
#include "runtime/scene/scenes.h"
#include "runtime/trade/equal_quality.h"
#include "runtime/trade/sweep_report.h"
#include "tests/bench/bench.h"
#include "tests/bench/persons_gaze.h"
#include "tests/bench/swept.h"

namespace gazeloop::bench {
namespace {

constexpr std::size_t kFrames = 20;
constexpr std::size_t kFirstInFixation = 8;

/// What each setting is worth: the same point with one of them as it is without the method.
struct Ingredient {
    const char* name;
    trade::SweepPoint without;
};
std::vector<Ingredient> ingredients() {
    return {{"all", interleaved("1.8", "4")},
            {"tall", interleaved("1.8", "4", {{"kfr.aspect", "0.9"}})},
            {"turns", interleaved("1.8", "1")},
            {"turns_of_the_disc", interleaved("1.8", "4", {{"interleaved.disc_every", "1"}})},
            {"mean", interleaved("1.8", "4", {{"interleaved.visits", "1"}})},
            {"jitter", interleaved("1.8", "4", {{"interleaved.jitter", "false"}})},
            {"follow", interleaved("1.8", "4", {{"interleaved.follow", "false"}})},
            {"hold", interleaved("1.8", "4", {{"interleaved.hold", "false"}})},
            {"refill", interleaved("1.8", "4", {{"interleaved.refill", "false"}})},
            {"spline", interleaved("1.8", "4", {{"interleaved.sharp", "nothing"}})}};
}

trade::SweepQuestion question(const display::DisplayProfile& display, const Options& options,
                              PersonsGaze gaze) {
    constexpr std::uint32_t kScale = 2;  // of the display's sides
    constexpr std::uint32_t kOther = 32;
    trade::SweepQuestion asked =
        question_of(display, {display.width_px / kScale, display.height_px / kScale}, options, 4);
    // One eye is judged: the other one's pictures are as small as can be.
    asked.views[1].width_px = kOther;
    asked.views[1].height_px = kOther;
    asked.comparison.frame_seconds = asked.frame_seconds;
    asked.first_judged = gaze == PersonsGaze::InFixation ? kFirstInFixation : 0;
    for (const char* const scene : {"raymarch", "gallery"}) {
        asked.cases.push_back(seen_by_person(scene, gaze, kFrames, asked.frame_seconds));
    }
    return asked;
}

/// How much longer full resolution takes with the reference's samples than with the points': the
/// median of frames in turns, mean over the scenes.
double reference_over_full(const vulkan::Context& context, const trade::SweepQuestion& asked) {
    constexpr std::size_t kTimed = 5;
    run::ProgramSettings settings;
    const auto passes =
        value_or_throw(methods::find_method("full")->passes(settings.values().methods, settings));
    double mean = 0.0;
    for (const trade::CaseQuestion& of_case : asked.cases) {
        const auto scene = scene::make_scene(context, of_case.scene);
        const auto made = [&](std::uint32_t samples) {
            render::RendererConfig config;
            config.samples = samples;
            for (std::size_t e = 0; e < gaze::kEyeCount; ++e) {
                config.extents[e] = vk::Extent2D(asked.views[e].width_px, asked.views[e].height_px);
            }
            return std::make_unique<render::OffScreen>(context, *scene, passes, config);
        };
        const auto few = made(asked.samples);
        const auto many = made(asked.reference_samples);
        const auto ms = [&](render::OffScreen& renderer, std::size_t frame) {
            const render::FrameView view{
                .index = frame,
                .scene_time_s = static_cast<double>(frame) * asked.frame_seconds,
                .views = asked.views,
                .targets = {}};
            const auto gpu = renderer.render(view, render::fovea_ahead(asked.views)).gpu;
            double sum = 0.0;
            for (std::size_t pass = 0; pass < renderer.renderer().passes().size(); ++pass) {
                sum += static_cast<double>(gpu.passes[pass].value_or(0));
            }
            return sum;
        };
        std::vector<double> ratios;
        for (std::size_t frame = 0; frame <= kTimed; ++frame) {
            const double of_few = ms(*few, frame);
            const double ratio = ms(*many, frame) / of_few;
            if (frame > 0) {  // by then shaders are compiled
                ratios.push_back(ratio);
            }
        }
        mean += median(ratios) / static_cast<double>(asked.cases.size());
    }
    return mean;
}

/// `reference_ratio`: reference_over_full().
void add_savings(const std::vector<trade::SweepRow>& rows, const char* name, PersonsGaze gaze,
                 double reference_ratio, std::vector<Figure>& figures) {
    const trade::SweepRow& published = row_of(rows, published_kfr());
    const double level = published.figures.front().mean;
    const auto add = [&](const char* metric, double value, const char* unit,
                         std::optional<double> target = {}, const char* better = "higher") {
        figures.push_back({"front", name, metric, value, unit, better, std::nullopt, target});
    };
    add("quality_of_kfr", level, "", std::nullopt, "lower");
    add("kfr_samples_ratio", published.fewer_cells, "x");
    const auto saving = trade::saving_at(rows, kInterleaved, level);
    if (!saving) {
        fmt::print(stderr, "{}: no point is as good as the published one\n", name);
        return;
    }
    constexpr double kAverageTarget = 12.0;
    constexpr double kFixationTarget = 18.0;
    add("samples_ratio", saving->fewer_cells, "x",
        gaze == PersonsGaze::InFixation ? kFixationTarget : kAverageTarget);
    add("rays_ratio", saving->fewer_cells, "x", 20.0);
    add("time_ratio", saving->speedup, "x", 8.0);
    add("time_ratio_over_16_rays", saving->speedup * reference_ratio, "x");
    add("time_ratio_over_kfr", saving->speedup / published.speedup, "x", 3.0);
    add("quality", level, "", std::nullopt, "lower");
}

void tell(const std::vector<trade::SweepRow>& rows) {
    for (const trade::SweepRow& row : rows) {
        if (!row.error.empty()) {
            fmt::print(stderr, "  {}: {}\n", trade::point_text(row.point), row.error);
            continue;
        }
        fmt::print(stderr, "  {}: quality {:.4f}, {:.2f}x fewer, {:.2f}x faster\n",
                   trade::point_text(row.point), row.figures.front().mean, row.fewer_cells,
                   row.speedup);
        for (const auto& [pass, ms] : row.pass_ms) {
            fmt::print(stderr, "    {} {:.2f} ms\n", pass, ms);
        }
    }
}

/// How far each point is from the reference, frame by frame: which frames of a case cost it.
class LossByFrame {
  public:
    void add(const trade::ComparedFrame& frame) {
        lines_[{frame.of_case, frame.point}] +=
            fmt::format(" {:.3f}", frame.quality.contrast->value);
    }
    void tell(const std::vector<trade::SweepSheet>& sheets) const {
        for (const auto& [at, line] : lines_) {
            const auto& [of_case, point] = at;
            const trade::SweepSheet& sheet = sheets[of_case];
            fmt::print(stderr, "{}, {}, by frame:{}\n", sheet.of.scene,
                       trade::point_text(sheet.rows[point].point), line);
        }
    }

  private:
    std::map<std::pair<std::size_t, std::size_t>, std::string> lines_;  ///< by case and point
};

}  // namespace

std::vector<Figure> front(const Options& options) {
    const vulkan::Context context({}, nullptr);
    const display::DisplayProfile display = value_or_throw(profiles::load_display("vive_pro_eye"));
    std::vector<Figure> figures;
    for (const auto& [name, gaze] : {std::pair{"average", PersonsGaze::OverASaccade},
                                     std::pair{"fixation", PersonsGaze::InFixation}}) {
        if (!options.wants(name)) {
            continue;
        }
        std::vector<trade::SweepPoint> points = interleaved_points();
        points.insert(points.begin(), published_kfr());
        LossByFrame by_frame;
        const trade::SweepQuestion asked = question(display, options, gaze);
        const auto sheets = swept(context, asked, points,
                                  [&](const trade::ComparedFrame& frame) { by_frame.add(frame); });
        by_frame.tell(sheets);
        for (const trade::SweepSheet& sheet : sheets) {
            fmt::print(stderr, "{}:\n", sheet.of.scene);
            tell(sheet.rows);
        }
        add_savings(trade::mean_sheet(sheets).rows, name, gaze, reference_over_full(context, asked),
                    figures);
    }
    if (std::ranges::find(options.cases, "ingredients") != options.cases.end()) {
        std::vector<trade::SweepPoint> points{published_kfr()};
        for (const Ingredient& one : ingredients()) {
            points.push_back(one.without);
        }
        const auto sheets =
            swept(context, question(display, options, PersonsGaze::OverASaccade), points);
        const trade::SweepSheet mean = trade::mean_sheet(sheets);
        for (const Ingredient& one : ingredients()) {
            const trade::SweepRow& row = row_of(mean.rows, one.without);
            const auto add = [&](const char* metric, double value, const char* unit,
                                 const char* better) {
                figures.push_back(
                    {"front", "ingredients",
                     fmt::format("{}{} {}", one.name == std::string_view("all") ? "" : "without ",
                                 one.name, metric),
                     value, unit, better});
            };
            add("quality", row.figures.front().mean, "", "lower");
            add("samples_ratio", row.fewer_cells, "x", "higher");
            add("time_ratio", row.speedup, "x", "higher");
        }
    }
    return figures;
}

}  // namespace gazeloop::bench
