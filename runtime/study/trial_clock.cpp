#include "runtime/study/trial_clock.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

namespace gazeloop::study {
namespace {

constexpr double kNsPerS = 1e9;

double seconds(std::int64_t ns) { return static_cast<double>(ns) / kNsPerS; }

Answer answer_of(Press press) {
    switch (press) {
        case Press::Different:
            return Answer::Different;
        case Press::First:
            return Answer::FirstBetter;
        case Press::Second:
            return Answer::SecondBetter;
        case Press::Up:
            return Answer::Up;
        case Press::Down:
            return Answer::Down;
        case Press::Done:
            return Answer::Equal;
        case Press::Unable:
            return Answer::Unable;
        default:
            return Answer::Same;
    }
}

}  // namespace

TrialClock::TrialClock(const Plan& plan, TrialQueue& queue, unsigned subject)
    : plan_(&plan), queue_(&queue), subject_(subject) {}

std::vector<Press> TrialClock::presses(Design design) {
    switch (design) {
        case Design::SameDifferent:
        case Design::Quest:
            return {Press::Same, Press::Different};
        case Design::Pair:
            return {Press::First, Press::Second, Press::Same};
        case Design::Ramp:
            return {Press::Up, Press::Down, Press::Same};
        case Design::Slider:
            return {Press::Raise, Press::Lower, Press::Reference, Press::Done, Press::Unable};
    }
    return {};
}

void TrialClock::add_part(Screen screen, double length_s, bool reference, double level) {
    if (const std::int64_t length_ns = std::llround(length_s * kNsPerS); length_ns > 0) {
        parts_.push_back(
            {.screen = screen, .reference = reference, .level = level, .length_ns = length_ns});
    }
}

void TrialClock::add_picture(bool reference, double level) {
    add_part(Screen::Black, plan_->black_s);
    add_part(Screen::Picture, plan_->shown_s, reference, level);
}

void TrialClock::begin_trial(std::int64_t now_ns) {
    const Trial& trial = *queue_->next();
    const bool validation = trial.kind == TrialKind::Validation;
    const double level = validation ? 0.0 : trial.levels.front();
    parts_.clear();
    part_ = 0;
    part_since_ns_ = now_ns;
    stretch_ns_ = longest_off_ns_ = longest_lost_ns_ = 0;
    first_stop_.reset();
    slider_step_ = 0;
    slider_reference_ = false;
    begun_ = true;
    switch (plan_->design) {
        case Design::SameDifferent:
        case Design::Pair:
        case Design::Quest:
            add_picture(validation || trial.reference_first, level);
            add_picture(validation || !trial.reference_first, level);
            break;
        case Design::Ramp: {
            const std::vector<double>& levels = plan_->factors.front().levels;
            const double best = plan_->higher_is_better ? levels.back() : levels.front();
            const double end = validation ? best : level;
            for (unsigned step = 0; step < plan_->steps; ++step) {
                const double share = static_cast<double>(step) / (plan_->steps - 1);
                const double at = trial.reference_first ? share : 1.0 - share;
                add_picture(false, best + (end - best) * at);
            }
            break;
        }
        case Design::Slider:
            add_picture(true, 0.0);
            break;
    }
}

void TrialClock::begin_again(std::int64_t now_ns) {
    ++restarts_;
    ++all_restarts_;
    begin_trial(now_ns);
}

void TrialClock::count_eyes(std::int64_t from_ns, std::int64_t to_ns) {
    const bool picture = part_ < parts_.size() ? parts_[part_].screen == Screen::Picture
                                               : plan_->design == Design::Slider;
    if (!begun_ || !picture) {
        return;
    }
    stretch_ns_ += to_ns - from_ns;
    if (eyes_ == Eyes::Lost) {
        longest_lost_ns_ = std::max(longest_lost_ns_, stretch_ns_);
    } else if (eyes_ == Eyes::Off) {
        longest_off_ns_ = std::max(longest_off_ns_, stretch_ns_);
    }
}

void TrialClock::advance(std::int64_t now_ns) {
    if (!any_time_) {
        any_time_ = true;
        now_ns_ = now_ns;
    }
    now_ns = std::max(now_ns, now_ns_);
    if (!worn_ || rest_ != Rest::None || queue_->next() == nullptr) {
        now_ns_ = now_ns;
        return;
    }
    if (!begun_) {
        begin_trial(now_ns);
    }
    while (part_ < parts_.size()) {
        const Part& part = parts_[part_];
        const std::int64_t end_ns = part_since_ns_ + part.length_ns;
        if (now_ns < end_ns) {
            break;
        }
        if (part.screen == Screen::Picture && !part.seen) {
            begin_again(now_ns);
            now_ns_ = now_ns;
            break;
        }
        count_eyes(now_ns_, end_ns);
        now_ns_ = end_ns;
        part_since_ns_ = end_ns;
        ++part_;
    }
    count_eyes(now_ns_, now_ns);
    now_ns_ = now_ns;
}

double TrialClock::slider_level() const {
    const std::vector<double>& levels = plan_->factors.front().levels;
    return plan_->higher_is_better ? levels[slider_step_]
                                   : levels[levels.size() - 1 - slider_step_];
}

Shown TrialClock::at(std::int64_t now_ns) {
    advance(now_ns);
    if (queue_->next() == nullptr) {
        return {.screen = Screen::Over};
    }
    if (!worn_) {
        return {.screen = Screen::Away};
    }
    if (rest_ != Rest::None) {
        return {.screen = Screen::Rest};
    }
    const auto number = static_cast<unsigned>(part_);
    if (part_ < parts_.size()) {
        Part& part = parts_[part_];
        part.seen = true;
        return {.screen = part.screen,
                .reference = part.reference,
                .level = part.level,
                .part = number};
    }
    if (plan_->design == Design::Slider) {
        return {.screen = Screen::Picture,
                .reference = slider_reference_,
                .level = slider_level(),
                .part = number};
    }
    return {.screen = Screen::Question, .part = number};
}

std::optional<std::int64_t> TrialClock::changes_ns() const {
    if (!worn_ || rest_ != Rest::None || !begun_ || part_ == parts_.size()) {
        return std::nullopt;
    }
    return part_since_ns_ + parts_[part_].length_ns;
}

std::optional<std::string> TrialClock::why_not(Press press) const {
    if (queue_->next() == nullptr) {
        return "the study is over";
    }
    if (!worn_) {
        return "the headset is off: put it on, the trial begins again";
    }
    if (rest_ != Rest::None) {
        const double left = plan_->rest_s - seconds(now_ns_ - rest_since_ns_);
        if (press != Press::GoOn) {
            return "it is time to rest: 'go on' ends that";
        }
        return left > 0.0 ? std::optional(fmt::format("rest for another {:.0f} s", std::ceil(left)))
                          : std::nullopt;
    }
    if (!asking()) {
        return part_ < parts_.size() && parts_[part_].screen == Screen::Black
                   ? "the screen is black and more is to be seen: wait for the question"
                   : "pictures are still being shown: wait for the question";
    }
    const std::vector<Press> allowed = presses(plan_->design);
    if (std::ranges::find(allowed, press) == allowed.end()) {
        return fmt::format("'{}' answers no question of this design",
                           kPressNames[static_cast<std::size_t>(press)]);
    }
    if (press == Press::Raise && slider_step_ + 1 == plan_->factors.front().levels.size()) {
        return "this is the best level";
    }
    if (press == Press::Lower && slider_step_ == 0) {
        return "this is the lowest level";
    }
    return std::nullopt;
}

Expected<void> TrialClock::press(std::int64_t now_ns, Press press) {
    advance(now_ns);
    if (const auto why = why_not(press)) {
        ++refused_;
        return std::unexpected(Error{ErrorKind::Usage, *why});
    }
    if (press == Press::GoOn) {
        rest_ = Rest::None;
        begun_ = false;
    } else if (plan_->design == Design::Slider && press != Press::Done && press != Press::Unable) {
        slide(press);
    } else {
        if (press == Press::Done) {
            first_stop_ = first_stop_.value_or(slider_level());
        }
        answer(answer_of(press));
    }
    return {};
}

void TrialClock::slide(Press press) {
    if (press == Press::Raise) {
        ++slider_step_;
        slider_reference_ = false;
        return;
    }
    first_stop_ = first_stop_.value_or(slider_level());
    slider_reference_ = press == Press::Reference && !slider_reference_;
    if (press == Press::Lower) {
        --slider_step_;
    }
}

TrialFault TrialClock::fault() const {
    if (seconds(longest_lost_ns_) > plan_->gaze.most_lost_s) {
        return TrialFault::GazeLost;
    }
    return !plan_->gaze.follow && seconds(longest_off_ns_) > plan_->gaze.most_off_s
               ? TrialFault::GazeOff
               : TrialFault::None;
}

void TrialClock::answer(Answer answer) {
    Response response{.subject = subject_,
                      .trial = *queue_->next(),
                      .attempt = queue_->attempt(),
                      .answer = answer,
                      .after_s = seconds(now_ns_ - part_since_ns_),
                      .fault = fault()};
    if (plan_->design == Design::Slider) {
        if (response.trial.kind != TrialKind::Validation) {
            response.trial.levels.front() = first_stop_.value_or(slider_level());
        }
        response.settled = slider_level();
    }
    rest_ = queue_->answered(response);
    rest_since_ns_ = now_ns_;
    restarts_ = 0;
    begun_ = false;
    responses_.push_back(std::move(response));
}

void TrialClock::watch(std::int64_t now_ns, Eyes eyes) {
    advance(now_ns);
    if (eyes != eyes_) {
        stretch_ns_ = 0;
    }
    eyes_ = eyes;
}

void TrialClock::wear(std::int64_t now_ns, bool worn) {
    advance(now_ns);
    if (worn_ && !worn && begun_) {
        ++restarts_;
        ++all_restarts_;
    }
    if (worn_ != worn) {
        begun_ = false;  // what was shown, and perhaps forgotten meanwhile, is shown again
    }
    worn_ = worn;
}

}  // namespace gazeloop::study
