#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <span>

#include "runtime/error.h"
#include "runtime/profiles/profiles.h"
#include "runtime/run/program_settings.h"
#include "runtime/scene/scenes.h"
#include "runtime/trade/equal_quality.h"
#include "runtime/trade/measured_sweep.h"
#include "runtime/trade/sweep_report.h"
#include "tests/bench/bench.h"
#include "tests/bench/persons_gaze.h"
#include "tests/bench/swept.h"

namespace gazeloop::bench {
namespace {

struct Size {
    const char* display;
    vk::Extent2D extent;
    bool only_by_name;                      ///< takes long on a software renderer
    std::optional<double> acuity_target{};  ///< of its speed-up on the ray-marched scene
};
const std::array kSizes{Size{"fove0", {1280, 1440}, false, 11.0},
                        Size{"generic_2160", {2160, 2160}, true, 24.0},
                        Size{"varjo_xr4", {3840, 3744}, true}};
/// Instead of them, to see that the bench runs.
const std::array kQuickSizes{Size{"fove0", {160, 180}, false}};

/// The other eye's picture: the smallest that every method takes.
constexpr std::uint32_t kOtherEye_px = 8;
constexpr const char* kEqualQuality = "equal-quality";
/// A history needs frames: so many, where the reference's pictures take less than 2 GiB.
constexpr std::size_t kFrames = 20;
constexpr std::size_t kFewerFrames = 10;

struct Headlined {
    const char* name;
    trade::SweepPoint point;
};
const std::array kHeadlined{
    Headlined{"kfr", published_kfr()},
    Headlined{"kfr-as-printed",
              {.method = "kfr",
               .settings = {{"kfr.kernel", "power-as-printed"},
                            {"kfr.sigma", "1.8"},
                            {"kfr.alpha", "4"}}}},
    Headlined{"acuity", {.method = "acuity", .settings = {{"acuity.mar", "0.022"}}}},
    Headlined{"acuity-0.0275", {.method = "acuity", .settings = {{"acuity.mar", "0.0275"}}}},
    Headlined{"layers", {.method = "layers"}},
    Headlined{"rings", {.method = "rings"}},
    Headlined{"sparse", {.method = "sparse"}},
    Headlined{"fixed", {.method = "fixed"}}};

/// The points by which a taller LP-buffer (about three rows per column) and the acuity map are held
/// to the published point's quality, for pictures of this size.
std::vector<trade::SweepPoint> equal_quality_points(vk::Extent2D extent) {
    constexpr double kAspect = 0.35;
    std::vector<trade::SweepPoint> points;
    for (const double sigma : {1.8, 2.2, 2.6, 3.2}) {
        const double texels = extent.width / sigma * extent.height / sigma;
        const auto side = [](double texels_along) {
            return fmt::format("{}", std::lround(texels_along));
        };
        points.push_back({.method = "kfr",
                          .settings = {{"kfr.alpha", "4"},
                                       {"kfr.lp_width", side(std::sqrt(texels * kAspect))},
                                       {"kfr.lp_height", side(std::sqrt(texels / kAspect))}}});
    }
    for (const char* const slope : {"0.005", "0.0085", "0.012"}) {
        points.push_back({.method = "acuity", .settings = {{"acuity.mar", slope}}});
    }
    return points;
}

/// The rows of what is varied to reach a quality, as points of one method.
std::optional<trade::Saving> saving_of_varied(const std::vector<trade::SweepRow>& rows,
                                              const std::vector<trade::SweepPoint>& varied,
                                              double level) {
    std::vector<trade::SweepRow> ours;
    for (trade::SweepRow row : rows) {
        if (std::ranges::find(varied, row.point) != varied.end()) {
            row.point.method = "ours";
            ours.push_back(std::move(row));
        }
    }
    return trade::saving_at(ours, "ours", level);
}

/// What is asked of one size: the methods, and whether equal quality is, by what keeps no history
/// and by `interleaved`.
struct Asked {
    std::vector<Headlined> methods;
    bool equal_quality = false;
    bool interleaved = false;

    Asked(const Options& options, const std::string& size) {
        for (const Headlined& one : kHeadlined) {
            if (options.wants(fmt::format("{}-{}", one.name, size))) {
                methods.push_back(one);
            }
        }
        equal_quality = options.wants(fmt::format("{}-{}", kEqualQuality, size));
        interleaved = options.wants(fmt::format("{}-{}", kInterleaved, size));
    }
    [[nodiscard]] bool without_history() const { return equal_quality || !methods.empty(); }
    [[nodiscard]] bool anything() const { return interleaved || without_history(); }
};

void add_headlines(const trade::SweepSheet& sheet, const Asked& asked,
                   const std::vector<trade::SweepPoint>& varied, const std::string& size,
                   std::optional<double> acuity_target, std::vector<Figure>& figures) {
    const trade::SweepRow& published = row_of(sheet.rows, published_kfr());
    const std::string scene = std::filesystem::path(sheet.of.scene).stem().string();
    const auto add = [&](const std::string& name, const std::string& metric, double value,
                         const char* unit, const char* better = "higher",
                         std::optional<double> target = {}) {
        figures.push_back({"headline", fmt::format("{}-{}", name, size),
                           fmt::format("{} {}", scene, metric), value, unit, better, std::nullopt,
                           target});
    };
    for (const Headlined& one : asked.methods) {
        const trade::SweepRow& row = row_of(sheet.rows, one.point);
        const bool has_target = scene == "raymarch" && one.name == std::string_view("acuity");
        add(one.name, "speedup", row.speedup, "x", "higher",
            has_target ? acuity_target : std::nullopt);
        add(one.name, "speedup_over_kfr", row.speedup / published.speedup, "x");
        add(one.name, "samples", row.cells, "", "lower");
        add(one.name, "bound_share", 1.0 / row.cells_over_fewest, "", "higher",
            has_target ? std::optional(0.8) : std::nullopt);
        add(one.name, "quality", row.figures.front().mean, "", "lower");
        for (const auto& [pass, ms] : row.pass_ms) {
            add(one.name, "pass " + pass, ms, "ms", "lower");
        }
    }
    if (!asked.equal_quality) {
        return;
    }
    // At the published point's quality, or not at all.
    const double level = published.figures.front().mean;
    if (const auto saving = saving_of_varied(sheet.rows, varied, level)) {
        add(kEqualQuality, "speedup", saving->speedup, "x");
        add(kEqualQuality, "speedup_over_kfr", saving->speedup / published.speedup, "x");
        add(kEqualQuality, "fewer", saving->fewer_cells, "x");
        add(kEqualQuality, "quality", level, "", "lower");
    } else {
        fmt::print(stderr, "{}: no point is as good as the published one\n", scene);
    }
}

/// `interleaved` where it is as good as the published point, along a person's gaze.
void add_interleaved(const trade::SweepSheet& sheet, const std::string& size,
                     std::vector<Figure>& figures) {
    const trade::SweepRow& full = row_of(sheet.rows, {.method = "full"});
    const trade::SweepRow& published = row_of(sheet.rows, published_kfr());
    const std::string scene = std::filesystem::path(sheet.of.scene).stem().string();
    const double level = published.figures.front().mean;
    const auto saving = trade::saving_at(sheet.rows, kInterleaved, level);
    if (!saving) {
        fmt::print(stderr, "{}: no point is as good as the published one\n", scene);
        return;
    }
    const auto add = [&](const char* metric, double value, const char* unit,
                         const char* better = "higher") {
        figures.push_back({"headline", fmt::format("{}-{}", kInterleaved, size),
                           fmt::format("{} {}", scene, metric), value, unit, better});
    };
    add("speedup", saving->speedup, "x");
    add("speedup_over_kfr", saving->speedup / published.speedup, "x");
    add("samples", full.cells / saving->fewer_cells, "", "lower");
    add("bound_share", saving->fewer_cells / full.cells_over_fewest, "");
    add("quality", level, "", "lower");
}

/// A picture of this size, of one eye alone, as the papers measure it; no case yet.
trade::SweepQuestion question_without_cases(const Size& size, const Options& options) {
    const display::DisplayProfile display = value_or_throw(profiles::load_display(size.display));
    trade::SweepQuestion question = question_of(display, size.extent, options, 16);
    question.views[1] =
        display::profile_view(display, gaze::Eye::Right, kOtherEye_px, kOtherEye_px);
    return question;
}

std::vector<std::string> scenes_of(const Options& options) {
    std::vector<std::string> scenes(scene::scene_names().begin(), scene::scene_names().end());
    scenes.insert(scenes.end(), options.scenes.begin(), options.scenes.end());
    return scenes;
}

/// One frame, the gaze ahead.
trade::SweepQuestion headline_question(const Size& size, const Options& options) {
    trade::SweepQuestion question = question_without_cases(size, options);
    for (const std::string& scene : scenes_of(options)) {
        question.cases.push_back(still(scene, 1));
    }
    return question;
}

/// Frames over a saccade of a simulated person.
trade::SweepQuestion person_question(const Size& size, const Options& options) {
    trade::SweepQuestion question = question_without_cases(size, options);
    question.comparison.frame_seconds = question.frame_seconds;
    const std::uint64_t bytes =
        std::uint64_t{size.extent.width} * size.extent.height * sizeof(glm::vec3) * kFrames;
    const std::size_t frames = bytes < std::uint64_t{1} << 31U ? kFrames : kFewerFrames;
    for (const std::string& scene : scenes_of(options)) {
        question.cases.push_back(
            seen_by_person(scene, PersonsGaze::OverASaccade, frames, question.frame_seconds));
    }
    return question;
}

}  // namespace

std::vector<Figure> headline(const Options& options) {
    const vulkan::Context context({}, nullptr);
    std::vector<Figure> figures;
    const auto sizes = options.quick ? std::span<const Size>(kQuickSizes) : kSizes;
    for (const Size& size : sizes) {
        const std::string text = fmt::format("{}x{}", size.extent.width, size.extent.height);
        const Asked asked(options, text);
        if (!asked.anything() || (options.cases.empty() && size.only_by_name)) {
            continue;
        }
        if (asked.interleaved) {
            std::vector<trade::SweepPoint> points = interleaved_points();
            points.insert(points.begin(), published_kfr());
            for (const trade::SweepSheet& sheet :
                 swept(context, person_question(size, options), points)) {
                add_interleaved(sheet, text, figures);
            }
        }
        if (!asked.without_history()) {
            continue;
        }
        const std::vector<trade::SweepPoint> varied = asked.equal_quality
                                                          ? equal_quality_points(size.extent)
                                                          : std::vector<trade::SweepPoint>{};
        std::vector<trade::SweepPoint> points = varied;
        points.push_back(published_kfr());
        for (const Headlined& one : asked.methods) {
            if (one.point != published_kfr()) {
                points.push_back(one.point);
            }
        }
        for (const trade::SweepSheet& sheet :
             swept(context, headline_question(size, options), points)) {
            add_headlines(sheet, asked, varied, text, size.acuity_target, figures);
        }
    }
    return figures;
}

}  // namespace gazeloop::bench
