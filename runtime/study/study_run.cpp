#include "runtime/study/study_run.h"

#include <fmt/core.h>
#include <fmt/ranges.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <chrono>
#include <cmath>

#include "runtime/study/drawn_gaze.h"

namespace gazeloop::study {
namespace {

constexpr std::array<std::string_view, 6> kScreenNames{"black", "picture", "question",
                                                       "rest",  "away",    "over"};

void add_conditions(const Plan& plan, const Trial& trial, bool of_method, Stimulus& stimulus) {
    stimulus.settings = plan.settings;
    for (std::size_t at = 1; at < trial.levels.size(); ++at) {
        const std::string& key = plan.factors[at].key;
        if (!key.empty() && (of_method || is_of_all_methods(key))) {
            stimulus.settings.emplace_back(plan.factors[at].key,
                                           plan.factors[at].value_of(trial.levels[at]));
        }
    }
}

}  // namespace

Stimulus reference_stimulus(const Plan& plan, const Trial& trial) {
    Stimulus stimulus{.method = plan.reference_method};
    if (plan.reference_method == plan.method) {
        const std::vector<double>& levels = plan.factors.front().levels;
        return test_stimulus(plan, trial, plan.higher_is_better ? levels.back() : levels.front());
    }
    add_conditions(plan, trial, false, stimulus);
    return stimulus;
}

Stimulus test_stimulus(const Plan& plan, const Trial& trial, double level) {
    Stimulus stimulus{.method = plan.method};
    add_conditions(plan, trial, true, stimulus);
    stimulus.settings.emplace_back(plan.factors.front().key, plan.factors.front().value_of(level));
    return stimulus;
}

StudyRun::StudyRun(const Plan& plan, TrialQueue& queue, unsigned subject, SubjectInput& input,
                   Say say)
    : plan_(plan),
      queue_(queue),
      subject_(subject),
      input_(input),
      say_(std::move(say)),
      clock_(plan, queue, subject) {}

std::vector<Stimulus> StudyRun::samples() const {
    std::vector<Stimulus> samples;
    const auto add = [&samples](Stimulus stimulus) {
        const bool known = std::ranges::any_of(samples, [&](const Stimulus& one) {
            return one.method == stimulus.method && one.scene() == stimulus.scene();
        });
        if (!known) {
            samples.push_back(std::move(stimulus));
        }
    };
    for (std::size_t condition = 0; condition < plan_.conditions(); ++condition) {
        const Trial trial{.levels = plan_.levels_of(condition)};
        add(reference_stimulus(plan_, trial));
        add(test_stimulus(plan_, trial, trial.levels.front()));
    }
    return samples;
}

Stimulus StudyRun::stimulus_of(const Shown& shown) const {
    const Trial& trial = *queue_.next();
    return shown.reference ? reference_stimulus(plan_, trial)
                           : test_stimulus(plan_, trial, shown.level);
}

render::FrameRenderer* StudyRun::choose(const render::FrameToChoose& frame) {
    cannot_keep_ = cannot_keep_ || (recorder_ != nullptr && recorder_->in_trouble());
    clock_.wear(frame.shown_ns, frame.should_render);
    (void)clock_.at(frame.shown_ns);
    take_presses(frame.shown_ns);
    take_responses(frame.index);
    const Shown shown = clock_.at(frame.shown_ns);
    const bool picture = shown.screen == Screen::Picture;
    const Stimulus stimulus = picture ? stimulus_of(shown) : Stimulus{};
    const std::optional<unsigned> trial =
        queue_.next() != nullptr ? std::optional(queue_.next()->number) : std::nullopt;
    begin_picture(shown, trial, frame.shown_ns);
    if (shown != last_ || trial != last_trial_ || stimulus != last_stimulus_) {
        record_shown(frame.index, shown, stimulus);
        if (shown.screen == Screen::Black && trial != last_trial_) {
            make_ready();
        }
        last_ = shown;
        last_trial_ = trial;
        last_stimulus_ = stimulus;
    }
    return picture && frame.should_render ? &stimuli_->of(stimulus) : nullptr;
}

/// A slider's pictures are one, whose quality changes.
void StudyRun::begin_picture(const Shown& shown, std::optional<unsigned> trial,
                             std::int64_t now_ns) {
    if (!last_ || shown.screen != last_->screen || shown.part != last_->part ||
        trial != last_trial_ || clock_.all_restarts() != last_restarts_) {
        picture_since_ns_ = now_ns;
        last_restarts_ = clock_.all_restarts();
    }
    picture_s_ = static_cast<double>(now_ns - picture_since_ns_) * 1e-9;
}

void StudyRun::make_ready() {
    const Trial& trial = *queue_.next();
    (void)stimuli_->of(reference_stimulus(plan_, trial));
    if (trial.kind != TrialKind::Validation && !std::isnan(trial.levels.front())) {
        (void)stimuli_->of(test_stimulus(plan_, trial, trial.levels.front()));
    }
}

void StudyRun::take_presses(std::int64_t now_ns) {
    const Shown shown = clock_.at(now_ns);
    for (const Press press : input_.presses(now_ns, shown, queue_.next(),
                                            queue_.next() != nullptr ? queue_.attempt() : 0)) {
        if (const auto pressed = clock_.press(now_ns, press); !pressed) {
            say_(fmt::format("'{}' was not taken: {}", kPressNames[static_cast<std::size_t>(press)],
                             pressed.error().message));
        }
    }
}

void StudyRun::take_responses(std::uint64_t frame) {
    for (const Response& response : clock_.take_responses()) {
        if (!keep(response, frame)) {
            lost_ = cannot_keep_ = true;
            say_(
                fmt::format("the answer to trial {} could not be written: the next study run asks "
                            "for it again",
                            response.trial.number));
            return;
        }
        ++answers_;
        tell(response);
    }
}

/// Waits for the disk, while the display is black: what has been answered survives the program.
bool StudyRun::keep(const Response& response, std::uint64_t frame) {
    constexpr std::chrono::seconds kPatience(10);
    if (recorder_ == nullptr) {
        return true;
    }
    using Text = FixedText<120>;
    const Trial& trial = response.trial;
    recorder_->add(session::ResponseRecord{
        .frame = frame,
        .subject = response.subject,
        .trial = trial.number,
        .attempt = response.attempt,
        .session = trial.session,
        .kind = Text(kTrialKindNames[static_cast<std::size_t>(trial.kind)]),
        .reference_first = trial.reference_first,
        .levels = Text(fmt::format("{}", fmt::join(trial.levels, ","))),
        .answer = Text(kAnswerNames[static_cast<std::size_t>(response.answer)]),
        .after_s = response.after_s,
        .settled = response.settled,
        .fault = Text(kTrialFaultNames[static_cast<std::size_t>(response.fault)])});
    return recorder_->wait_until_written(kPatience);
}

void StudyRun::tell(const Response& response) const {
    spdlog::info("trial {}: {}, {} left", response.trial.number,
                 kAnswerNames[static_cast<std::size_t>(response.answer)], queue_.left());
    if (!response.valid()) {
        say_(fmt::format("trial {} does not count ({}): {}", response.trial.number,
                         kTrialFaultNames[static_cast<std::size_t>(response.fault)],
                         response.attempt + 1 < plan_.gaze.most_attempts
                             ? "it is shown again later"
                             : "it was shown as often as the plan has it, and is given up"));
    }
    if (clock_.rest() != Rest::None) {
        say_(fmt::format("{}: rest for {:g} s, then 'go on'; {} trials are left",
                         clock_.rest() == Rest::SessionOver ? "a session is over"
                                                            : "two equal pictures looked different",
                         plan_.rest_s, queue_.left()));
    }
}

void StudyRun::record_shown(std::uint64_t frame, const Shown& shown, const Stimulus& stimulus) {
    if (recorder_ == nullptr) {
        return;
    }
    using Text = FixedText<240>;
    const Trial* const trial = queue_.next();
    recorder_->add(
        session::TrialRecord{.first_frame = frame,
                             .subject = subject_,
                             .trial = trial != nullptr ? trial->number : 0,
                             .attempt = trial != nullptr ? queue_.attempt() : 0,
                             .part = shown.part,
                             .screen = Text(kScreenNames[static_cast<std::size_t>(shown.screen)]),
                             .follows_gaze = plan_.gaze.follow,
                             .method = Text(stimulus.method),
                             .settings = Text(stimulus.settings_text())});
}

gaze::FrameFovea StudyRun::drawn(const gaze::FrameFovea& latched,
                                 const gaze::StereoView& views) const {
    return plan_.gaze.follow ? latched : straight_ahead(latched, views);
}

void StudyRun::on_frame(const frame::FrameRecord& record) {
    const bool tracked = std::ranges::any_of(record.fovea.eyes, [](const gaze::FoveaPoint& point) {
        return point.state == gaze::FoveaState::Tracking ||
               point.state == gaze::FoveaState::OtherEye;
    });
    const Eyes eyes = !tracked ? Eyes::Lost
                      : off_ahead_deg(record.fovea, record.views) > plan_.gaze.target_deg
                          ? Eyes::Off
                          : Eyes::OnTarget;
    clock_.watch(
        record.stamps.display.known() ? record.stamps.display.ns : record.stamps.end_frame.ns,
        eyes);
}

}  // namespace gazeloop::study
