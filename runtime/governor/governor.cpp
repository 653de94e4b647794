#include "runtime/governor/governor.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace gazeloop::governor {
namespace {

constexpr double kNoFrame_ms = 3.6e6;  // longer: the machine slept, or a clock was set
constexpr std::size_t kHundred = 100;
constexpr std::size_t kMisses = 2;  // in a hundred
constexpr std::size_t kMostCaution = 64;
/// A step up that lasted for so many windows was no mistake.
constexpr std::size_t kProvenWindows = 10;

constexpr std::array<std::string_view, kReasonCount> kReasonTexts{
    "the best that is expected to keep the budget",
    "over the budget",
    "over the budget now and then",
    "room for a better level",
    "the floor of this state",
    "over the budget, and no level that is allowed takes less",
};

bool is_time(double ms) { return ms > 0.0 && ms < kNoFrame_ms; }

}  // namespace

SeenEyes seen_eyes(const gaze::FrameFovea& fovea) {
    SeenEyes seen{.state = EyeState::Lost};
    bool tracked = false;
    bool held = false;
    bool moving = false;
    for (const gaze::FoveaPoint& eye : fovea.eyes) {
        tracked = tracked || eye.state == gaze::FoveaState::Tracking ||
                  eye.state == gaze::FoveaState::OtherEye;
        held = held || eye.state == gaze::FoveaState::Held;
        moving = moving || eye.event == gaze::EyeEvent::Saccade ||
                 eye.event == gaze::EyeEvent::Oscillation;
        seen.events_known = seen.events_known || eye.event.has_value();
    }
    if (tracked) {
        seen.state = moving ? EyeState::Saccade : EyeState::Fixation;
    } else if (held) {
        seen.state = EyeState::Blink;
    }
    return seen;
}

FixedText<240> decision_text(const Decision& decision) {
    std::array<char, 240> text{};
    const auto end =
        fmt::format_to_n(text.data(), text.size(), "level {} -> {}: {}", decision.from + 1,
                         decision.to + 1, kReasonTexts[static_cast<std::size_t>(decision.reason)]);
    std::size_t size = std::min(end.size, text.size());
    if (decision.ms > 0.0 && decision.budget_ms > 0.0) {
        const auto times =
            fmt::format_to_n(text.data() + size, text.size() - size, ": {:.2f} ms of {:.2f}",
                             decision.ms, decision.budget_ms);
        size = std::min(size + times.size, text.size());
    }
    const auto state = fmt::format_to_n(text.data() + size, text.size() - size, " ({})",
                                        kEyeStateNames[static_cast<std::size_t>(decision.state)]);
    return FixedText<240>({text.data(), std::min(size + state.size, text.size())});
}

Expected<std::array<std::size_t, kEyeStateCount>> worst_levels(
    const Front& front, const std::array<double, kEyeStateCount>& floors) {
    std::array<std::size_t, kEyeStateCount> worst{};
    for (std::size_t state = 0; state < kEyeStateCount; ++state) {
        const auto is_good = [&](const Level& level) {
            return floors[state] == 0.0 || level.loss <= floors[state];
        };
        const auto good = std::ranges::count_if(front.levels, is_good);
        if (good == 0) {
            return std::unexpected(
                Error{ErrorKind::Usage,
                      fmt::format("a floor of {} in {}s: the best level of the front ({}) has a "
                                  "{} of {}: use a higher floor or a better front",
                                  floors[state], kEyeStateNames[state], front.levels[0].text(),
                                  front.figure, front.levels[0].loss)});
        }
        worst[state] = static_cast<std::size_t>(good) - 1;
    }
    return worst;
}

Governor::Governor(const GovernorOptions& options, std::span<const double> cost)
    : options_(options), levels_(std::min(cost.size(), kMostLevels)) {
    std::ranges::copy(cost.first(levels_), cost_.begin());
    caution_.fill(1);
}

void Governor::forget() {
    measured_ = 0;
    in_hundred_ = 0;
    misses_ = 0;
    in_window_ = 0;
    longest_ms_ = 0.0;
    second_longest_ms_ = 0.0;
    roomy_windows_ = 0;
    waited_ = 0;
    held_ = false;
}

std::size_t Governor::worst_in(EyeState state) const {
    return std::min(options_.worst[static_cast<std::size_t>(state)], levels_ - 1);
}

/// The best of those that take the least.
std::size_t Governor::cheapest(std::size_t worst) const {
    return static_cast<std::size_t>(
        std::ranges::min_element(cost_.begin(),
                                 cost_.begin() + static_cast<std::ptrdiff_t>(worst) + 1) -
        cost_.begin());
}

double Governor::recent_ms() const {
    const std::size_t known = std::min(measured_, kRecent);
    if (known < 2) {
        return 0.0;
    }
    std::array<double, kRecent> sorted{};
    std::ranges::partial_sort_copy(
        recent_.begin(), recent_.begin() + static_cast<std::ptrdiff_t>(known), sorted.begin(),
        sorted.begin() + static_cast<std::ptrdiff_t>(known), std::ranges::greater());
    return sorted[1];
}

void Governor::measured(std::size_t level, double ms) {
    if (level != level_ || !started_ || !is_time(ms)) {
        return;
    }
    recent_[measured_ % kRecent] = ms;
    ++measured_;
    if (in_hundred_ == kHundred) {
        in_hundred_ = 0;
        misses_ = 0;
    }
    ++in_hundred_;
    // What strikes by itself now and then (another program) is no reason to draw worse for good.
    if (ms > budget_ms_ && level_ + 1 < levels_ && expected_ms(level_ + 1, ms) <= budget_ms_) {
        ++misses_;
    }
    second_longest_ms_ = std::max(second_longest_ms_, std::min(longest_ms_, ms));
    longest_ms_ = std::max(longest_ms_, ms);
    if (++in_window_ == options_.settle_frames) {
        const bool room = level_ > 0 && expected_ms(level_ - 1, second_longest_ms_) <=
                                            options_.room_share * budget_ms_;
        roomy_windows_ = room ? roomy_windows_ + 1 : 0;
        held_ = held_ && second_longest_ms_ > budget_ms_;
        in_window_ = 0;
        longest_ms_ = 0.0;
        second_longest_ms_ = 0.0;
    }
}

Decision Governor::move_to(std::size_t level, Reason reason, EyeState state) {
    const Decision decision{.from = level_,
                            .to = level,
                            .reason = reason,
                            .state = state,
                            .ms = recent_ms(),
                            .budget_ms = budget_ms_};
    level_ = level;
    rose_at_.reset();
    forget();
    return decision;
}

Decision Governor::start(const SeenEyes& eyes) {
    started_ = true;
    const std::size_t worst = std::min(worst_in(EyeState::Fixation), worst_in(eyes.state));
    std::size_t level = budget_ms_ > 0.0 ? cheapest(worst) : 0;
    for (std::size_t one = 0; one < level; ++one) {
        if (cost_[one] <= options_.keep_share * budget_ms_) {
            level = one;
        }
    }
    return move_to(level, Reason::Start, eyes.state);
}

std::optional<Decision> Governor::worse(const SeenEyes& eyes) {
    const double ms = recent_ms();
    const bool over = ms > budget_ms_;
    if (!over && misses_ < kMisses) {
        return std::nullopt;
    }
    const std::size_t worst = worst_in(eyes.state);
    std::size_t level = cheapest(worst);
    for (std::size_t one = level_ + 1; over && one < level; ++one) {
        if (expected_ms(one, ms) <= options_.keep_share * budget_ms_) {
            level = one;
        }
    }
    // What was kept until just now; or, now and then, one step.
    if (!over || rose_at_) {
        level = std::min(level_ + 1, worst);
    }
    if (level <= level_ || cost_[level] >= cost_[level_]) {
        if (!over || held_) {
            return std::nullopt;
        }
        held_ = true;
        return Decision{.from = level_,
                        .to = level_,
                        .reason = Reason::Held,
                        .state = eyes.state,
                        .ms = ms,
                        .budget_ms = budget_ms_};
    }
    if (rose_at_) {
        caution_[level_] = std::min(2 * caution_[level_], kMostCaution);
    }
    return move_to(level, over ? Reason::OverBudget : Reason::NowAndThen, eyes.state);
}

std::optional<Decision> Governor::better(const SeenEyes& eyes) {
    if (level_ == 0 || roomy_windows_ < caution_[level_ - 1] || eyes.state == EyeState::Lost) {
        return std::nullopt;
    }
    if (eyes.state == EyeState::Fixation && eyes.events_known &&
        ++waited_ < options_.patience_frames) {
        return std::nullopt;
    }
    const Decision decision = move_to(level_ - 1, Reason::Room, eyes.state);
    rose_at_ = frame_;
    return decision;
}

std::optional<Decision> Governor::next(const SeenEyes& eyes, double budget_ms) {
    ++frame_;
    budget_ms_ = is_time(budget_ms) ? budget_ms : 0.0;
    if (!started_) {
        return start(eyes);
    }
    if (rose_at_ && frame_ - *rose_at_ >= kProvenWindows * options_.settle_frames) {
        rose_at_.reset();
        caution_[level_] = 1;
    }
    if (level_ > worst_in(eyes.state)) {
        return move_to(cheapest(worst_in(eyes.state)), Reason::Floor, eyes.state);
    }
    if (budget_ms_ == 0.0) {
        return std::nullopt;
    }
    if (auto decided = worse(eyes)) {
        return decided;
    }
    return better(eyes);
}

}  // namespace gazeloop::governor
