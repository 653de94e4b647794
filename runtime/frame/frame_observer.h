#pragma once

#include <string_view>

#include "runtime/frame/frame_gaze.h"
#include "runtime/frame/frame_record.h"
#include "runtime/gaze/gaze_sample.h"
#include "runtime/gaze/hidden_mesh.h"
#include "runtime/gaze/origin_change.h"

namespace gazeloop::render {
struct FrameView;
}  // namespace gazeloop::render

namespace gazeloop::frame {

/// Is told what the loop does, on the loop's thread: must not block and, in steady state, not
/// allocate.
class FrameObserver {
  public:
    FrameObserver() = default;
    FrameObserver(const FrameObserver&) = delete;
    FrameObserver& operator=(const FrameObserver&) = delete;
    virtual ~FrameObserver() = default;

    /// A gaze sample that the frame has consumed, head pose filled in where it is known.
    virtual void on_sample(const gaze::GazeSample&, std::uint64_t /*frame*/) {}
    /// From the frame on, its pictures leave out these parts.
    virtual void on_hidden(const gaze::HiddenChange&) {}
    /// From the frame on, poses are in another world; told before the frame's samples.
    virtual void on_origin(const gaze::OriginChange&) {}
    /// A frame whose passes have been submitted. Its pictures still belong to the loop and lie in
    /// COLOR_ATTACHMENT_OPTIMAL. An observer that reads them, or draws into them, submits that to
    /// the context's queue, in this call, and leaves them in that layout. One that draws comes
    /// before those that read.
    virtual void on_rendered(const render::FrameView&, const gaze::FrameFovea&) {}
    /// A frame that was handed to the target.
    virtual void on_frame(const FrameRecord&) {}
    /// The GPU has finished a frame.
    virtual void on_gpu(const FrameGpuRecord&) {}
    /// In place of all on_sample, after the frame and its GPU part, where a session is played
    /// without its samples.
    virtual void on_gaze(const FrameGaze&) {}
    /// `kind` is one of frame/event.h, or what a recording holds.
    virtual void on_event(time::Stamp, std::string_view /*kind*/, std::string_view /*text*/) {}
};

}  // namespace gazeloop::frame
