#include "runtime/openxr_layer/frame_tap.h"

#include <algorithm>
#include <cstdlib>
#include <limits>
#include <utility>

#include "runtime/time/clock.h"
#include "runtime/time/span.h"

namespace gazeloop::openxr_layer {
namespace {

using time::Stamp;
using time::StampKind;

Stamp measured(std::int64_t ns) { return {ns, StampKind::Measured}; }

}  // namespace

Expected<std::unique_ptr<FrameTap>> FrameTap::open(const std::filesystem::path& file,
                                                   const session::SessionHeader& header,
                                                   const gaze::FoveaPolicy& policy) {
    auto recorder = session::SessionRecorder::create(file, header);
    if (!recorder) {
        return std::unexpected(std::move(recorder.error()));
    }
    return std::unique_ptr<FrameTap>(new FrameTap(std::move(*recorder), policy));
}

FrameTap::FrameTap(std::unique_ptr<session::SessionRecorder> recorder,
                   const gaze::FoveaPolicy& policy)
    : recorder_(std::move(recorder)), gaze_(policy) {}

FrameTap::Frame* FrameTap::frame_of(std::int64_t key) {
    // Some applications move the time that they were told by a little.
    constexpr std::int64_t kSameFrame_ns = 20'000'000;
    const auto apart = [key](const Frame& frame) {
        const std::int64_t ns = time::saturated(static_cast<__int128>(frame.key) - key);
        return !frame.waited || ns == std::numeric_limits<std::int64_t>::min()
                   ? std::numeric_limits<std::int64_t>::max()
                   : std::abs(ns);
    };
    Frame& nearest = *std::ranges::min_element(frames_, {}, apart);
    return apart(nearest) <= kSameFrame_ns ? &nearest : nullptr;
}

void FrameTap::waited(std::int64_t key, std::int64_t now_ns, const Announced& announced) {
    const std::lock_guard lock(mutex_);
    Frame& frame = frames_[waited_++ % kMostFrames];
    frame = {};
    frame.key = key;
    frame.waited = true;
    frame.record.stamps.wake_up = measured(now_ns);
    frame.record.period_ns = announced.period_ns;
    frame.record.should_render = announced.should_render;
    if (announced.display_ns) {
        frame.record.stamps.display = {*announced.display_ns, StampKind::Predicted};
        if (!first_display_ns_) {
            first_display_ns_ = announced.display_ns;
        }
        frame.record.scene_time_s =
            static_cast<double>(*announced.display_ns - *first_display_ns_) * 1e-9;
    }
}

void FrameTap::begun(std::int64_t now_ns) {
    const std::lock_guard lock(mutex_);
    if (begun_ == waited_) {
        return;  // the runtime has refused it
    }
    begun_ = std::max(begun_, waited_ - std::min<std::uint64_t>(waited_, kMostFrames));
    frames_[begun_++ % kMostFrames].record.stamps.begin = measured(now_ns);
}

void FrameTap::located(std::int64_t key, std::int64_t now_ns, const gaze::StereoView& views,
                       const gaze::Pose& head) {
    const std::lock_guard lock(mutex_);
    Frame* const frame = frame_of(key);
    if (frame == nullptr) {
        return;  // of no frame: an application may ask at any time
    }
    frame->record.views = views;
    frame->record.head = head;
    frame->viewed = true;
    if (!frame->gaze_read) {
        frame->record.stamps.latch = measured(now_ns);
    }
}

bool FrameTap::lacks_views(std::int64_t key) {
    const std::lock_guard lock(mutex_);
    const Frame* const frame = frame_of(key);
    return frame != nullptr && !frame->viewed;
}

void FrameTap::read_gaze(std::int64_t now_ns) {
    const std::lock_guard lock(mutex_);
    if (begun_ == 0) {
        return;
    }
    // For the frame that was begun last; reading ahead of that counts for none.
    Frame& frame = frames_[(begun_ - 1) % kMostFrames];
    frame.gaze_read = true;
    frame.record.stamps.latch = measured(now_ns);
}

void FrameTap::ended(std::int64_t key, std::int64_t before_ns, std::int64_t now_ns,
                     const Pictures& pictures) {
    const std::lock_guard lock(mutex_);
    Frame* const frame = frame_of(key);
    if (frame == nullptr) {
        return;
    }
    frame::FrameRecord& record = frame->record;
    record.index = index_++;
    record.stamps.submit = measured(before_ns);
    record.stamps.end_frame = measured(now_ns);
    bool drawn = frame->viewed;
    record.samples = {};
    for (std::size_t eye = 0; eye < gaze::kEyeCount; ++eye) {
        const auto& [width_px, height_px] = pictures.sizes_px[eye];
        record.views[eye].width_px = width_px;
        record.views[eye].height_px = height_px;
        if (pictures.of_views) {
            record.samples.pixels_output += std::uint64_t{width_px} * height_px;
        }
        drawn = drawn && gaze::is_valid(record.views[eye]);
    }
    record.should_render = record.should_render && drawn;
    if (!record.stamps.latch.known()) {
        record.stamps.latch = measured(before_ns);
    }
    record.stamps.filtered = record.stamps.latch;
    if (drawn) {
        record.fovea =
            gaze_.latch(record.stamps.latch, record.head, record.views, record.stamps.display);
    } else {
        record.fovea = {};
        record.fovea.latched = record.stamps.latch;
        record.views = {};
    }
    recorder_->add(record);
    frame->waited = false;
}

void FrameTap::add(const SeenGaze& seen, const SeenGaze& newest,
                   const std::optional<gaze::Pose>& head) {
    gaze::GazeSample sample = seen.sample;
    sample.head = head;
    if (head && last_head_ && newest.time_ns > last_head_->time_ns && sample.sampled.known()) {
        // Between two poses of the runtime, which are a frame apart.
        const double share =
            std::clamp(static_cast<double>(seen.time_ns - last_head_->time_ns) /
                           static_cast<double>(newest.time_ns - last_head_->time_ns),
                       0.0, 1.0);
        sample.head->orientation =
            glm::slerp(last_head_->head.orientation, head->orientation, share);
        sample.head->position_m =
            last_head_->head.position_m + share * (head->position_m - last_head_->head.position_m);
    } else if (&seen != &newest) {
        sample.head.reset();
    }
    gaze_.add(sample);
    recorder_->add(sample, index_);
}

std::uint64_t FrameTap::next_index() {
    const std::lock_guard lock(mutex_);
    return index_;
}

void FrameTap::composited(std::uint64_t index, std::int64_t gpu_ns) {
    frame::FrameGpuRecord record;
    record.index = index;
    record.passes.set(0, gpu_ns);
    const std::lock_guard lock(mutex_);
    recorder_->add(record);
}

void FrameTap::event(std::string_view kind, std::string_view text) {
    const std::lock_guard lock(mutex_);
    recorder_->event(time::measured_now(), kind, text);
}

std::string FrameTap::close() {
    const std::lock_guard lock(mutex_);
    const session::RecordingStatus status = recorder_->close();
    if (!status.failure.empty()) {
        return status.failure;
    }
    return status.dropped > 0 ? std::to_string(status.dropped) +
                                    " records were lost: the disk was "
                                    "too slow"
                              : std::string();
}

}  // namespace gazeloop::openxr_layer
