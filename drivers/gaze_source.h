#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "runtime/frame/event.h"
#include "runtime/gaze/gaze_sample.h"
#include "runtime/gaze/gaze_trace.h"
#include "runtime/gaze/head_motion.h"
#include "runtime/gaze/seen_depth.h"

namespace gazeloop::drivers {

/// Something that happened to a source, for log and session.
struct SourceEvent {
    time::Stamp time;
    std::string text;  ///< one line
    /// For FrameObserver::on_event: "tracker", "tracker-fault" where it is there and cannot be
    /// used, "gaze-unplaced" where something must be set before its gaze has a direction, or
    /// "axes" where directions are in doubt.
    frame::EventKind kind = frame::kTrackerEvent;
};

/// Where gaze comes from. A source that owns a device reads it on its own thread and hands the
/// samples over in poll(); a source that computes samples does so in poll().
class GazeSource {
  public:
    GazeSource() = default;
    GazeSource(const GazeSource&) = delete;
    GazeSource& operator=(const GazeSource&) = delete;
    virtual ~GazeSource() = default;

    /// Appends every sample that has arrived by `now_ns` (host time) and was not handed over yet,
    /// in the order of arrival. Never blocks.
    virtual void poll(std::int64_t now_ns, std::vector<gaze::GazeSample>& samples) = 0;

    /// How far away the scene was around the foveae of the newest frame that the GPU has finished,
    /// some frames ago. For sources that know one ray for both eyes and must find where the eyes'
    /// rays meet. A frame's gaze is recorded after the split into two rays, so that a replay needs
    /// no depth.
    virtual void take_seen_depth(const gaze::SeenDepth& /*seen*/) {}

    /// What happened since the last call: devices that came and went, changes of status and clock.
    [[nodiscard]] virtual std::vector<SourceEvent> take_events() { return {}; }

    /// The head motion that belongs to the gaze, or null where the source knows none.
    [[nodiscard]] virtual const gaze::HeadMotion* head_track() const { return nullptr; }

    /// Whether its samples are fixed in the head on purpose (fixed foveation), so that they must
    /// not be held in world.
    [[nodiscard]] virtual bool fixed_in_head() const { return false; }

    /// The trace that is played, for what its reader says of it, or null. Its times may be any.
    [[nodiscard]] virtual const gaze::GazeTrace* trace() const { return nullptr; }

    /// Whether no sample can come any more (the end of a trace).
    [[nodiscard]] virtual bool finished() const { return false; }

    /// One line for the log and the session, e.g. "trace FILE (HTC Vive Pro, 1518 samples)".
    [[nodiscard]] virtual std::string description() const = 0;
};

}  // namespace gazeloop::drivers
