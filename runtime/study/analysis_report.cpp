#include "runtime/study/analysis_report.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <set>

#include "runtime/study/decisions.h"

namespace gazeloop::study {
namespace {

using Json = nlohmann::ordered_json;

/// JSON has no not-a-number.
Json number(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

std::string text(double value, const char* unknown = "-") {
    return std::isfinite(value) ? fmt::format("{:.4g}", value) : unknown;
}

/// A probability, as papers state it.
std::string p_text(double p) { return p < 0.001 ? "<0.001" : fmt::format("{:.3f}", p); }

std::string csv_number(double value) {
    return std::isfinite(value) ? fmt::format("{}", value) : "";
}

std::string thresholds_text(const StudyResult& result) {
    const Plan& plan = *result.plan;
    std::string out = fmt::format(
        "\nThresholds of {}{}\n", plan.factors.front().name,
        plan.criterion == 0.5
            ? ""
            : fmt::format(" (by the fit: {:g} % of answers yes)", 100.0 * plan.criterion));
    out += fmt::format("{:<24}{:>9}{:>9}{:>7}{:>11}{:>11}{:>11}\n", "condition", "mean", "sd", "n",
                       "fitted", "95% from", "to");
    for (const ThresholdResult& threshold : result.thresholds) {
        const std::string name = condition_name(plan, threshold.condition);
        out +=
            fmt::format("{:<24}{:>9}{:>9}{:>7}{:>11}{:>11}{:>11}{}\n", name.empty() ? "all" : name,
                        text(threshold.mean), text(threshold.deviation), threshold.subjects,
                        text(threshold.fitted), text(threshold.low), text(threshold.high),
                        threshold.fit && threshold.fit->outside ? "  outside what was shown" : "");
    }
    return out + fmt::format("mean, sd, n: over subjects, {}; fitted: over all answers\n",
                             rule_name(plan.design));
}

std::string tests_text(const StudyResult& result) {
    if (result.tests.empty()) {
        return "";
    }
    const Plan& plan = *result.plan;
    std::string out =
        fmt::format("\nConditions against each other\n{:<12}{:>8}{:>10}{:>5}{:>9}   {}\n",
                    plan.factors.front().name, "blocks", "Cochran Q", "df", "p",
                    "pairs that differ (McNemar, Holm)");
    for (const LevelTest& test : result.tests) {
        std::string differ;
        for (const LevelTest::PairTest& pair : test.pairs) {
            if (pair.holm_p < 0.05) {
                const auto levels = [&](std::size_t condition) {
                    return condition_name(plan, result.thresholds[condition].condition);
                };
                differ += fmt::format("{}{} / {} (p {})", differ.empty() ? "" : "; ",
                                      levels(pair.first), levels(pair.second), p_text(pair.holm_p));
            }
        }
        out += fmt::format("{:<12}{:>8}{:>10}{:>5}{:>9}   {}\n", text(test.level), test.blocks,
                           test.q ? fmt::format("{:.2f}", test.q->q) : "-",
                           test.q ? fmt::format("{}", test.q->degrees_of_freedom) : "-",
                           test.q ? p_text(test.q->p) : "-", differ);
    }
    return out;
}

/// Of one subject.
Json fit_json(const Plan& plan, const statistics::FittedThreshold& fit) {
    return {{"fitted", number(plan.level_at(fit.x))},  {"low", number(plan.level_at(fit.low))},
            {"high", number(plan.level_at(fit.high))}, {"spread_x", fit.people.function.spread},
            {"lowest", fit.people.function.lowest},    {"highest", fit.people.function.highest},
            {"bend", fit.people.function.bend},        {"outside", fit.outside}};
}

Json subjects_json(const StudyResult& result) {
    const Plan& plan = *result.plan;
    Json list = Json::array();
    for (const SubjectResult& subject : result.subjects) {
        Json thresholds = Json::array();
        for (const std::optional<double>& one : subject.thresholds) {
            thresholds.push_back(one ? Json(*one) : Json(nullptr));
        }
        Json fits = Json::array();
        for (const std::optional<statistics::FittedThreshold>& one : subject.fits) {
            fits.push_back(one ? fit_json(plan, *one) : Json(nullptr));
        }
        list.push_back({{"subject", subject.subject},
                        {"answers", subject.answers},
                        {"spoilt", subject.spoilt},
                        {"validations", subject.validations},
                        {"failed", subject.failed},
                        {"excluded", subject.excluded},
                        {"thresholds", thresholds},
                        {"fits", fits}});
    }
    return list;
}

Json tests_json(const StudyResult& result) {
    Json list = Json::array();
    for (const LevelTest& test : result.tests) {
        Json pairs = Json::array();
        for (const LevelTest::PairTest& pair : test.pairs) {
            pairs.push_back({{"first", result.thresholds[pair.first].condition},
                             {"second", result.thresholds[pair.second].condition},
                             {"first_alone", pair.first_alone},
                             {"second_alone", pair.second_alone},
                             {"p", pair.p},
                             {"holm_p", pair.holm_p}});
        }
        Json one{{"level", test.level}, {"blocks", test.blocks}};
        one["q"] = test.q ? Json(test.q->q) : Json(nullptr);
        one["degrees_of_freedom"] = test.q ? Json(test.q->degrees_of_freedom) : Json(nullptr);
        one["p"] = test.q ? Json(test.q->p) : Json(nullptr);
        one["pairs"] = std::move(pairs);
        list.push_back(std::move(one));
    }
    return list;
}

}  // namespace

std::string yes_name(const Plan& plan) {
    switch (plan.design) {
        case Design::SameDifferent:
        case Design::Quest:
            return "P(same)";
        case Design::Pair:
            return "P(equal or better)";
        case Design::Ramp:
            return "P(change not seen)";
        case Design::Slider:
            return "P(equal)";
    }
    return "P(yes)";
}

std::string rule_name(Design design) {
    switch (design) {
        case Design::SameDifferent:
        case Design::Quest:
            return "the level furthest from the reference that was mostly called the same";
        case Design::Pair:
            return "the lowest level called as good or better";
        case Design::Ramp:
            return "the lowest level whose ramp was not seen, or the wrong way";
        case Design::Slider:
            return "the first stop";
    }
    return {};
}

std::string condition_name(const Plan& plan, std::span<const double> levels) {
    std::string name;
    for (std::size_t at = 0; at < levels.size(); ++at) {
        const Factor& factor = plan.factors[at + 1];
        name += fmt::format(
            "{}{} {}", at > 0 ? ", " : "", factor.name,
            factor.values.empty() ? fmt::format("{:g}", levels[at]) : factor.value_of(levels[at]));
    }
    return name;
}

std::string analysis_text(const StudyResult& result) {
    const Plan& plan = *result.plan;
    std::size_t answers = 0;
    std::size_t spoilt = 0;
    for (const SubjectResult& subject : result.subjects) {
        answers += subject.answers;
        spoilt += subject.spoilt;
    }
    std::string out = fmt::format("{} ({}): {} subjects, {} answers, {} spoilt by the eyes\n",
                                  plan.name, kDesignNames[static_cast<std::size_t>(plan.design)],
                                  result.subjects.size(), answers, spoilt);
    for (const SubjectResult& subject : result.subjects) {
        if (subject.excluded) {
            out += subject.answers == 0
                       ? fmt::format("left out: subject {}, who gave no answer that counts\n",
                                     subject.subject)
                       : fmt::format(
                             "left out: subject {}, {} of {} validation trials failed, {} "
                             "answers\n",
                             subject.subject, subject.failed, subject.validations, subject.answers);
        }
    }
    out += "\n";
    for (const Factor& factor : plan.factors) {
        out += fmt::format("{:>10}", factor.name);
    }
    out +=
        fmt::format("{:>20}{:>8}{:>9}{:>9}{:>9}\n", yes_name(plan), "of", "95% from", "to", "se");
    for (const CellResult& cell : result.cells) {
        for (const double level : cell.levels) {
            out += fmt::format("{:>10}", fmt::format("{:g}", level));
        }
        out += fmt::format("{:>20}{:>8}{:>9}{:>9}{:>9}\n", text(cell.yes.share), cell.yes.trials,
                           text(cell.yes.low), text(cell.yes.high), text(cell.standard_error));
    }
    return out + thresholds_text(result) + tests_text(result);
}

Json analysis_json(const StudyResult& result) {
    const Plan& plan = *result.plan;
    Json factors = Json::array();
    for (const Factor& factor : plan.factors) {
        factors.push_back({{"name", factor.name},
                           {"key", factor.key},
                           {"levels", factor.levels},
                           {"values", factor.values}});
    }
    Json cells = Json::array();
    for (const CellResult& cell : result.cells) {
        cells.push_back({{"levels", cell.levels},
                         {"yes", cell.yes.yes},
                         {"trials", cell.yes.trials},
                         {"share", number(cell.yes.share)},
                         {"low", cell.yes.low},
                         {"high", cell.yes.high},
                         {"subjects", cell.subjects},
                         {"mean", number(cell.subjects_mean)},
                         {"standard_error", number(cell.standard_error)}});
    }
    Json thresholds = Json::array();
    for (const ThresholdResult& threshold : result.thresholds) {
        Json one{{"condition", threshold.condition},
                 {"subjects", threshold.subjects},
                 {"mean", number(threshold.mean)},
                 {"standard_deviation", number(threshold.deviation)},
                 {"fitted", number(threshold.fitted)},
                 {"low", number(threshold.low)},
                 {"high", number(threshold.high)}};
        if (threshold.fit) {
            const statistics::FittedPeople& people = threshold.fit->people;
            one["function"] = {{"threshold_x", people.function.threshold},
                               {"spread_x", people.function.spread},
                               {"lowest", people.function.lowest},
                               {"highest", people.function.highest},
                               {"bend", people.function.bend},
                               {"people_x", people.people},
                               {"outside", threshold.fit->outside}};
        }
        thresholds.push_back(std::move(one));
    }
    return {{"study", plan.name},
            {"design", kDesignNames[static_cast<std::size_t>(plan.design)]},
            {"criterion", plan.criterion},
            {"yes", yes_name(plan)},
            {"factors", factors},
            {"excluded", result.excluded()},
            {"subjects", subjects_json(result)},
            {"cells", cells},
            {"thresholds", thresholds},
            {"tests", tests_json(result)}};
}

std::string cells_csv(const StudyResult& result) {
    std::string csv;
    for (const Factor& factor : result.plan->factors) {
        csv += factor.name + ",";
    }
    csv += "yes,trials,share,low,high,subjects,mean,standard_error\n";
    for (const CellResult& cell : result.cells) {
        for (const double level : cell.levels) {
            csv += fmt::format("{},", level);
        }
        csv += fmt::format("{},{},{},{},{},{},{},{}\n", cell.yes.yes, cell.yes.trials,
                           csv_number(cell.yes.share), cell.yes.low, cell.yes.high, cell.subjects,
                           csv_number(cell.subjects_mean), csv_number(cell.standard_error));
    }
    return csv;
}

std::string decisions_csv(const StudyResult& result, std::span<const Response> responses) {
    const Plan& plan = *result.plan;
    std::set<unsigned> excluded;
    for (const SubjectResult& subject : result.subjects) {
        if (subject.excluded) {
            excluded.insert(subject.subject);
        }
    }
    std::string formula;
    std::string heads;
    for (const Factor& factor : plan.factors) {
        const bool first = &factor == &plan.factors.front();
        formula += first && plan.logarithmic ? fmt::format("log({})", factor.name)
                   : first                   ? factor.name
                                             : fmt::format(" * factor({})", factor.name);
        heads += "," + factor.name;
    }
    std::string csv = fmt::format(
        "# lme4::glmer(yes ~ {} + (1 | subject), family = binomial, data = read.csv(FILE, "
        "comment.char = \"#\"))\nsubject,session,trial,reference_first{},yes\n",
        formula, heads);
    for (const Response& response : responses) {
        if (excluded.contains(response.subject)) {
            continue;
        }
        for (const Decision& decision : decisions_of(plan, response)) {
            csv += fmt::format("{},{},{},{},{}", response.subject, response.trial.session,
                               response.trial.number, response.trial.reference_first ? 1 : 0,
                               decision.level);
            for (std::size_t at = 1; at < response.trial.levels.size(); ++at) {
                csv += fmt::format(",{}", response.trial.levels[at]);
            }
            csv += decision.yes ? ",1\n" : ",0\n";
        }
    }
    return csv;
}

}  // namespace gazeloop::study
