#include "runtime/study/analysis.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "runtime/study/decisions.h"
#include "runtime/study/subject_thresholds.h"

namespace gazeloop::study {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

using BySubject = std::map<unsigned, std::vector<Response>>;

SubjectResult subject_result(const Plan& plan, unsigned subject,
                             const std::vector<Response>& responses) {
    SubjectResult result{.subject = subject};
    for (const Response& response : responses) {
        if (response.trial.kind == TrialKind::Training) {
            continue;
        }
        result.spoilt += response.valid() ? 0 : 1;
        if (response.trial.kind == TrialKind::Validation) {
            result.validations += response.valid() ? 1 : 0;
            result.failed += failed_validation(response) ? 1 : 0;
        } else {
            result.answers += response.valid() ? 1 : 0;
        }
    }
    result.excluded =
        result.answers == 0 || static_cast<double>(result.failed) >
                                   plan.most_failed * static_cast<double>(result.validations);
    for (std::size_t condition = 0; condition < plan.conditions(); ++condition) {
        result.thresholds.push_back(subject_threshold(plan, responses, condition));
    }
    return result;
}

/// Where a decision's level and a condition lie among the plan's cells.
std::size_t cell_of(const Plan& plan, double level, std::size_t condition) {
    return plan.factors.front().index_of(level) * plan.conditions() + condition;
}

struct Count {
    std::uint32_t trials = 0;
    std::uint32_t yes = 0;
};

/// By subject, then by cell.
using Counts = std::vector<std::vector<Count>>;

Counts counts_of(const Plan& plan, const BySubject& kept) {
    Counts counts;
    for (const auto& [subject, responses] : kept) {
        std::vector<Count>& cells = counts.emplace_back(plan.cells());
        for (const Response& response : responses) {
            for (const Decision& decision : decisions_of(plan, response)) {
                Count& count =
                    cells[cell_of(plan, decision.level, condition_of(plan, response.trial))];
                ++count.trials;
                count.yes += decision.yes ? 1 : 0;
            }
        }
    }
    return counts;
}

CellResult cell_result(const Plan& plan, const Counts& counts, std::size_t cell) {
    CellResult result{.levels = plan.levels_of(cell)};
    Count all;
    std::vector<double> shares;
    for (const std::vector<Count>& of_subject : counts) {
        const Count& count = of_subject[cell];
        all.trials += count.trials;
        all.yes += count.yes;
        if (count.trials > 0) {
            shares.push_back(static_cast<double>(count.yes) / count.trials);
        }
    }
    const auto [mean, deviation] = mean_deviation(shares);
    result.yes = statistics::wilson_interval(all.yes, all.trials);
    result.subjects = shares.size();
    result.subjects_mean = mean;
    result.standard_error = deviation / std::sqrt(static_cast<double>(shares.size()));
    return result;
}

/// What one subject answered in a condition.
std::vector<statistics::LevelCount> level_counts(const Plan& plan,
                                                 const std::vector<Count>& of_subject,
                                                 std::size_t condition) {
    const Factor& factor = plan.factors.front();
    std::vector<statistics::LevelCount> list;
    for (std::size_t level = 0; level < factor.levels.size(); ++level) {
        const Count& count = of_subject[level * plan.conditions() + condition];
        if (count.trials > 0) {
            list.push_back(
                {.x = plan.x_of(factor.levels[level]), .trials = count.trials, .yes = count.yes});
        }
    }
    return list;
}

statistics::FitOptions fit_options(const Plan& plan, const AnalysisOptions& options,
                                   std::uint32_t resamples) {
    return {.rising = plan.higher_is_better,
            .adaptive = adaptive(plan.design),
            .criterion = plan.criterion,
            .seed = options.seed,
            .resamples = resamples};
}

/// By condition.
std::vector<std::optional<statistics::FittedThreshold>> fits_of(
    const Plan& plan, const std::vector<Count>& of_subject, const AnalysisOptions& options) {
    std::vector<std::optional<statistics::FittedThreshold>> fits(plan.conditions());
    for (std::size_t condition = 0; condition < fits.size(); ++condition) {
        if (const auto list = level_counts(plan, of_subject, condition); !list.empty()) {
            fits[condition] = statistics::fit_threshold(
                std::span(&list, 1), fit_options(plan, options, options.resamples / 5));
        }
    }
    return fits;
}

ThresholdResult threshold_result(const Plan& plan, const StudyResult& study, const Counts& counts,
                                 std::size_t condition, const AnalysisOptions& options) {
    ThresholdResult result;
    const std::vector<double> levels = plan.levels_of(condition);
    result.condition.assign(levels.begin() + 1, levels.end());
    std::vector<double> by_rule;
    for (const SubjectResult& subject : study.subjects) {
        if (!subject.excluded && subject.thresholds[condition]) {
            by_rule.push_back(*subject.thresholds[condition]);
        }
    }
    const auto [mean, deviation] = mean_deviation(by_rule);
    result.subjects = by_rule.size();
    result.mean = mean;
    result.deviation = deviation;

    std::vector<std::vector<statistics::LevelCount>> subjects;
    for (const std::vector<Count>& of_subject : counts) {
        if (auto list = level_counts(plan, of_subject, condition); !list.empty()) {
            subjects.push_back(std::move(list));
        }
    }
    result.fitted = result.low = result.high = kNan;
    if (!subjects.empty()) {
        result.fit =
            statistics::fit_threshold(subjects, fit_options(plan, options, options.resamples));
        result.fitted = plan.level_at(result.fit->x);
        result.low = plan.level_at(result.fit->low);
        result.high = plan.level_at(result.fit->high);
    }
    return result;
}

/// Answers to one level by condition, of one subject and session (of all sessions, where some
/// conditions have sessions of their own): the nth of each belong together.
struct BlockKey {
    unsigned subject;
    unsigned session;
    std::size_t nth;
    auto operator<=>(const BlockKey&) const = default;
};

LevelTest level_test(const Plan& plan, const BySubject& kept, std::size_t level) {
    const std::size_t conditions = plan.conditions();
    std::map<BlockKey, std::vector<std::optional<bool>>> blocks;
    for (const auto& [subject, responses] : kept) {
        std::map<std::pair<unsigned, std::size_t>, std::size_t> seen;
        for (const Response& response : responses) {
            const std::vector<Decision> decisions = decisions_of(plan, response);
            if (decisions.empty() ||
                plan.factors.front().index_of(decisions.front().level) != level) {
                continue;
            }
            const std::size_t condition = condition_of(plan, response.trial);
            const unsigned session = plan.least_sessions() > 1 ? 0 : response.trial.session;
            const std::size_t nth = seen[{session, condition}]++;
            auto& block = blocks[{subject, session, nth}];
            block.resize(conditions);
            block[condition] = decisions.front().yes;
        }
    }
    std::erase_if(blocks, [](const auto& block) {
        return std::ranges::any_of(block.second, [](const auto& one) { return !one; });
    });
    LevelTest test{.level = plan.factors.front().levels[level], .blocks = blocks.size()};
    statistics::BinaryAnswers answers{.treatments = conditions, .answers = {}};
    for (const auto& [key, block] : blocks) {
        for (const std::optional<bool>& one : block) {
            answers.answers.push_back(*one ? 1 : 0);
        }
    }
    test.q = statistics::cochrans_q(answers);
    std::vector<double> p;
    for (std::size_t first = 0; first < conditions; ++first) {
        for (std::size_t second = first + 1; second < conditions; ++second) {
            LevelTest::PairTest pair{.first = first, .second = second};
            for (const auto& [key, block] : blocks) {
                pair.first_alone += *block[first] && !*block[second] ? 1 : 0;
                pair.second_alone += !*block[first] && *block[second] ? 1 : 0;
            }
            pair.p = statistics::mcnemar_p(pair.first_alone, pair.second_alone);
            p.push_back(pair.p);
            test.pairs.push_back(pair);
        }
    }
    const std::vector<double> raised = statistics::holm(p);
    for (std::size_t i = 0; i < raised.size(); ++i) {
        test.pairs[i].holm_p = raised[i];
    }
    return test;
}

}  // namespace

std::size_t StudyResult::excluded() const {
    return static_cast<std::size_t>(std::ranges::count(subjects, true, &SubjectResult::excluded));
}

MeanDeviation mean_deviation(std::span<const double> values) {
    if (values.empty()) {
        return {kNan, kNan};
    }
    const auto count = static_cast<double>(values.size());
    double mean = 0.0;
    for (const double value : values) {
        mean += value;
    }
    mean /= count;
    double squares = 0.0;
    for (const double value : values) {
        squares += (value - mean) * (value - mean);
    }
    return {mean, values.size() > 1 ? std::sqrt(squares / (count - 1.0)) : kNan};
}

StudyResult analyse(const Plan& plan, std::span<const Response> responses,
                    const AnalysisOptions& options) {
    BySubject by_subject;
    for (const Response& response : responses) {
        by_subject[response.subject].push_back(response);
    }
    StudyResult result{.plan = &plan};
    BySubject kept;
    for (auto& [subject, own] : by_subject) {
        result.subjects.push_back(subject_result(plan, subject, own));
        if (!result.subjects.back().excluded) {
            kept.emplace(subject, std::move(own));
        }
    }
    const Counts counts = counts_of(plan, kept);
    for (std::size_t i = 0, of_kept = 0; options.fit_subjects && i < result.subjects.size(); ++i) {
        SubjectResult& subject = result.subjects[i];
        subject.fits =
            subject.excluded
                ? std::vector<std::optional<statistics::FittedThreshold>>(plan.conditions())
                : fits_of(plan, counts[of_kept++], options);
    }
    for (std::size_t cell = 0; cell < plan.cells(); ++cell) {
        result.cells.push_back(cell_result(plan, counts, cell));
    }
    for (std::size_t condition = 0; condition < plan.conditions(); ++condition) {
        result.thresholds.push_back(threshold_result(plan, result, counts, condition, options));
    }
    if (plan.conditions() > 1 && !adaptive(plan.design)) {
        for (std::size_t level = 0; level < plan.factors.front().levels.size(); ++level) {
            result.tests.push_back(level_test(plan, kept, level));
        }
    }
    return result;
}

}  // namespace gazeloop::study
