#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "runtime/statistics/cochrans_q.h"
#include "runtime/statistics/proportion.h"
#include "runtime/statistics/psychometric_fit.h"
#include "runtime/study/plan.h"
#include "runtime/study/trial.h"

namespace gazeloop::study {

/// One combination of levels. Yes: decisions_of().
struct CellResult {
    std::vector<double> levels{};
    statistics::Proportion yes{};  ///< of all answers, with Wilson's interval of 95 %
    double subjects_mean = 0.0;    ///< of the subjects' shares; NaN without answers
    double standard_error = 0.0;   ///< of that mean; NaN with fewer than two subjects
    std::size_t subjects = 0;
};

/// What a subject did.
struct SubjectResult {
    unsigned subject = 0;
    std::size_t answers = 0;      ///< valid ones to test trials
    std::size_t spoilt = 0;       ///< trials whose answers do not count, because of the eyes
    std::size_t validations = 0;  ///< valid ones
    std::size_t failed = 0;       ///< of these
    bool excluded = false;        ///< failed too many, or answered nothing that counts
    std::vector<std::optional<double>> thresholds{};  ///< by condition, by the papers' rules
    /// By condition: over this subject's answers alone. Empty unless asked for; none: no answers,
    /// or excluded.
    std::vector<std::optional<statistics::FittedThreshold>> fits{};
};

/// A threshold in one condition. Levels, not their logarithms.
struct ThresholdResult {
    std::vector<double> condition{};  ///< levels of all factors but the first
    // By the subjects' rule.
    std::size_t subjects = 0;  ///< that have one
    double mean = 0.0;         ///< NaN without any
    double deviation = 0.0;    ///< NaN with fewer than two
    // By the fit over all of them.
    std::optional<statistics::FittedThreshold> fit{};  ///< over Plan::x_of; none: no answers
    double fitted = 0.0;
    double low = 0.0;
    double high = 0.0;
};

/// Whether the conditions are answered alike at one level of the first factor.
struct LevelTest {
    struct PairTest {
        std::size_t first = 0;  ///< conditions
        std::size_t second = 0;
        std::uint64_t first_alone = 0;
        std::uint64_t second_alone = 0;
        double p = 1.0;       ///< McNemar's
        double holm_p = 1.0;  ///< over all pairs of the level
    };
    double level = 0.0;
    std::size_t blocks = 0;  ///< answered in all conditions: subject and session
    std::optional<statistics::CochransQ> q{};
    std::vector<PairTest> pairs{};
};

struct StudyResult {
    const Plan* plan = nullptr;
    std::vector<SubjectResult> subjects{};
    std::vector<CellResult> cells{};
    std::vector<ThresholdResult> thresholds{};  ///< by condition
    std::vector<LevelTest> tests{};  ///< empty with one condition, and of Slider and Quest
    [[nodiscard]] std::size_t excluded() const;
};

struct AnalysisOptions {
    std::uint32_t resamples = 1000;
    std::uint64_t seed = 1;
    bool fit_subjects = false;  ///< each by itself, too, with a fifth of the resamples
};

/// Of several subjects' responses, in any order. Training and spoilt trials do not count, nor do
/// excluded subjects in cells, thresholds and tests. `plan` must outlive the result. Precondition:
/// check_response() of each.
[[nodiscard]] StudyResult analyse(const Plan& plan, std::span<const Response> responses,
                                  const AnalysisOptions& options = {});

/// Mean, and deviation of a sample; NaN where there are too few.
struct MeanDeviation {
    double mean = 0.0;
    double deviation = 0.0;
};
[[nodiscard]] MeanDeviation mean_deviation(std::span<const double> values);

}  // namespace gazeloop::study
