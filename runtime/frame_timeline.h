#pragma once

#include <cstdint>
#include <optional>

#include "runtime/frame/frame_record.h"
#include "runtime/gaze/head_motion.h"
#include "runtime/gaze/origin_watch.h"
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
    std::optional<gaze::OriginChange> origin;  ///< the world is another than the frame before's
    /// That a recording has of the frame; none otherwise.
    std::optional<std::uint8_t> quality_level{};
};

/// Where times come from: the wall clock, a model of it, or a recording. The loop asks here for
/// every time, display time and view, so that it runs the same by all three.
class FrameTimeline {
  public:
    FrameTimeline() = default;
    FrameTimeline(const FrameTimeline&) = delete;
    FrameTimeline& operator=(const FrameTimeline&) = delete;
    virtual ~FrameTimeline() = default;

    /// The time now. Called at each point of the frame, in the order of FrameStamps.
    virtual time::Stamp now() = 0;

    /// Begins a frame: until the next call, now() refers to it.
    virtual void begin(std::uint64_t /*frame*/) {}

    /// Decides what to render, given what the target announced. `head` is the gaze source's head
    /// motion, or null.
    virtual void plan(const present::TargetFrame& target, const gaze::HeadMotion* head,
                      PlannedFrame& frame) = 0;

    /// A sample's head, as target or source gave it, in the world of the frame planned last.
    [[nodiscard]] virtual gaze::Pose in_this_world(const gaze::Pose& head,
                                                   std::int64_t /*time_ns*/) const {
        return head;
    }

    /// Announcements of another world that came to nothing, since the last call.
    [[nodiscard]] virtual std::uint64_t origins_given_up() { return 0; }

    /// When the gaze is read: the time now, unless it was decided before.
    virtual time::Stamp latch() { return now(); }

    /// Moves a frame's stamps, which the loop has filled in from now(), onto this time line.
    virtual void settle(frame::FrameRecord&) {}
    virtual void settle(frame::FrameGpuRecord&) {}

    /// Whether time passes by itself and the head is the target's own. If so, a sample without a
    /// head pose gets the target's, and gaze is read on while the target wants no frames.
    [[nodiscard]] virtual bool is_live() const { return false; }

    /// How long the machine was suspended in all, ns, which this time line's clock did not count. 0
    /// for time lines that follow no hardware clock.
    [[nodiscard]] virtual std::int64_t slept_ns() const { return 0; }

    /// Whether the frame lies past the end of the recording.
    [[nodiscard]] virtual bool over(std::uint64_t /*frame*/) const { return false; }
};

/// Wall clock; display times and periods are as the target announces them. Where the gaze source
/// recorded the head, the views are that head's: the world is moved around the target's head, and
/// where the target's origin is does not matter.
class LiveTimeline : public FrameTimeline {
  public:
    explicit LiveTimeline(std::int64_t start_ns) : start_ns_(start_ns) {}

    time::Stamp now() override;
    void plan(const present::TargetFrame& target, const gaze::HeadMotion* head,
              PlannedFrame& frame) override;
    [[nodiscard]] gaze::Pose in_this_world(const gaze::Pose& head,
                                           std::int64_t time_ns) const override {
        return origin_.in_this_world(head, time_ns);
    }
    [[nodiscard]] std::uint64_t origins_given_up() override { return origin_.take_given_up(); }
    [[nodiscard]] bool is_live() const override { return true; }
    [[nodiscard]] std::int64_t slept_ns() const override;

  private:
    std::int64_t start_ns_;
    gaze::OriginWatch origin_;
};

/// Virtual time: frame k wakes, latches and submits at k periods, is on the GPU for the modelled
/// duration and is displayed one period later. Nothing measured enters, so the same trace gives the
/// same frames on every machine. The target only takes the frames.
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

/// A recorded session's frames: their views, display times and latch times are used again. They are
/// read as the loop goes on. Throws SetupError (BadInput) if that fails.
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
    session::OriginCursor origin_;   ///< at the first change after that frame
    frame::FrameRecord frame_;       ///< the frame that was begun
    gaze::HiddenMeshes hidden_now_;  ///< in it
    std::optional<gaze::OriginChange> origin_now_;
};

}  // namespace gazeloop
