#include <fmt/format.h>

#include <algorithm>

#include "runtime/report/lag_loss.h"
#include "runtime/report/lag_reasons.h"
#include "runtime/report/prediction_text.h"
#include "runtime/report/smoothing_text.h"
#include "runtime/time/milliseconds.h"

namespace gazeloop::report {
namespace {

using gaze::SmoothingVerdict;
using latency::Verdict;

LagAnswer smoothed(const LagFacts& facts) {
    const gaze::SmoothingFinding& found = facts.smoothing;
    LagAnswer answer{.key = "smoothed", .question = "Is the gaze smoothed by the runtime?"};
    if (found.verdict == SmoothingVerdict::Smoothed) {
        answer.kind = LagAnswerKind::Yes;
    } else if (found.verdict == SmoothingVerdict::NotSmoothed) {
        answer.kind = LagAnswerKind::No;
    }
    answer.why = smoothing_text(found);
    return answer;
}

LagAnswer late(const LagFacts& facts) {
    LagAnswer answer{.key = "late", .question = "Is it late?"};
    const latency::SummaryReport& report = *facts.report;
    const latency::DurationRow& age = report.gaze_age_at_display;
    if (age.count == 0) {
        answer.why = "how old the gaze is when its picture is seen is unknown in all frames";
        return answer;
    }
    const double late_ms = age.p95_ms.value_or(*age.max_ms);
    const std::string measured =
        fmt::format("{} is {}", age.p95_ms ? "the p95 of its age" : "its greatest age",
                    milliseconds_text(late_ms));
    const std::string predicted = prediction_sentence(facts.prediction);
    if (report.verdict == Verdict::NotRealTime || report.verdict == Verdict::VirtualTime) {
        answer.why = fmt::format("{}, but {}{}", measured,
                                 report.verdict == Verdict::VirtualTime
                                     ? "in virtual time nothing was timed"
                                     : "the machine does not keep up with the display",
                                 predicted);
        return answer;
    }
    if (facts.budget == nullptr || !facts.budget->total_ns) {
        answer.why = fmt::format("{}, and no budget was named to hold it against (--budget){}",
                                 measured, predicted);
        return answer;
    }
    const double budget_ms = static_cast<double>(*facts.budget->total_ns) / time::kNsPerMs;
    answer.kind = late_ms > budget_ms ? LagAnswerKind::Yes : LagAnswerKind::No;
    answer.why = fmt::format("{}, the budget {} allows {}{}", measured, facts.budget->name,
                             milliseconds_text(budget_ms), predicted);
    return answer;
}

/// Why a sample is used again, where it is.
std::string why_reused(const LagFacts& facts, double percent) {
    const double interval_ms = facts.report->frame_interval.p50_ms.value_or(0.0);
    const double frames_hz = interval_ms > 0.0 ? 1e3 / interval_ms : 0.0;
    const auto expected = latency::expected_reuse_percent(facts.smoothing.rate_hz, frames_hz);
    if (!expected) {
        return "; what is usual cannot be said, because a rate is unknown";
    }
    const std::string rates = fmt::format("{:.0f} samples and {:.0f} frames a second",
                                          facts.smoothing.rate_hz, frames_hz);
    constexpr double kMore_percent = 2.0;
    if (*expected > 0.0) {
        return fmt::format(
            "; with {} {:.0f} % must{}", rates, *expected,
            percent > *expected + kMore_percent
                ? ", the rest is of samples or frames that come in bursts, or of lost samples"
                : ", which is normal");
    }
    return fmt::format(
        "; with {} none would have to: samples or frames come in bursts, or samples are lost",
        rates);
}

LagAnswer reused(const LagFacts& facts) {
    LagAnswer answer{.key = "reused", .question = "Is it reused?"};
    const latency::GazeUseCounts& use = facts.use;
    const auto percent = use.reused_percent();
    if (!percent) {
        answer.why = "no two frames in a row have gaze";
        return answer;
    }
    if (use.reused == 0) {
        answer.kind = LagAnswerKind::No;
        answer.why = "each frame with gaze has another sample than the frame before";
        return answer;
    }
    answer.kind = LagAnswerKind::Yes;
    answer.why = fmt::format(
        "{:.1f} % of the frames ({}) have the sample of the frame before, up "
        "to {} in a row from frame {} on{}",
        *percent, use.reused, use.longest_reuse.frames, use.longest_reuse.first,
        why_reused(facts, *percent));
    return answer;
}

/// The samples, which tell more than frames where the tracker is faster.
std::string samples_text(const latency::GazeCounts& gaze) {
    if (gaze.invalid + gaze.lost == 0) {
        return "";
    }
    return fmt::format("; of {} samples {} had no valid eye{}", gaze.received, gaze.invalid,
                       gaze.lost > 0 ? fmt::format(", and {} more never came", gaze.lost) : "");
}

std::string loss_length(std::int64_t ns) {
    constexpr std::int64_t kLongestBlink_ns = 400'000'000;
    return fmt::format(" ({:.0f} ms, {})", static_cast<double>(ns) / time::kNsPerMs,
                       ns > kLongestBlink_ns ? "longer than a blink" : "no longer than a blink");
}

LagAnswer lost(const LagFacts& facts) {
    LagAnswer answer{.key = "lost", .question = "Is it lost?"};
    const latency::GazeUseCounts& use = facts.use;
    const auto percent = use.lost_percent();
    if (!percent) {
        answer.why = "no frame was rendered";
        return answer;
    }
    if (use.lost == 0) {
        answer.kind = LagAnswerKind::No;
        answer.why = fmt::format("all {} frames rest on a fresh sample{}", use.rendered,
                                 samples_text(facts.report->gaze));
        return answer;
    }
    answer.kind = LagAnswerKind::Yes;
    std::string longest;
    if (use.longest_loss.frames > 0) {
        const time::Span& lasted = use.longest_loss.lasted;
        longest = fmt::format("; the longest loss takes {} frames from frame {} on{}",
                              use.longest_loss.frames, use.longest_loss.first,
                              lasted.known() && lasted.ns > 0 ? loss_length(lasted.ns) : "");
    }
    answer.why =
        fmt::format("{:.1f} % of the frames ({}) have no fresh gaze: {}{}{}", *percent, use.lost,
                    losses_by_cause(use), longest, samples_text(facts.report->gaze));
    return answer;
}

}  // namespace

std::array<LagAnswer, kLagQuestionCount> lag_answers(const LagFacts& facts) {
    return {smoothed(facts), late(facts), reused(facts), lost(facts)};
}

}  // namespace gazeloop::report
