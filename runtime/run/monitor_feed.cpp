#include "runtime/run/monitor_feed.h"

#include "runtime/time/clock.h"

namespace gazeloop::run {

MonitorFeed::MonitorFeed(const Options& options)
    : options_(options), monitor_(options.budget, options.window_ns) {}

void MonitorFeed::on_frame(const frame::FrameRecord& record) {
    if (record.period_ns > 0) {
        periods_.add(record.period_ns);
    }
    if (record.should_render) {
        pending_.add(record,
                     [this](const latency::FinishedFrame& finished) { complete(finished); });
    }
}

void MonitorFeed::on_gpu(const frame::FrameGpuRecord& record) {
    pending_.add(record, [this](const latency::FinishedFrame& finished) { complete(finished); });
}

void MonitorFeed::on_event(time::Stamp time, std::string_view kind, std::string_view text) {
    if (options_.output != nullptr && frame::weight_of(kind) != frame::EventWeight::Routine) {
        options_.output->add(MonitorEvent{time, FixedText<32>(kind), FixedText<240>(text)});
    }
}

void MonitorFeed::complete(const latency::FinishedFrame& finished) {
    const std::int64_t period_ns = periods_.ns().value_or(options_.display.period_ns);
    const bool profiles_display = latency::may_be_of_period(period_ns, options_.display.period_ns);
    const latency::PhotonTimes photons =
        profiles_display ? latency::PhotonTimes{.switching_ns = options_.display.switching_ns,
                                                .rolling_ns = options_.display.rolling_ns}
                         : latency::PhotonTimes{};
    const latency::FrameAccount account = latency::account_of(finished, period_ns, photons);
    monitor_.add(account, finished.frame.index, period_ns,
                 [this](const latency::BudgetEvent& event) { report(event); });
    if (options_.output != nullptr) {
        publish(account.stamps.wake_up);
    }
}

void MonitorFeed::report(const latency::BudgetEvent& event) {
    const FixedText<240> text = latency::text_of(event, options_.budget->name);
    on_event(event.time, event.kind().name, text.view());
    for (frame::FrameObserver* const observer : others_) {
        observer->on_event(event.time, event.kind().name, text.view());
    }
}

void MonitorFeed::publish(const time::Stamp& time) {
    constexpr std::int64_t kBetweenPictures_ns = 100'000'000;
    using What = MonitorMessage::What;
    last_line_ns_ = last_line_ns_.value_or(time.ns);
    if (time::between({*last_line_ns_, time.kind}, time).ns >= options_.interval_ns) {
        last_line_ns_ = time.ns;
        options_.output->add(MonitorMessage{What::Interval, monitor_.snapshot()});
        return;
    }
    const std::int64_t now_ns = time::monotonic_ns();
    if (now_ns - last_picture_ns_ >= kBetweenPictures_ns) {
        last_picture_ns_ = now_ns;
        options_.output->add(MonitorMessage{What::Picture, monitor_.snapshot()});
    }
}

latency::MonitorSnapshot MonitorFeed::finish() {
    pending_.finish([this](const latency::FinishedFrame& finished) { complete(finished); });
    const latency::MonitorSnapshot last = monitor_.snapshot();
    if (options_.output != nullptr) {
        options_.output->add(MonitorMessage{MonitorMessage::What::End, last});
    }
    return last;
}

}  // namespace gazeloop::run
