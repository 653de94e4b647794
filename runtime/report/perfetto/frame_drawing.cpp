#include "runtime/report/perfetto/frame_drawing.h"

#include <algorithm>
#include <span>
#include <utility>

#include "runtime/time/milliseconds.h"

namespace gazeloop::report::perfetto {
namespace {

time::Stamp later(const time::Stamp& stamp, std::optional<std::int64_t> ns, time::StampKind kind) {
    return {time::saturated(static_cast<__int128>(stamp.ns) + ns.value_or(0)),
            ns ? time::weaker(stamp.kind, kind) : stamp.kind};
}

time::Stamp by_profile(const time::Stamp& stamp, std::optional<std::int64_t> ns) {
    return later(stamp, ns, time::StampKind::Profile);
}

}  // namespace

FrameDrawing::FrameDrawing(TraceWriter& writer, Drawing& drawing, latency::SummaryConfig config)
    : drawing_(drawing),
      config_(std::move(config)),
      names_{.tracker = writer.name("tracker"),
             .delivery = writer.name("delivery"),
             .queue = writer.name("queue"),
             .frame = writer.name("frame"),
             .not_rendered = writer.name("frame, not rendered"),
             .begin = writer.name("begin"),
             .latch = writer.name("latch"),
             .filter = writer.name("filter"),
             .submit = writer.name("submit"),
             .end_frame = writer.name("end_frame"),
             .gpu = writer.name("gpu"),
             .present = writer.name("present"),
             .display = writer.name("display"),
             .scan_out = writer.name("scan-out"),
             .light = writer.name("light"),
             .switching = writer.name("switching"),
             .photon = writer.name("photon")},
      keys_{.number = writer.key("frame"),
            .sequence = writer.key("sequence"),
            .reused = writer.key("reused"),
            .clock_deviation_ns = writer.key("clock_deviation_ns"),
            .gaze_age_ms = writer.key("gaze_age_ms"),
            .periods_missed = writer.key("periods_missed")} {
    for (const std::string& pass : config_.passes.names()) {
        passes_.push_back(writer.name(pass));
    }
}

void FrameDrawing::draw(const latency::FinishedFrame& finished) {
    const frame::FrameRecord& record = finished.frame;
    draw_interval(record);
    if (record.should_render) {
        draw_rendered(finished);
    } else {
        draw_not_rendered(record);
    }
    drawing_.write();
}

void FrameDrawing::draw_rendered(const latency::FinishedFrame& finished) {
    const frame::FrameRecord& record = finished.frame;
    const DisplayTimes display = display_times(record);
    const latency::FrameAccount account = latency::account_of(
        finished, config_.period_ns,
        {.switching_ns = display.switching_ns, .rolling_ns = display.rolling_ns});
    Hops hops;
    if (account.with_gaze()) {
        hops = draw_gaze(record);
    }
    const auto latch = draw_loop(record);
    const auto gpu = draw_gpu(finished, account.stamps);
    draw_runtime(account.stamps, account.shown.at);
    const auto photon = draw_display(record, account, display);
    drawing_.counter(Subject::Shaded, record.stamps.wake_up,
                     static_cast<double>(record.samples.shaded()));
    drawing_.connect(record.index + 1, std::array{hops.sample, hops.queue, latch, gpu, photon});
}

FrameDrawing::DisplayTimes FrameDrawing::display_times(const frame::FrameRecord& record) const {
    if (!latency::may_be_of_period(record.period_ns, config_.period_ns)) {
        return {};
    }
    return {.switching_ns = config_.switching_ns,
            .rolling_ns = config_.rolling_ns,
            .persistence_ns = config_.persistence_ns};
}

void FrameDrawing::draw_interval(const frame::FrameRecord& record) {
    const auto before = std::exchange(before_, Neighbour{record.index, record.stamps.wake_up});
    if (!before || before->index + 1 != record.index) {
        return;
    }
    const time::Span interval = time::between(before->wake_up, record.stamps.wake_up);
    if (interval.known()) {
        drawing_.counter(Subject::Interval, record.stamps.wake_up,
                         static_cast<double>(interval.ns) / time::kNsPerMs);
    }
}

void FrameDrawing::draw_not_rendered(const frame::FrameRecord& record) {
    const frame::FrameStamps& stamps = record.stamps;
    const std::array parts{Part{names_.begin, stamps.wake_up, stamps.begin}};
    const auto drawn = drawing_.nested(
        Subject::Loop, {names_.not_rendered, stamps.wake_up, stamps.end_frame}, parts);
    drawing_.annotate(drawn.whole, keys_.number, record.index);
}

FrameDrawing::Hops FrameDrawing::draw_gaze(const frame::FrameRecord& record) {
    Hops hops;
    const auto sample_of = [&record](std::size_t eye) {
        const gaze::FoveaPoint& fovea = record.fovea.eyes[eye];
        return RestedOn{fovea.sample_sequence, fovea.sampled};
    };
    const std::size_t older = gaze::index(latency::older_eye(record.fovea));
    for (std::size_t eye = 0; eye < rested_on_.size(); ++eye) {
        const bool of_left_eye = eye == 1 && sample_of(1) == sample_of(0);
        if (!of_left_eye && !rested_on(sample_of(eye))) {
            const auto place = draw_sample(record.fovea.eyes[eye]);
            hops.sample = sample_of(eye) == sample_of(older) ? place : hops.sample;
        }
    }
    const gaze::FoveaPoint& fovea = record.fovea.eyes[older];
    hops.queue = drawing_.slice(Subject::Gaze, {names_.queue, fovea.arrived, record.stamps.latch});
    drawing_.annotate(hops.queue, keys_.sequence, fovea.sample_sequence);
    if (rested_on(sample_of(older))) {
        drawing_.annotate(hops.queue, keys_.reused, std::uint64_t{1});
    }
    rested_on_ = {sample_of(0), sample_of(1)};
    return hops;
}

bool FrameDrawing::rested_on(const RestedOn& sample) const {
    return std::ranges::find(rested_on_, std::optional(sample)) != rested_on_.end();
}

std::optional<Drawing::Place> FrameDrawing::draw_sample(const gaze::FoveaPoint& fovea) {
    ++samples_used_;
    const time::Stamp& until = fovea.ready.known() ? fovea.ready : fovea.arrived;
    const auto place = drawing_.slice(Subject::Tracker, {names_.tracker, fovea.sampled, until});
    drawing_.annotate(place, keys_.sequence, fovea.sample_sequence);
    if (fovea.ready.known()) {
        drawing_.slice(Subject::Tracker, {names_.delivery, fovea.ready, fovea.arrived});
    }
    return place;
}

std::optional<Drawing::Place> FrameDrawing::draw_loop(const frame::FrameRecord& record) {
    const frame::FrameStamps& stamps = record.stamps;
    std::array<Part, 5> parts{Part{names_.begin, stamps.wake_up, stamps.begin},
                              Part{names_.latch, stamps.begin, stamps.latch}};
    constexpr std::size_t kAtLatch = 2;
    std::size_t count = kAtLatch;
    // Where nobody stamped when the foveae were computed, that time is the submit's, as in
    // latency::Stage.
    if (stamps.filtered.known()) {
        parts[count++] = {names_.filter, stamps.latch, stamps.filtered};
    }
    parts[count++] = {names_.submit, stamps.filtered.known() ? stamps.filtered : stamps.latch,
                      stamps.submit};
    parts[count++] = {names_.end_frame, stamps.submit, stamps.end_frame};
    const auto drawn =
        drawing_.nested(Subject::Loop, {names_.frame, stamps.wake_up, stamps.end_frame},
                        std::span(parts).first(count));
    drawing_.annotate(drawn.whole, keys_.number, record.index);
    return drawn.parts[kAtLatch];
}

std::optional<Drawing::Place> FrameDrawing::draw_gpu(const latency::FinishedFrame& finished,
                                                     const frame::FrameStamps& stamps) {
    std::array<Part, frame::kMostPasses> parts;
    std::size_t count = 0;
    // The frame's own, modelled times of the GPU are of another time line than its passes.
    if (finished.gpu && finished.gpu->gpu_begin.known() &&
        finished.gpu->gpu_begin == stamps.gpu_begin) {
        for (std::size_t pass = 0; pass < passes_.size(); ++pass) {
            const auto start_ns = finished.gpu->pass_starts[pass];
            const auto took_ns = finished.gpu->passes[pass];
            if (start_ns && took_ns) {
                const time::Stamp from = later(stamps.gpu_begin, start_ns, stamps.gpu_begin.kind);
                parts[count++] = {passes_[pass], from, later(from, took_ns, from.kind)};
            }
        }
    }
    const auto ran = std::span(parts).first(count);
    std::ranges::stable_sort(ran, {}, [](const Part& part) { return part.from.ns; });
    const auto drawn =
        drawing_.nested(Subject::Gpu, {names_.gpu, stamps.gpu_begin, stamps.gpu_end}, ran);
    drawing_.annotate(drawn.whole, keys_.number, finished.frame.index);
    if (finished.gpu && finished.gpu->clock_deviation_ns && *finished.gpu->clock_deviation_ns > 0) {
        drawing_.annotate(drawn.whole, keys_.clock_deviation_ns,
                          static_cast<std::uint64_t>(*finished.gpu->clock_deviation_ns));
    }
    // A method may draw before the gaze is read: the arrow then goes to the first pass after it.
    if (stamps.gpu_begin.known() && stamps.gpu_begin.ns >= stamps.latch.ns) {
        return drawn.whole;
    }
    const auto after = std::ranges::find_if(
        ran, [&stamps](const Part& part) { return part.from.ns >= stamps.latch.ns; });
    return after == ran.end() ? std::nullopt
                              : drawn.parts[static_cast<std::size_t>(after - ran.begin())];
}

void FrameDrawing::draw_runtime(const frame::FrameStamps& stamps, const time::Stamp& shown) {
    drawing_.slice(Subject::Runtime, {names_.present, stamps.end_frame, stamps.present});
    drawing_.slice(
        Subject::Runtime,
        {names_.display, stamps.present.known() ? stamps.present : stamps.end_frame, shown});
}

std::optional<Drawing::Place> FrameDrawing::draw_display(const frame::FrameRecord& record,
                                                         const latency::FrameAccount& account,
                                                         const DisplayTimes& display) {
    const time::Stamp& shown = account.shown.at;
    const std::size_t eye = gaze::index(latency::older_eye(record.fovea));
    const time::Stamp row = by_profile(
        shown, latency::row_delay_ns(display.rolling_ns, record.fovea.eyes[eye].position.y_px,
                                     record.views[eye].height_px));
    const time::Stamp photon = by_profile(row, display.switching_ns);
    if (shown.known()) {
        draw_around(Subject::ScanOut, names_.scan_out, shown, display.rolling_ns);
        draw_around(Subject::Light, names_.light, row, display.persistence_ns);
        if (display.switching_ns.value_or(0) > 0) {
            drawing_.slice(Subject::Switching, {names_.switching, row, photon});
        }
    }
    const auto place = drawing_.instant(Subject::Photon, names_.photon, photon);
    drawing_.annotate(place, keys_.number, record.index);
    if (account.shown.periods_missed > 0) {
        drawing_.annotate(place, keys_.periods_missed, account.shown.periods_missed);
    }
    if (account.age.at_display.known()) {
        const double age_ms = static_cast<double>(account.age.at_display.ns) / time::kNsPerMs;
        drawing_.annotate(place, keys_.gaze_age_ms, age_ms);
        drawing_.counter(Subject::GazeAge, photon, age_ms);
    }
    return place;
}

void FrameDrawing::draw_around(Subject subject, NameId name, const time::Stamp& middle,
                               std::optional<std::int64_t> length_ns) {
    if (length_ns.value_or(0) > 0) {
        const time::Stamp from = by_profile(middle, -*length_ns / 2);
        drawing_.slice(subject, {name, from, by_profile(from, length_ns)});
    }
}

}  // namespace gazeloop::report::perfetto
