#include "runtime/openxr_layer/frame_tap.h"

#include <algorithm>
#include <cstdlib>
#include <limits>
#include <utility>

#include "runtime/time/clock.h"
#include "runtime/time/span.h"

namespace gazeloop::openxr_layer {

Expected<std::unique_ptr<FrameTap>> FrameTap::open(const std::filesystem::path& file,
                                                   const session::SessionHeader& header,
                                                   const gaze::FoveaPolicy& policy) {
    auto recorder = SeenRecorder::open(file, header, policy);
    if (!recorder) {
        return std::unexpected(std::move(recorder.error()));
    }
    return std::unique_ptr<FrameTap>(new FrameTap(std::move(*recorder)));
}

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
    frame.key = key;
    frame.waited = true;
    frame.gaze_read = false;
    SeenFrame& seen = frame.seen;
    seen.wake_up_ns = now_ns;
    seen.begin_ns.reset();
    seen.latch_ns.reset();
    seen.views.reset();
    seen.display_ns = announced.display_ns;
    seen.period_ns = announced.period_ns;
    seen.should_render = announced.should_render;
}

void FrameTap::begun(std::int64_t now_ns) {
    const std::lock_guard lock(mutex_);
    if (begun_ == waited_) {
        return;  // the runtime has refused it
    }
    begun_ = std::max(begun_, waited_ - std::min<std::uint64_t>(waited_, kMostFrames));
    frames_[begun_++ % kMostFrames].seen.begin_ns = now_ns;
}

void FrameTap::located(std::int64_t key, std::int64_t now_ns, const gaze::StereoView& views) {
    const std::lock_guard lock(mutex_);
    Frame* const frame = frame_of(key);
    if (frame == nullptr) {
        return;  // of no frame: an application may ask at any time
    }
    frame->seen.views = views;
    if (!frame->gaze_read) {
        frame->seen.latch_ns = now_ns;
    }
}

bool FrameTap::lacks_views(std::int64_t key) {
    const std::lock_guard lock(mutex_);
    const Frame* const frame = frame_of(key);
    return frame != nullptr && !frame->seen.views;
}

void FrameTap::read_gaze(std::int64_t now_ns) {
    const std::lock_guard lock(mutex_);
    if (begun_ == 0) {
        return;
    }
    // For the frame that was begun last; reading ahead of that counts for none.
    Frame& frame = frames_[(begun_ - 1) % kMostFrames];
    frame.gaze_read = true;
    frame.seen.latch_ns = now_ns;
}

void FrameTap::ended(std::int64_t key, std::int64_t before_ns, std::int64_t now_ns,
                     const FramePictures& pictures) {
    const std::lock_guard lock(mutex_);
    Frame* const frame = frame_of(key);
    if (frame == nullptr) {
        return;
    }
    SeenFrame& seen = frame->seen;
    seen.index = index_++;
    seen.submit_ns = before_ns;
    seen.end_frame_ns = now_ns;
    seen.pictures = pictures;
    recorder_->add(seen);
    frame->waited = false;
}

std::uint64_t FrameTap::next_index() {
    const std::lock_guard lock(mutex_);
    return index_;
}

void FrameTap::composited(std::uint64_t index, std::int64_t gpu_ns) {
    const std::lock_guard lock(mutex_);
    recorder_->add(CompositedFrame{index, gpu_ns});
}

void FrameTap::event(std::string_view kind, std::string_view text) {
    const std::lock_guard lock(mutex_);
    recorder_->add(SaidEvent{time::measured_now(), FixedText<32>(kind), FixedText<240>(text)});
}

}  // namespace gazeloop::openxr_layer
