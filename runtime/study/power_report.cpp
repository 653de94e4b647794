#include "runtime/study/power_report.h"

#include <fmt/core.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "runtime/study/people_report.h"

namespace gazeloop::study {
namespace {

using Json = nlohmann::ordered_json;

Json number(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

std::string percent(double share) {
    return std::isfinite(share) ? fmt::format("{:.0f} %", 100.0 * share) : "-";
}

/// "+- 5 %" of a level, or +- so many of its unit.
std::string half_width(const PowerOfPlan& plan, double width) {
    if (!std::isfinite(width)) {
        return "-";
    }
    return plan.logarithmic ? fmt::format("{:.1f} %", 100.0 * std::expm1(width))
                            : fmt::format("{:.3g}", width);
}

}  // namespace

std::string power_text(const SimulatedPeople& people, std::span<const PowerOfPlan> plans) {
    std::string out = fmt::format(
        "{}\n"
        "{:<14}{:>9}{:>7}{:>9}{:>9}{:>9}{:>9}{:>9}{:>8}{:>9}\n",
        people_text(people.terms), "plan", "subjects", "min", "answers", "true", "half", "holds",
        "bias", "Q<.05", "by rule");
    for (const PowerOfPlan& plan : plans) {
        for (const PowerRow& row : plan.rows) {
            out += fmt::format("{:<14}{:>9}{:>7.1f}{:>9.0f}{:>9.3g}{:>9}{:>9}{:>9}{:>8}{:>9.3g}\n",
                               plan.name, row.subjects, row.minutes, row.answers, plan.true_level,
                               half_width(plan, row.half_width), percent(row.share_holding()),
                               half_width(plan, row.bias), percent(row.q_found), row.rule_mean);
        }
    }
    return out +
           "min: per person in the headset; half: median half width of the threshold's interval "
           "of 95 %;\nholds: how often that holds the true threshold; bias: fitted less true; Q: "
           "levels at which\nCochran's Q finds the conditions different; by rule: mean of the "
           "paper's own thresholds\n";
}

Json power_json(const SimulatedPeople& people, std::span<const PowerOfPlan> plans) {
    Json list = Json::array();
    for (const PowerOfPlan& plan : plans) {
        Json rows = Json::array();
        for (const PowerRow& row : plan.rows) {
            rows.push_back({{"subjects", row.subjects},
                            {"studies", row.studies},
                            {"minutes", number(row.minutes)},
                            {"answers", number(row.answers)},
                            {"excluded", number(row.excluded)},
                            {"intervals", row.intervals},
                            {"holding", row.holding},
                            {"half_width_x", number(row.half_width)},
                            {"bias_x", number(row.bias)},
                            {"q_found", number(row.q_found)},
                            {"rule_mean", number(row.rule_mean)}});
        }
        list.push_back({{"plan", plan.name},
                        {"true_level", number(plan.true_level)},
                        {"logarithmic", plan.logarithmic},
                        {"rows", rows}});
    }
    return {{"people", people_json(people.terms)}, {"plans", list}};
}

}  // namespace gazeloop::study
