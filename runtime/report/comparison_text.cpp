#include "runtime/report/comparison_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string_view>

#include "runtime/report/figures.h"
#include "runtime/report/wrapped_row.h"

namespace gazeloop::report {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t kMostDisparities = 12;

std::string unit_name(Unit unit) {
    switch (unit) {
        case Unit::Nanoseconds:
            return "ms";
        case Unit::Microdegrees:
            return "deg";
        case Unit::Count:
            break;
    }
    return "";
}

std::string_view trimmed(std::string_view label) {
    return label.substr(std::min(label.find_first_not_of(' '), label.size()));
}

/// With its sign, and as many digits as the figures beside it.
std::string change(double value) {
    return std::abs(value) < 1000.0 ? fmt::format("{:+.3f}", value) : fmt::format("{:+.0f}", value);
}

std::string line(std::string_view label, std::string_view name, std::string_view unit,
                 const statistics::Difference& difference) {
    std::string text =
        fmt::format("{:<22}{:<7}{:>9} {:>9} {:>9}  {} to {}", label, name,
                    figure(difference.before), figure(difference.after),
                    change(difference.change()), change(difference.low), change(difference.high));
    if (difference.may_be_chance()) {
        text += "  may be chance";
    } else if (!unit.empty()) {
        text += fmt::format(" {}", unit);
    }
    return text + "\n";
}

std::string lines_of(const ComparedRow& row, const std::vector<std::string>& names) {
    std::string text;
    std::string_view label = row.name.label;
    const std::string unit = unit_name(row.unit);
    const auto add = [&](std::string_view name,
                         const std::optional<statistics::Difference>& difference) {
        if (difference) {
            text += line(label, name, unit, *difference);
            label = {};
        }
    };
    add("mean", row.mean);
    for (std::size_t place = 0; place < row.percentiles.size(); ++place) {
        add(names[place], row.percentiles[place]);
    }
    return text;
}

/// Shown whether or not they changed.
bool is_central(const ComparedRow& row) {
    return row.name.key == kGazeAgeAtLatch.key || row.name.key == kGazeAgeAtDisplay.key;
}

void append_name(std::string& list, std::string_view name) {
    list += list.empty() ? "" : ", ";
    list += name;
}

std::string path_line(const FoveaPathDifference& path) {
    const std::string doubt = path.doubt();
    if (!doubt.empty()) {
        return fmt::format("The foveae's paths were not compared: {}.\n", doubt);
    }
    // A percentile of too few frames is withheld.
    const auto degrees = [](double value) {
        return std::isfinite(value) ? fmt::format("{:.3f}", value) : std::string("-");
    };
    return fmt::format(
        "The foveae lie {} deg apart in the mean (p50 {}, p95 {}, max {}), over {} "
        "frames; left out: {} of another view, {} without fresh gaze, {} in one session alone.\n",
        degrees(path.mean_deg), degrees(path.p50_deg), degrees(path.p95_deg), degrees(path.max_deg),
        path.compared, path.other_view, path.without_gaze, path.only_in_one);
}

std::string disparity_lines(const std::vector<Disparity>& disparities) {
    std::string text;
    for (std::size_t place = 0; place < std::min(disparities.size(), kMostDisparities); ++place) {
        const Disparity& one = disparities[place];
        text += fmt::format("  {}: {} -> {}\n", one.what, one.before.empty() ? "-" : one.before,
                            one.after.empty() ? "-" : one.after);
    }
    if (disparities.size() > kMostDisparities) {
        text +=
            fmt::format("  and {} more (--json has them)\n", disparities.size() - kMostDisparities);
    }
    return text.empty() ? "The two sessions had the same settings and devices.\n"
                        : "What else differs:\n" + text;
}

Json difference_json(const std::optional<statistics::Difference>& difference) {
    if (!difference) {
        return nullptr;
    }
    return {{"before", difference->before},   {"after", difference->after},
            {"change", difference->change()}, {"low", difference->low},
            {"high", difference->high},       {"may_be_chance", difference->may_be_chance()}};
}

Json or_null(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

}  // namespace

std::string comparison_text(const Comparison& comparison, const Percentiles& percentiles,
                            const std::string& before) {
    std::string text = fmt::format("\ncompared with {}\n", before);
    for (const std::string& doubt : comparison.doubts) {
        text += fmt::format("DOUBTFUL: {}\n", doubt);
    }
    text += fmt::format("{:<22}{:<7}{:>9} {:>9} {:>9}  {:.0f} % interval of the change\n", "", "",
                        "before", "now", "change", 100.0 * comparison.options.level);
    std::string same;
    std::string few;
    const std::vector<std::string> names = percentiles.names();
    for (const ComparedRow& row : comparison.rows) {
        if (!row.refused.empty()) {
            text += fmt::format("{:<22}not compared: {}\n", row.name.label, row.refused);
        } else if (!row.mean) {
            append_name(few, trimmed(row.name.label));
        } else if (row.changed() || is_central(row)) {
            text += lines_of(row, names);
        } else {
            append_name(same, trimmed(row.name.label));
        }
    }
    text += same.empty() ? "" : wrapped_row("no change beyond chance: ", same);
    text += few.empty()
                ? ""
                : wrapped_row("no interval, for too few frames or neighbours too alike: ", few);
    text += path_line(comparison.path) + disparity_lines(comparison.disparities);
    return text;
}

Json comparison_json(const Comparison& comparison, const Percentiles& percentiles,
                     const std::string& before) {
    Json rows = Json::object();
    const std::vector<std::string> names = percentiles.names();
    for (const ComparedRow& row : comparison.rows) {
        Json json{{"unit", unit_name(row.unit)},
                  {"frames_before", row.frames_before},
                  {"frames_after", row.frames_after},
                  {"refused", row.refused.empty() ? Json(nullptr) : Json(row.refused)},
                  {"mean", difference_json(row.mean)}};
        for (std::size_t place = 0; place < row.percentiles.size(); ++place) {
            json[names[place]] = difference_json(row.percentiles[place]);
        }
        rows[row.name.key] = std::move(json);
    }
    Json disparities = Json::array();
    for (const Disparity& one : comparison.disparities) {
        disparities.push_back({{"what", one.what}, {"before", one.before}, {"after", one.after}});
    }
    const FoveaPathDifference& path = comparison.path;
    const std::string doubt = path.doubt();
    return {{"before", before},
            {"level", comparison.options.level},
            {"seed", comparison.options.seed},
            {"resamples", comparison.options.resamples},
            {"doubts", comparison.doubts},
            {"rows", std::move(rows)},
            {"fovea_path",
             {{"compared", path.compared},
              {"only_in_one", path.only_in_one},
              {"other_view", path.other_view},
              {"without_gaze", path.without_gaze},
              {"doubt", doubt.empty() ? Json(nullptr) : Json(doubt)},
              {"mean_degrees", or_null(path.mean_deg)},
              {"p50_degrees", or_null(path.p50_deg)},
              {"p95_degrees", or_null(path.p95_deg)},
              {"max_degrees", or_null(path.max_deg)}}},
            {"disparities", std::move(disparities)}};
}

}  // namespace gazeloop::report
