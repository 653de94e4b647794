#include <fmt/core.h>

#include <array>
#include <string>
#include <vector>

#include "runtime/error.h"
#include "runtime/profiles/profiles.h"
#include "tests/bench/bench.h"
#include "tests/bench/swept.h"

namespace gazeloop::bench {
namespace {

constexpr const char* kDisplay = "fove0";
/// What is rendered: pictures, as a share of the display's sides, and frames.
struct Amount {
    double scale;
    std::size_t frames;
};
constexpr Amount kWholeAmount{0.25, 8};
constexpr Amount kQuickAmount{0.1, 3};

using Settings = std::vector<NamedValue>;

/// What the article leaves open, each against the same pattern of as many samples: blue noise, the
/// number of neighbours, depth, and patterns that turn.
struct Choice {
    const char* name;
    Settings set;
};
const std::array kChoices{
    Choice{"gaussian k=4", {}},
    Choice{"gaussian k=1", {{"sparse.k", "1"}}},
    Choice{"gaussian k=8", {{"sparse.k", "8"}}},
    Choice{"gaussian k=4 depth", {{"sparse.depth_guided", "true"}}},
    Choice{"blue k=1", {{"sparse.placement", "blue_noise"}, {"sparse.k", "1"}}},
    Choice{"blue k=4", {{"sparse.placement", "blue_noise"}}},
    Choice{"blue k=4 depth", {{"sparse.placement", "blue_noise"}, {"sparse.depth_guided", "true"}}},
    Choice{"blue k=4 turn", {{"sparse.placement", "blue_noise"}, {"sparse.turn", "true"}}},
    Choice{"blue k=4 turn mixed",
           {{"sparse.placement", "blue_noise"},
            {"sparse.turn", "true"},
            {"sparse.accumulate", "true"}}}};
constexpr std::array kShares{"0.1", "0.2"};  // those of the article

Settings with_share(Settings set, const char* share) {
    set.emplace_back("sparse.share", share);
    return set;
}

/// A still gaze at a still scene: then a frame that differs from the one before flickers.
void measure(const vulkan::Context& context, const char* scene_name, const Options& options,
             std::vector<Figure>& figures) {
    const Amount& amount = options.quick ? kQuickAmount : kWholeAmount;
    const display::DisplayProfile display = value_or_throw(profiles::load_display(kDisplay));
    trade::SweepQuestion question =
        question_of(display,
                    {static_cast<std::uint32_t>(display.width_px * amount.scale),
                     static_cast<std::uint32_t>(display.height_px * amount.scale)},
                    options, 1);
    question.cases = {still(scene_name, amount.frames)};
    question.comparison.metrics = {true, true, false, false};  // contrast and FLIP
    question.comparison.frame_seconds = question.frame_seconds;
    question.frame_seconds = 0.0;  // of the scene, which stands still
    question.comparison.contrast.threads = 2;
    std::vector<trade::SweepPoint> points;
    std::vector<std::string> names;
    for (const char* const share : kShares) {
        for (const Choice& choice : kChoices) {
            trade::SweepPoint& point =
                points.emplace_back(trade::SweepPoint{.method = "sparse", .settings = {}});
            for (const auto& [key, value] : with_share(choice.set, share)) {
                point.settings.emplace_back(key, value);
            }
            names.push_back(fmt::format("{} {}", share, choice.name));
        }
    }
    const std::vector<trade::SweepSheet> sheets = swept(context, question, points);
    for (std::size_t i = 0; i < points.size(); ++i) {
        const trade::SweepRow& row = row_of(sheets.front().rows, points[i]);
        const auto put = [&](const std::string& metric, double value, const char* unit,
                             const char* better) {
            figures.push_back({"sparse", scene_name, names[i] + " " + metric, value, unit, better});
        };
        put("fewer samples", row.fewer_cells, "x", "higher");
        put("speedup", row.speedup, "x", "higher");
        for (const quality::QualityFigure& figure : row.figures) {
            if (figure.key == "contrast" || figure.key == "contrast_flicker" ||
                figure.key == "flip") {
                put(figure.key, figure.mean, "", figure.lower_is_better ? "lower" : "higher");
            }
        }
    }
}

}  // namespace

std::vector<Figure> sparse(const Options& options) {
    const vulkan::Context context({}, nullptr);
    std::vector<Figure> figures;
    for (const char* const scene : {"raymarch", "gallery"}) {
        if (options.wants(scene)) {
            measure(context, scene, options, figures);
        }
    }
    return figures;
}

}  // namespace gazeloop::bench
