#include "runtime/report/frame_log.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <glm/trigonometric.hpp>
#include <limits>
#include <string>
#include <utility>

#include "runtime/report/row_names.h"

namespace gazeloop::report {
namespace {

constexpr std::uint8_t kNotRendered = std::numeric_limits<std::uint8_t>::max();
constexpr double kMicrodegrees = 1e6;

DurationColumn of(const RowName& name, Unit unit = Unit::Nanoseconds) {
    return {name.key, name.label, unit};
}

std::optional<std::int64_t> known_ns(const time::Stamp& stamp) {
    return stamp.known() ? std::optional(stamp.ns) : std::nullopt;
}

time::Span counted(std::uint64_t count) {
    return {time::saturated(count), time::StampKind::Measured};
}

time::Span angle(const std::optional<double>& radians, time::StampKind kind) {
    return radians ? time::Span{std::llround(glm::degrees(*radians) * kMicrodegrees), kind}
                   : time::Span{};
}

}  // namespace

FrameLog::AtDisplay::AtDisplay()
    : gaze_age(of(kGazeAgeAtDisplay)),
      unaccounted(of(kUnaccounted)),
      held_gaze_age(of(kHeldGazeAge)) {}

void FrameLog::AtDisplay::add(const latency::FrameAccount& account) {
    if (account.with_gaze()) {
        gaze_age.add(account.age.at_display);
        unaccounted.add(account.age.unaccounted);
        held_gaze_age.skip();
    } else {
        gaze_age.skip();
        unaccounted.skip();
        held_gaze_age.add(account.age.at_display);
    }
}

void FrameLog::AtDisplay::skip() {
    gaze_age.skip();
    unaccounted.skip();
    held_gaze_age.skip();
}

FrameLog::FrameLog(const latency::SummaryConfig& config)
    : config_(config),
      at_latch_(of(kGazeAgeAtLatch)),
      read_at_begin_(of(kGazeAgeReadAtBegin)),
      uncertainty_(of(kGazeAgeUncertainty)),
      frame_interval_(of(kFrameInterval)),
      loop_time_(of(kLoopTime)),
      error_(of(kGazeError, Unit::Microdegrees)),
      error_without_poses_(of(kGazeErrorWithoutPoses, Unit::Microdegrees)),
      periods_missed_(of(kPeriodsMissed, Unit::Count)),
      samples_shaded_(of(kSamplesShaded, Unit::Count)) {
    for (std::size_t stage = 0; stage < latency::kStageCount; ++stage) {
        stages_.push_back(of(stage_name(stage)));
    }
    for (const std::string& pass : config.passes.names()) {
        passes_.push_back(of(pass_name(pass)));
    }
}

void FrameLog::on_sample(const gaze::GazeSample& sample, std::uint64_t) {
    complete_last();
    gaze_errors_.add(sample);
}

void FrameLog::on_origin(const gaze::OriginChange& change) {
    complete_last();
    gaze_errors_.move_origin(change.new_in_old);
}

void FrameLog::on_frame(const frame::FrameRecord& record) {
    complete_last();
    if (record.period_ns > 0) {
        periods_.add(record.period_ns);
    }
    last_.emplace(latency::FinishedFrame{.frame = record, .gpu = std::nullopt});
}

void FrameLog::on_gpu(const frame::FrameGpuRecord& record) {
    if (last_ && last_->frame.index == record.index) {
        last_->gpu = record;
    }
}

void FrameLog::on_gaze(const frame::FrameGaze& gaze) { last_gaze_ = gaze; }

void FrameLog::finish() {
    complete_last();
    gaze_errors_.finish();
    take_errors();
    skip_errors();
    gather_columns();
}

void FrameLog::complete_last() {
    if (!last_) {
        return;
    }
    const frame::FrameRecord& record = last_->frame;
    const frame::FrameStamps& stamps = record.stamps;
    numbers_.add(std::bit_cast<std::int64_t>(record.index));
    wake_up_.add(known_ns(stamps.wake_up));
    if (before_ && before_->index + 1 == record.index) {
        frame_interval_.add(time::between(before_->wake_up, stamps.wake_up));
    } else {
        frame_interval_.skip();
    }
    before_ = {record.index, stamps.wake_up};
    loop_time_.add(time::between(stamps.wake_up, stamps.end_frame));
    if (record.should_render) {
        add_rendered(*last_);
    } else {
        skip_rendered();
    }
    take_errors();
    last_.reset();
    last_gaze_.reset();
}

void FrameLog::add_rendered(const latency::FinishedFrame& finished) {
    const std::int64_t period_ns = periods_.ns().value_or(config_.period_ns);
    const latency::FrameAccount account = latency::account_of(
        finished, period_ns,
        {.switching_ns = config_.switching_ns, .rolling_ns = config_.rolling_ns});
    states_.push_back(static_cast<std::uint8_t>(account.state));
    shown_.add(known_ns(account.shown.at));
    if (account.state == gaze::FoveaState::Ahead) {
        of_profile_.skip();
        of_unknown_.skip();
    } else {
        of_profile_.add(account);
        of_unknown_.add(latency::account_of(finished, period_ns, {}));
    }
    add_gaze(account);
    if (last_gaze_) {
        add_error(last_gaze_->error);
    } else {
        gaze_errors_.add(finished.frame);
        gaze_errors_.set_shown(finished.frame.index, account.shown.at);
    }
    if (account.shown.in_time_known) {
        periods_missed_.add(counted(account.shown.periods_missed));
    } else {
        periods_missed_.add({});
    }
    samples_shaded_.add(counted(finished.frame.samples.shaded()));
    for (std::size_t pass = 0; pass < passes_.size(); ++pass) {
        const auto ns = finished.gpu ? finished.gpu->passes[pass] : std::nullopt;
        if (ns) {
            passes_[pass].add({*ns, time::StampKind::Measured});
        } else {
            passes_[pass].skip();
        }
    }
}

void FrameLog::add_gaze(const latency::FrameAccount& account) {
    if (!account.with_gaze()) {
        at_latch_.skip();
        read_at_begin_.skip();
        uncertainty_.skip();
        std::ranges::for_each(stages_, &DurationColumn::skip);
        return;
    }
    at_latch_.add(account.age.at_latch);
    read_at_begin_.add(account.age.read_at_begin);
    uncertainty_.add(account.age.uncertainty);
    for (std::size_t stage = 0; stage < stages_.size(); ++stage) {
        stages_[stage].add(account.age.stages[stage]);
    }
}

void FrameLog::skip_rendered() {
    states_.push_back(kNotRendered);
    shown_.add(std::nullopt);
    of_profile_.skip();
    of_unknown_.skip();
    add_gaze({});
    periods_missed_.skip();
    samples_shaded_.skip();
    std::ranges::for_each(passes_, &DurationColumn::skip);
}

void FrameLog::take_errors() {
    gaze_errors_.take_decided(
        [this](std::uint64_t, const std::optional<frame::GazeError>& error) { add_error(error); });
}

/// Of frames that were not rendered, up to the next one whose error is still to come.
void FrameLog::skip_errors() {
    while (error_.size() < states_.size() && states_[error_.size()] == kNotRendered) {
        error_.skip();
        error_without_poses_.skip();
    }
}

void FrameLog::add_error(const std::optional<frame::GazeError>& error) {
    skip_errors();
    if (!error) {
        error_.skip();
        error_without_poses_.skip();
        return;
    }
    error_.add(angle(error->radians, error->kind));
    error_without_poses_.add(angle(error->without_poses_radians, error->kind));
    if (error->gap != frame::GazeErrorGap::None) {
        ++gaps_[static_cast<std::size_t>(error->gap)];
    }
}

void FrameLog::gather_columns() {
    const bool profiles_display =
        latency::may_be_of_period(periods_.ns().value_or(config_.period_ns), config_.period_ns);
    if (!profiles_display) {
        for (const latency::Stage stage : {latency::Stage::Row, latency::Stage::Switching}) {
            stages_[static_cast<std::size_t>(stage)].forget();
        }
    }
    AtDisplay& at_display = profiles_display ? of_profile_ : of_unknown_;
    const auto take = [this](DurationColumn& column) { columns_.push_back(std::move(column)); };
    take(at_latch_);
    take(read_at_begin_);
    take(at_display.gaze_age);
    take(uncertainty_);
    std::ranges::for_each(stages_, take);
    take(at_display.unaccounted);
    take(at_display.held_gaze_age);
    take(frame_interval_);
    take(loop_time_);
    std::ranges::for_each(passes_, take);
    take(error_);
    take(error_without_poses_);
    take(periods_missed_);
    take(samples_shaded_);
    of_profile_ = {};
    of_unknown_ = {};
}

void FrameLog::set_eye_events(const EyeEvents& events) {
    eye_event_source_ = events.source();
    eye_events_.assign(eye_event_source_ == EyeEventSource::None ? 0 : rows(), 0);
    for (std::size_t row = 0; row < eye_events_.size(); ++row) {
        const std::optional<std::int64_t> ns = shown_ns(row);
        const auto event = ns ? events.at(*ns) : std::nullopt;
        eye_events_[row] = event ? static_cast<std::uint8_t>(*event) : 0;
    }
}

std::optional<gaze::EyeEvent> FrameLog::eye_event(std::size_t row) const {
    return eye_events_.empty() || eye_events_[row] == 0
               ? std::nullopt
               : std::optional(static_cast<gaze::EyeEvent>(eye_events_[row]));
}

std::uint64_t FrameLog::number(std::size_t row) const {
    return std::bit_cast<std::uint64_t>(*numbers_.at(row));
}

std::optional<gaze::FoveaState> FrameLog::state(std::size_t row) const {
    return states_[row] == kNotRendered
               ? std::nullopt
               : std::optional(static_cast<gaze::FoveaState>(states_[row]));
}

const DurationColumn* FrameLog::column(std::string_view key) const {
    const auto found = std::ranges::find(columns_, key, &DurationColumn::key);
    return found == columns_.end() ? nullptr : &*found;
}

std::vector<std::size_t> FrameLog::worst(std::size_t count) const {
    const DurationColumn& age = at(kGazeAgeAtDisplay.key);
    std::vector<std::pair<std::int64_t, std::size_t>> worst;  // a heap, its least in front
    const auto worse = [](const auto& a, const auto& b) {
        return a.first != b.first ? a.first > b.first : a.second < b.second;
    };
    for (std::size_t row = 0; row < rows() && count > 0; ++row) {
        const std::optional<std::int64_t> ns = age.at(row);
        if (!ns) {
            continue;
        }
        worst.emplace_back(*ns, row);
        std::ranges::push_heap(worst, worse);
        if (worst.size() > count) {
            std::ranges::pop_heap(worst, worse);
            worst.pop_back();
        }
    }
    std::ranges::sort_heap(worst, worse);
    std::vector<std::size_t> result;
    std::ranges::transform(worst, std::back_inserter(result),
                           [](const auto& one) { return one.second; });
    return result;
}

}  // namespace gazeloop::report
