#pragma once

#include <cstdint>

#include "runtime/frame/frame_record.h"
#include "runtime/gaze/head_motion.h"
#include "runtime/present/frame_target.h"
#include "runtime/session/cursor.h"

namespace gazeloop {

/// What a frame is rendered for.
struct PlannedFrame {
    time::Stamp display;
    std::int64_t period_ns = 0;
    bool should_render = true;
    double scene_time_s = 0.0;
    gaze::Pose head;         ///< in world
    gaze::StereoView views;  ///< in world
    gaze::HiddenMeshes hidden;
};

/// Who says what time it is: the clock on the wall, a model of it, or a recording. The loop asks
/// here for every time, display time and view, so that it runs the same in all three.
class FrameTimeline {
  public:
    FrameTimeline() = default;
    FrameTimeline(const FrameTimeline&) = delete;
    FrameTimeline& operator=(const FrameTimeline&) = delete;
    virtual ~FrameTimeline() = default;

    /// The time now. Called at each of the frame's points in the order of FrameStamps.
    virtual time::Stamp now() = 0;

    /// The frame's time line begins; from here to the next call now() refers to it.
    virtual void begin(std::uint64_t /*frame*/) {}

    /// What to render, given what the target announced. `head` is the gaze source's head motion, or
    /// null.
    virtual void plan(const present::TargetFrame& target, const gaze::HeadMotion* head,
                      PlannedFrame& frame) = 0;

    /// When the gaze is read: the time now, unless it was decided before.
    virtual time::Stamp latch() { return now(); }

    /// Puts a frame's points into this time line (the loop has filled them in from now()).
    virtual void settle(frame::FrameRecord&) {}
    virtual void settle(frame::FrameGpuRecord&) {}

    /// Whether time passes by itself, under the target's own head: then a sample without a head
    /// pose gets it from the target, and gaze goes on coming while the target wants no frames.
    [[nodiscard]] virtual bool is_live() const { return false; }

    /// Total time, ns, that the machine was suspended and this time line's clock did not count. 0
    /// for time lines that follow no hardware clock.
    [[nodiscard]] virtual std::int64_t slept_ns() const { return 0; }

    /// Whether the frame lies past the end of the recording.
    [[nodiscard]] virtual bool over(std::uint64_t /*frame*/) const { return false; }
};

/// Wall clock; the target's announcements stand. Where the gaze source recorded the head, that head
/// looks around: the world moves about the target's head so that the views are the recorded ones.
class LiveTimeline final : public FrameTimeline {
  public:
    explicit LiveTimeline(std::int64_t start_ns) : start_ns_(start_ns) {}

    time::Stamp now() override;
    void plan(const present::TargetFrame& target, const gaze::HeadMotion* head,
              PlannedFrame& frame) override;
    [[nodiscard]] bool is_live() const override { return true; }
    [[nodiscard]] std::int64_t slept_ns() const override;

  private:
    std::int64_t start_ns_;
};

/// Virtual time: frame k wakes, latches and submits at k periods, is on the GPU for the modelled
/// duration and is displayed a period later. Nothing that is measured enters, so that the same
/// trace gives the same frames on every machine; a target is only a sink.
class VirtualTimeline final : public FrameTimeline {
  public:
    struct Model {
        std::int64_t period_ns;
        std::int64_t gpu_ns;
        gaze::StereoView views;  ///< with the head at the origin
    };
    explicit VirtualTimeline(const Model& model) : model_(model) {}

    time::Stamp now() override;
    void begin(std::uint64_t frame) override { frame_ = frame; }
    void plan(const present::TargetFrame& target, const gaze::HeadMotion* head,
              PlannedFrame& frame) override;
    void settle(frame::FrameRecord& record) override;
    void settle(frame::FrameGpuRecord& record) override;

  private:
    Model model_;
    std::uint64_t frame_ = 0;
};

/// A recorded session's frames: their views, display and latch times are used again. They are read
/// as the loop goes on. Throws SetupError (BadInput) where that fails.
class RecordedTimeline final : public FrameTimeline {
  public:
    /// Preconditions: the session outlives this, and holds this many frames (1 or more), numbered
    /// from 0, none missing.
    RecordedTimeline(const session::OpenSession& session, std::uint64_t frames);

    time::Stamp now() override;
    void begin(std::uint64_t frame) override;
    void plan(const present::TargetFrame& target, const gaze::HeadMotion* head,
              PlannedFrame& frame) override;
    time::Stamp latch() override;
    void settle(frame::FrameRecord& record) override;
    void settle(frame::FrameGpuRecord& record) override;
    [[nodiscard]] bool over(std::uint64_t frame) const override { return frame >= frame_count_; }

  private:
    std::uint64_t frame_count_;
    session::FrameCursor begun_;     ///< at the frame that was begun
    session::FrameCursor finished_;  ///< at the last one that the GPU has finished
    session::HiddenCursor hidden_;   ///< at the first change after that frame
    frame::FrameRecord frame_;       ///< the frame that was begun
    gaze::HiddenMeshes hidden_now_;  ///< in it
};

}  // namespace gazeloop
