#include "runtime/trade/fitted_shape.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <optional>

#include "runtime/foveation/picture/gaze_field.h"
#include "runtime/methods/registry.h"
#include "runtime/trade/lp_shape.h"
#include "runtime/trade/pattern_search.h"
#include "runtime/trade/settings_of_point.h"

namespace gazeloop::trade {
namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();
using SettingTexts = std::vector<std::pair<std::string, std::string>>;

/// By which a buffer whose texels take turns has little left of how it began.
constexpr std::size_t kFewestFrames = 4;

std::unexpected<Error> refuse(std::string text) {
    return std::unexpected(Error{ErrorKind::Usage, "--fitted: " + std::move(text)});
}

class Fit {
  public:
    Fit(const vulkan::Context& context, const SweepQuestion& question, const SweptValues& values,
        settings::Settings& settings, const SweepHooks& hooks, const FitQuestion& fit)
        : context_(context),
          question_(question),
          values_(values),
          settings_(settings),
          hooks_{.progress = [](const std::string&) {},
                 .interrupted = hooks.interrupted,
                 .judged = [](const JudgedPoint&) { return Expected<void>{}; },
                 .timed = [](const TimedTurn&) { return Expected<void>{}; }},
          say_(hooks.progress),
          fit_(fit) {
        question_.rounds = 0;  // times decide nothing
        question_.shard = {};
        question_.with_pictures = false;
    }

    Expected<FittedShape> run() {
        if (auto turns = choose_turns(); !turns) {
            return std::unexpected(turns.error());
        }
        FittedShape fitted{.before = *of_turns_, .after = {}, .loss_before = loss_of_turns_};
        const auto start = LpShape::power(aspect_now(), kAlpha);
        unsigned round = 0;
        const auto losses_at = [&](std::span<const std::vector<double>> places) {
            auto losses = losses_of_shapes(places);
            if (losses) {
                say_(fmt::format(
                    "round {} of the fit: {} shapes rendered, least loss of these {:.4f}", round++,
                    tried_, *std::ranges::min_element(*losses)));
            }
            return losses;
        };
        const auto best =
            pattern_search({.start = {start.numbers.begin(), start.numbers.end()}}, losses_at);
        if (!best) {
            return std::unexpected(best.error());
        }
        fitted.tried = tried_;
        // As it was, where no shape is better.
        if (best->loss < loss_of_turns_) {
            fitted.after = *point_of(LpShape::of(best->place).settings());
            fitted.loss_after = best->loss;
        } else {
            fitted.after = fitted.before;
            fitted.loss_after = fitted.loss_before;
        }
        return fitted;
    }

  private:
    /// The start of the search; the published exponent.
    static constexpr double kAlpha = 4.0;
    static constexpr double kLeastSigma = 0.5;
    static constexpr double kMostSigma = 16.0;
    /// The share by which the samples of two shapes that are compared may differ from what is asked
    /// for: small pictures have few steps.
    static constexpr double kWithin = 0.04;

    [[nodiscard]] bool takes_turns() const { return fit_.method == "interleaved"; }

    /// Width over height of the buffer that the settings in force give.
    [[nodiscard]] double aspect_now() const {
        if (values_.methods.kfr.aspect > 0.0) {
            return values_.methods.kfr.aspect;
        }
        constexpr double kTall = 0.35;  // as interleaved has it
        const gaze::EyeView& view = question_.comparison.view;
        return takes_turns() ? kTall : static_cast<double>(view.width_px) / view.height_px;
    }

    /// Samples that the method plans with these settings: mean over the cases' first frames. None:
    /// it cannot.
    std::optional<double> planned(const SettingTexts& set) {
        SettingsOfPoint of_point(settings_);
        if (!of_point.set({.method = fit_.method, .settings = set})) {
            return std::nullopt;
        }
        const methods::Method& method = *methods::find_method(fit_.method);
        const gaze::EyeView& view = question_.comparison.view;
        if (!method.check_picture(values_.methods, settings_, {view.width_px, view.height_px})) {
            return std::nullopt;
        }
        double samples = 0.0;
        for (const CaseQuestion& of_case : question_.cases) {
            const auto field = foveation::GazeField::create(
                view, of_case.directions.front()[gaze::index(question_.comparison.eye)]);
            if (!field) {
                return std::nullopt;
            }
            const auto plan = method.plan({.values = values_.methods,
                                           .settings = settings_,
                                           .field = *field,
                                           .line = question_.comparison.line});
            if (!plan) {
                return std::nullopt;
            }
            samples += static_cast<double>(plan->samples);
        }
        return samples / static_cast<double>(question_.cases.size());
    }

    /// The method with these settings and the kfr.sigma that gives the samples asked for; none:
    /// there is no such sigma.
    std::optional<SweepPoint> point_of(const SettingTexts& set) {
        const gaze::EyeView& view = question_.comparison.view;
        const double wanted =
            static_cast<double>(view.width_px) * static_cast<double>(view.height_px) / fit_.fewer;
        const auto with = [&](double sigma) {
            SettingTexts all{{"kfr.sigma", fmt::format("{:.4g}", sigma)}};
            if (takes_turns()) {
                all.emplace_back("interleaved.every", every_);
            }
            all.insert(all.end(), set.begin(), set.end());
            return all;
        };
        // Samples fall as sigma rises, in steps: a buffer has whole columns, rows and tiles.
        double below = kLeastSigma;
        double above = kMostSigma;
        constexpr int kHalvings = 12;
        for (int i = 0; i < kHalvings; ++i) {
            const double middle = std::sqrt(below * above);
            const auto samples = planned(with(middle));
            // What cannot be planned is too coarse, as far as a picture's size decides it.
            (samples && *samples > wanted ? below : above) = middle;
        }
        // The nearest around, where steps are not all downwards.
        std::optional<SweepPoint> nearest;
        double least_off = kWithin;
        constexpr int kAround = 6;
        for (int i = -kAround; i <= kAround; ++i) {
            const SettingTexts set_here = with(below * (1.0 + 0.005 * i));
            const auto samples = planned(set_here);
            const double off = samples ? std::abs(*samples / wanted - 1.0) : kInfinite;
            if (off <= least_off) {
                least_off = off;
                nearest = SweepPoint{.method = fit_.method, .settings = set_here};
            }
        }
        return nearest;
    }

    /// "2.1, 5.4 and none", by the buffer's shape in force.
    std::string reachable() {
        const gaze::EyeView& view = question_.comparison.view;
        const double pixels = static_cast<double>(view.width_px) * view.height_px;
        std::vector<std::string> texts;
        for (const char* const sigma : {"1", "2", "3"}) {
            const auto samples =
                planned({{"kfr.sigma", sigma},
                         {"interleaved.every", takes_turns() ? every_ : std::string("4")}});
            texts.push_back(samples ? fmt::format("{:.3g}", pixels / *samples) : "none");
        }
        return fmt::format("{}, {} and {}", texts[0], texts[1], texts[2]);
    }

    /// Infinite where a point is none or fails.
    Expected<std::vector<double>> losses_of(const std::vector<std::optional<SweepPoint>>& points) {
        std::vector<SweepPoint> possible;
        for (const auto& point : points) {
            if (point) {
                possible.push_back(*point);
            }
        }
        tried_ += static_cast<unsigned>(possible.size());
        auto record = begin_record(question_, possible, settings_, context_.device_name());
        if (!record) {
            return std::unexpected(record.error());
        }
        if (auto swept = sweep(context_, question_, values_, settings_, hooks_, *record); !swept) {
            return std::unexpected(swept.error());
        }
        std::vector<double> of_points(record->points.size(), 0.0);
        for (const JudgedPoint& judged : record->judged) {
            if (judged.error.empty() && !judged.figures.front().lower_is_better) {
                return refuse(
                    fmt::format("of {} higher is better: put --metric contrast or --metric "
                                "flip first",
                                judged.figures.front().key));
            }
            of_points[judged.point] +=
                judged.error.empty()
                    ? judged.figures.front().mean / static_cast<double>(question_.cases.size())
                    : kInfinite;
        }
        std::vector<double> losses;
        losses.reserve(points.size());
        std::size_t next = 1;  // after full resolution
        for (const auto& point : points) {
            losses.push_back(point ? of_points[next++] : kInfinite);
        }
        return losses;
    }

    Expected<std::vector<double>> losses_of_shapes(std::span<const std::vector<double>> places) {
        std::vector<std::optional<SweepPoint>> points;
        points.reserve(places.size());
        for (const std::vector<double>& place : places) {
            points.push_back(point_of(LpShape::of(place).settings()));
        }
        return losses_of(points);
    }

    /// Which share of the texels takes its turn in a frame, by the buffer's shape in force.
    Expected<void> choose_turns() {
        std::vector<std::string> choices{"1"};
        if (takes_turns()) {
            choices = {"2", "4", "8"};
        }
        std::vector<std::optional<SweepPoint>> points;
        for (const std::string& every : choices) {
            every_ = every;
            points.push_back(point_of({}));
        }
        const auto losses = losses_of(points);
        if (!losses) {
            return std::unexpected(losses.error());
        }
        const auto least = std::ranges::min_element(*losses);
        if (!(*least < kInfinite)) {
            return refuse(fmt::format(
                "no kfr.sigma gives {:g} times fewer samples than pixels in a picture that is "
                "worth "
                "drawing; kfr.sigma 1, 2 and 3 give {}: name another --fewer, or larger pictures "
                "(render.scale)",
                fit_.fewer, reachable()));
        }
        const auto chosen = static_cast<std::size_t>(least - losses->begin());
        every_ = choices[chosen];
        of_turns_ = points[chosen];
        loss_of_turns_ = *least;
        return {};
    }

    const vulkan::Context& context_;
    SweepQuestion question_;
    const SweptValues& values_;
    settings::Settings& settings_;
    SweepHooks hooks_;
    std::function<void(const std::string&)> say_;
    const FitQuestion& fit_;
    std::string every_ = "1";
    std::optional<SweepPoint> of_turns_;
    double loss_of_turns_ = 0.0;
    unsigned tried_ = 0;
};

}  // namespace

Expected<FittedShape> fitted_shape(const vulkan::Context& context, const SweepQuestion& question,
                                   const SweptValues& values, settings::Settings& settings,
                                   const SweepHooks& hooks, const FitQuestion& fit) {
    if (fit.method != "kfr" && fit.method != "interleaved") {
        return refuse(
            fmt::format("'{}' has no log-polar buffer whose shape could be fitted: name "
                        "--methods kfr or --methods interleaved alone",
                        fit.method));
    }
    if (fit.method == "interleaved" && question.cases.front().directions.size() < kFewestFrames) {
        return refuse(
            fmt::format("the first frame of interleaved shades everything: give --frames "
                        "{} or more",
                        kFewestFrames));
    }
    return Fit(context, question, values, settings, hooks, fit).run();
}

std::string fitted_toml(const FittedShape& fitted, const FitQuestion& fit,
                        const SweepQuestion& question, const std::string& made_by) {
    const gaze::EyeView& view = question.comparison.view;
    std::string cases;
    for (const CaseQuestion& of_case : question.cases) {
        cases += fmt::format("{}{} at {}", cases.empty() ? "" : ", ", of_case.scene, of_case.gaze);
    }
    const std::size_t frames = question.cases.front().directions.size();
    std::string text = fmt::format(
        "# Made by: {}\n# {}, {}x{} px an eye, {} frame{}, {} sample{} per cell; {}.\n"
        "# At {:g} times fewer samples than pixels{} the first figure is {:.4g}, {:.4g} with {}.\n",
        made_by, question.display, view.width_px, view.height_px, frames, frames == 1 ? "" : "s",
        question.samples, question.samples == 1 ? "" : "s", cases, fit.fewer,
        fit.method == "interleaved" ? " (in a frame that follows others)" : "", fitted.loss_after,
        fitted.loss_before, fitted.before.settings_text());
    std::map<std::string, std::string> groups{
        {"render", fmt::format("method = \"{}\"\n", fit.method)}};
    for (const auto& [key, value] : fitted.after.settings) {
        const std::size_t dot = key.find('.');
        const std::string name = key.substr(dot + 1);
        const bool is_number = name == "sigma" || name == "aspect";
        groups[key.substr(0, dot)] += is_number ? fmt::format("{} = {}\n", name, value)
                                                : fmt::format("{} = \"{}\"\n", name, value);
    }
    for (const auto& [group, lines] : groups) {
        text += fmt::format("\n[{}]\n{}", group, lines);
    }
    return text;
}

}  // namespace gazeloop::trade
