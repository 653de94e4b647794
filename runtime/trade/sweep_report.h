#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "runtime/trade/choice.h"
#include "runtime/trade/setting_fit.h"
#include "runtime/trade/sweep_rows.h"

namespace gazeloop::trade {

/// A sweep as it is reported.
struct SweepReport {
    SweepSubject subject;
    std::vector<SweepSheet> sheets;  ///< one per case
    SweepSheet mean;                 ///< over the cases; no rows: there is one case
    ChoiceQuestion question{};       ///< what is to be recommended
    bool with_fits = false;
    std::string command_line{};

    /// The rows that recommendation, fits and levels of quality are about: those of the only case,
    /// or the means.
    [[nodiscard]] const std::vector<SweepRow>& summed_rows() const {
        return mean.rows.empty() ? sheets.front().rows : mean.rows;
    }
};

/// Of a record with a case.
[[nodiscard]] SweepReport report_of(const SweepRecord& record);

/// What failed, point by point and case by case, and whether nothing could be recommended; empty:
/// all is well.
[[nodiscard]] std::vector<std::string> failures(const SweepReport& report);

/// That timed frames of a case waited for views of its light field, which their times do not tell;
/// empty: none did.
[[nodiscard]] std::string waits_text(const SweepSheet& sheet);

/// What is not as it should be of the cases that were measured, each with its case where there are
/// several.
[[nodiscard]] std::vector<std::string> warnings(const SweepReport& report);

/// Tables, dearest point first; then what equal quality costs, fits, and the recommendation.
/// Precondition: choose() takes the question.
[[nodiscard]] std::string sweep_text(const SweepReport& report);
/// A line per case and point, in the order in which they were asked for; what is infinite is "inf".
[[nodiscard]] std::string sweep_csv(const SweepReport& report);
/// What is infinite is null.
[[nodiscard]] nlohmann::ordered_json sweep_json(const SweepReport& report);

/// "scene raymarch, gaze 0,0".
[[nodiscard]] std::string case_text(const SweepCase& of_case);
/// What of a scene's contrast lies where (quality::ContrastShares), as a sentence; empty: unknown.
[[nodiscard]] std::string shares_text(const SweepSheet& sheet);
/// "kfr kfr.sigma=1.8"; "full".
[[nodiscard]] std::string point_text(const SweepPoint& point);
/// "ms = 0.2 + cells * 31 ns; within 3 % (worst 5 % at ...)" and its likes, one line each.
[[nodiscard]] std::vector<std::string> fit_lines(const MethodFit& fit);

}  // namespace gazeloop::trade
