#include "runtime/openxr_layer/seen_recorder.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <exception>
#include <glm/gtc/quaternion.hpp>
#include <utility>

#include "runtime/openxr_layer/layer_log.h"

namespace gazeloop::openxr_layer {
namespace {

using time::Stamp;
using time::StampKind;

/// With the recorder's own 50 ms well within the 100 ms that a killed program may lose.
constexpr std::chrono::milliseconds kRecordEvery{10};
/// Two seconds of a 1000 Hz tracker and a 120 Hz display, 2 MB.
constexpr std::size_t kMostSeen = 4096;

Stamp stamp(const std::optional<std::int64_t>& ns, StampKind kind = StampKind::Measured) {
    return ns ? Stamp{*ns, kind} : Stamp{};
}

/// The head that two views belong to: midway between them.
gaze::Pose head_of(const gaze::StereoView& views) {
    return {glm::slerp(views[0].pose.orientation, views[1].pose.orientation, 0.5),
            0.5 * (views[0].pose.position_m + views[1].pose.position_m)};
}

}  // namespace

Expected<std::unique_ptr<SeenRecorder>> SeenRecorder::open(const std::filesystem::path& file,
                                                           const session::SessionHeader& header,
                                                           const gaze::FoveaPolicy& policy) {
    auto recorder = session::SessionRecorder::create(file, header);
    if (!recorder) {
        return std::unexpected(std::move(recorder.error()));
    }
    try {
        return std::unique_ptr<SeenRecorder>(new SeenRecorder(file, std::move(*recorder), policy));
    } catch (const std::exception& error) {  // memory, or the thread
        return std::unexpected(
            Error{ErrorKind::BadInput,
                  fmt::format("{}: cannot be recorded: {}", file.string(), error.what())});
    }
}

SeenRecorder::SeenRecorder(std::filesystem::path file,
                           std::unique_ptr<session::SessionRecorder> recorder,
                           const gaze::FoveaPolicy& policy)
    : file_(std::move(file)), recorder_(std::move(recorder)), queue_(kMostSeen), gaze_(policy) {
    thread_.emplace(kRecordEvery, [this] { record_all(); });
}

SeenRecorder::~SeenRecorder() {
    thread_->stop();
    const session::RecordingStatus status = recorder_->close();
    if (!status.failure.empty() && !trouble_told_) {
        say(LogLevel::Warning, status.failure);
    }
    if (status.dropped > 0) {
        say(LogLevel::Warning,
            fmt::format("{}: {} records were lost: the disk or the processor was too slow",
                        file_.string(), status.dropped));
    }
}

void SeenRecorder::record_all() {
    while (const Seen* const seen = queue_.front()) {
        try {
            std::visit([this](const auto& one) { record(one); }, *seen);
        } catch (...) {  // out of memory: the program is not ours, and goes on
            lost_.fetch_add(1, std::memory_order_relaxed);
        }
        queue_.pop();
    }
    if (const std::uint64_t lost = lost_.exchange(0, std::memory_order_relaxed); lost > 0) {
        recorder_->add_lost(lost);
    }
    try {
        tell_trouble();
    } catch (...) {  // NOLINT(bugprone-empty-catch)
        // Out of memory for words: it is said at the end.
    }
}

/// Whose recording ends early hears of it while the application runs.
void SeenRecorder::tell_trouble() {
    if (!trouble_told_ && recorder_->in_trouble()) {
        trouble_told_ = true;
        say(LogLevel::Warning, recorder_->trouble());
    }
}

void SeenRecorder::record(const SeenFrame& seen) {
    frame::FrameRecord frame;
    frame.index = seen.index;
    frame.stamps.wake_up = stamp(seen.wake_up_ns);
    frame.stamps.begin = stamp(seen.begin_ns);
    frame.stamps.latch = stamp(seen.latch_ns.value_or(seen.submit_ns));
    frame.stamps.filtered = frame.stamps.latch;
    frame.stamps.submit = stamp(seen.submit_ns);
    frame.stamps.end_frame = stamp(seen.end_frame_ns);
    frame.stamps.display = stamp(seen.display_ns, StampKind::Predicted);
    frame.period_ns = seen.period_ns;
    if (seen.display_ns) {
        if (!first_display_ns_) {
            first_display_ns_ = seen.display_ns;
        }
        frame.scene_time_s = static_cast<double>(*seen.display_ns - *first_display_ns_) * 1e-9;
    }
    bool drawn = seen.views.has_value();
    if (seen.views) {
        frame.views = *seen.views;
        frame.head = head_of(*seen.views);
    }
    for (std::size_t eye = 0; eye < gaze::kEyeCount; ++eye) {
        const auto& [width_px, height_px] = seen.pictures.sizes_px[eye];
        frame.views[eye].width_px = width_px;
        frame.views[eye].height_px = height_px;
        if (seen.pictures.of_views) {
            frame.samples.pixels_output += std::uint64_t{width_px} * height_px;
        }
        drawn = drawn && gaze::is_valid(frame.views[eye]);
    }
    frame.should_render = seen.should_render && drawn;
    if (drawn) {
        frame.fovea =
            gaze_.latch(frame.stamps.latch, frame.head, frame.views, frame.stamps.display);
    } else {
        frame.fovea.latched = frame.stamps.latch;
        frame.views = {};
    }
    recorder_->add(frame);
}

void SeenRecorder::record(const SeenHead& seen) {
    head_before_ = head_;
    head_ = seen.head ? std::optional(Placed{seen.time_ns, *seen.head}) : std::nullopt;
}

void SeenRecorder::record(const ArrivedSample& seen) {
    gaze::GazeSample sample = seen.sample;
    sample.head = head_ ? std::optional(head_->head) : std::nullopt;
    if (head_ && head_before_ && head_->time_ns > head_before_->time_ns && sample.sampled.known()) {
        // Between two poses of the runtime, which are a frame apart.
        const double share =
            std::clamp(static_cast<double>(seen.time_ns - head_before_->time_ns) /
                           static_cast<double>(head_->time_ns - head_before_->time_ns),
                       0.0, 1.0);
        sample.head->orientation =
            glm::slerp(head_before_->head.orientation, head_->head.orientation, share);
        sample.head->position_m =
            glm::mix(head_before_->head.position_m, head_->head.position_m, share);
    } else if (!seen.newest) {
        sample.head.reset();
    }
    gaze_.add(sample);
    recorder_->add(sample, seen.frame);
}

void SeenRecorder::record(const CompositedFrame& seen) {
    frame::FrameGpuRecord frame;
    frame.index = seen.index;
    frame.passes.set(0, seen.gpu_ns);
    recorder_->add(frame);
}

void SeenRecorder::record(const SaidEvent& seen) {
    recorder_->event(seen.time, seen.kind.view(), seen.text.view());
}

}  // namespace gazeloop::openxr_layer
