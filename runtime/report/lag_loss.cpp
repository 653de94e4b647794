#include "runtime/report/lag_loss.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <iterator>

#include "runtime/report/recorded_application.h"

namespace gazeloop::report {
namespace {

using gaze::LossCause;

constexpr std::array<std::string_view, gaze::kLossReasonNames.size()> kByReason{
    "", "neither eye was valid", "the newest sample was too old", "none had come yet"};
constexpr std::array<std::string_view, gaze::kLossCauseNames.size()> kByCause{
    "",
    "the tracker vouched for neither eye",
    "the lids were closed",
    "directions came with too little confidence",
    "directions pointed out of the field",
    "the tracker was gone",
    "samples stopped coming",
    "samples came with times from before"};

/// The commonest one; None where it is not known of most frames.
LossCause commonest_cause(const latency::GazeUseCounts& use) {
    const auto most = std::ranges::max_element(use.lost_by_cause);
    return static_cast<LossCause>(std::distance(use.lost_by_cause.begin(), most));
}

std::string_view commonest_words(const latency::GazeUseCounts& use) {
    if (const LossCause cause = commonest_cause(use); cause != LossCause::None) {
        return kByCause[static_cast<std::size_t>(cause)];
    }
    const auto most = std::ranges::max_element(use.lost_by_reason);
    return kByReason[static_cast<std::size_t>(std::distance(use.lost_by_reason.begin(), most))];
}

void append(std::string& text, std::uint64_t frames, std::string_view words) {
    text += fmt::format("{}{} because {}", text.empty() ? "" : ", ", frames, words);
}

}  // namespace

std::string losses_by_cause(const latency::GazeUseCounts& use) {
    std::string text;
    for (std::size_t cause = 1; cause < kByCause.size(); ++cause) {
        if (use.lost_by_cause[cause] > 0) {
            append(text, use.lost_by_cause[cause], kByCause[cause]);
        }
    }
    if (!text.empty()) {
        const std::uint64_t before =
            use.lost_by_reason[static_cast<std::size_t>(gaze::LossReason::Never)];
        if (before > 0) {
            append(text, before, kByReason[static_cast<std::size_t>(gaze::LossReason::Never)]);
        }
        return text;
    }
    for (std::size_t reason = 1; reason < kByReason.size(); ++reason) {
        if (use.lost_by_reason[reason] > 0) {
            append(text, use.lost_by_reason[reason], kByReason[reason]);
        }
    }
    return text;
}

bool often_lost(const LagFacts& facts) {
    return facts.report->frames.with_gaze() > 0 &&
           facts.use.lost_percent().value_or(0.0) > kOftenLost_percent;
}

std::string loss_sentence(const LagFacts& facts) {
    const std::string_view words = commonest_words(facts.use);
    return fmt::format(
        "In {:.1f} % of the frames the fovea has no fresh gaze at all{}.",
        *facts.use.lost_percent(),
        words.empty() ? std::string{} : fmt::format(", most often because {}", words));
}

std::string loss_remedy(const LagFacts& facts) {
    const auto now = [&facts](std::string_view name) {
        const std::string_view value = facts.setting(name);
        return value.empty() ? std::string(name) : fmt::format("{} (now {})", name, value);
    };
    switch (facts.origin) {
        case GazeOrigin::Simulated:
            return "That person and tracker are simulated: sim.dropout_percent, "
                   "sim.eye_loss_percent and the blinks of sim.* set it.";
        case GazeOrigin::Trace:
            return commonest_cause(facts.use) == LossCause::Stopped
                       ? "The trace has no samples there, or is over: a longer one, or --seconds "
                         "no "
                         "longer than it; gazeloop gaze FILE says what it holds."
                       : "The trace lacks the gaze there: gazeloop gaze FILE says what it holds.";
        default:
            break;
    }
    switch (commonest_cause(facts.use)) {
        case LossCause::Blink:
            return fmt::format("Try first a lower {}: it may take narrow eyes for closed.",
                               now("gaze.closed_below"));
        case LossCause::LowConfidence:
            return fmt::format("Try first to calibrate the tracker anew, or a lower {}.",
                               now("gaze.minimum_confidence"));
        case LossCause::OutsideField:
            return fmt::format("Try first a wider {}, or look whether the axes are right{}.",
                               now("gaze.field_deg"),
                               is_of_another_program(facts) ? "" : " (--axes)");
        case LossCause::Unplugged:
            return "Look first after the tracker's cable and port.";
        case LossCause::Stopped:
        case LossCause::ClockStep:
            return "Look first why the tracker's samples stop (gazeloop devices --watch).";
        case LossCause::NotSeen:
        case LossCause::None:
            break;
    }
    return "Try first to seat the headset so that the tracker sees both eyes, and calibrate it "
           "anew; gazeloop devices shows what it sees.";
}

}  // namespace gazeloop::report
