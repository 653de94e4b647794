#include "runtime/study/published_results.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>

#include "runtime/study/analysis.h"
#include "runtime/study/analysis_report.h"
#include "runtime/study/people_report.h"

namespace gazeloop::study {
namespace {

using Json = nlohmann::ordered_json;

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

Json finite(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

std::string figure(double value) {
    return std::isfinite(value) ? fmt::format("{:.3g}", value) : "-";
}

/// What the papers say: Meng et al. 2018, 4.3; Guenter et al. 2012, 5.
std::string published_figure(std::string_view plan, std::string_view condition) {
    if (plan == "kfr-final" && condition == "alpha 4") {
        return "1.8";
    }
    if (plan == "f3d-pair") {
        return "14.9 sd 3.07 (jB 15)";
    }
    if (plan == "f3d-ramp") {
        return "11.9 sd 3.48 (jA 12)";
    }
    return plan == "f3d-slider" ? "14.5 sd 4.1, of all" : "-";
}

std::string question_of(const Plan& plan, const std::string& condition) {
    const std::string where = condition.empty() ? "" : ", " + condition;
    switch (plan.design) {
        case Design::SameDifferent:
        case Design::Quest:
            return fmt::format("{} that {:g} % call the same{}", plan.factors.front().name,
                               100.0 * plan.criterion, where);
        case Design::Pair:
            return fmt::format("{} as good as full resolution{}", plan.factors.front().name, where);
        case Design::Ramp:
            return fmt::format("{} to which a ramp is not seen{}", plan.factors.front().name,
                               where);
        case Design::Slider:
            return fmt::format("{} at the first stop{}", plan.factors.front().name, where);
    }
    return {};
}

/// The paper's choice: of all cells with enough "same", one with the greatest level of the first
/// factor, and of these the one that most called the same.
std::string choice(const Plan& plan, const std::vector<double>& shares) {
    std::optional<std::size_t> best;
    for (std::size_t cell = 0; cell < shares.size(); ++cell) {
        if (!(shares[cell] >= plan.criterion)) {
            continue;
        }
        const double level = plan.levels_of(cell).front();
        if (!best || level > plan.levels_of(*best).front() ||
            (level == plan.levels_of(*best).front() && shares[cell] > shares[*best])) {
            best = cell;
        }
    }
    if (!best) {
        return "none";
    }
    const std::vector<double> levels = plan.levels_of(*best);
    return fmt::format("{} {:g}, {}", plan.factors.front().name, levels.front(),
                       condition_name(plan, std::span(levels).subspan(1)));
}

}  // namespace

std::vector<PublishedResult> against_published(const Plan& plan, const SimulatedPeople& people) {
    const StudyResult found = analyse(plan, simulate_study(plan, people, plan.subjects));
    std::vector<PublishedResult> results;
    for (std::size_t condition = 0; condition < plan.conditions(); ++condition) {
        const ThresholdResult& threshold = found.thresholds[condition];
        const std::string name = condition_name(plan, threshold.condition);
        results.push_back({.plan = plan.name,
                           .question = question_of(plan, name),
                           .published = published_figure(plan.name, name),
                           .truth = true_threshold(plan, people, condition),
                           .fitted = threshold.fitted,
                           .low = threshold.low,
                           .high = threshold.high,
                           .outside = threshold.fit && threshold.fit->outside,
                           .by_rule = threshold.mean,
                           .by_rule_sd = threshold.deviation});
    }
    if (plan.design == Design::SameDifferent && plan.conditions() > 1) {
        std::vector<double> shares;
        shares.reserve(found.cells.size());
        for (const CellResult& cell : found.cells) {
            shares.push_back(cell.yes.share);
        }
        results.push_back({.plan = plan.name,
                           .question = "choice: " + choice(plan, shares),
                           .published = plan.name == "kfr-final" ? "sigma 1.8, alpha 4" : "-",
                           .truth = kNone,
                           .fitted = kNone,
                           .low = kNone,
                           .high = kNone,
                           .by_rule = kNone,
                           .by_rule_sd = kNone});
    }
    return results;
}

std::string published_text(const SimulatedPeople& people,
                           const std::vector<PublishedResult>& results) {
    std::string out =
        fmt::format("{}\n{:<11} {:<44} {:<21}{:>8}{:>9}{:>17}{:>16}\n", people_text(people.terms),
                    "study", "question", "published", "true", "fitted", "95 %", "by rule, sd");
    for (const PublishedResult& one : results) {
        const std::string range = std::isfinite(one.fitted)
                                      ? fmt::format("{} to {}{}", figure(one.low), figure(one.high),
                                                    one.outside ? " *" : "")
                                      : "-";
        const std::string rule =
            std::isfinite(one.by_rule) ? figure(one.by_rule) + ", " + figure(one.by_rule_sd) : "-";
        out += fmt::format("{:<11} {:<44} {:<21}{:>8}{:>9}{:>17}{:>16}\n", one.plan, one.question,
                           one.published, figure(one.truth), figure(one.fitted), range, rule);
    }
    return out +
           "true: where the answers of such people meet the question (-: at no level shown);\n"
           "fitted, by rule: of one simulated study with the paper's people and "
           "trials; *: beyond the levels shown\n";
}

Json published_json(const SimulatedPeople& people, const std::vector<PublishedResult>& results) {
    Json list = Json::array();
    for (const PublishedResult& one : results) {
        list.push_back({{"plan", one.plan},
                        {"question", one.question},
                        {"published", one.published},
                        {"true", finite(one.truth)},
                        {"fitted", finite(one.fitted)},
                        {"low", finite(one.low)},
                        {"high", finite(one.high)},
                        {"outside", one.outside},
                        {"rule_mean", finite(one.by_rule)},
                        {"rule_standard_deviation", finite(one.by_rule_sd)}});
    }
    return {{"people", people_json(people.terms)}, {"results", list}};
}

}  // namespace gazeloop::study
