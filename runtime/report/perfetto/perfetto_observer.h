#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "runtime/frame/frame_observer.h"
#include "runtime/latency/latency_summary.h"
#include "runtime/report/perfetto/event_drawing.h"
#include "runtime/report/perfetto/frame_drawing.h"
#include "runtime/report/perfetto/gaze_states.h"

namespace gazeloop::report::perfetto {

/// Which samples are drawn. What was lost or out of order is drawn always.
enum class SampleDetail : std::uint8_t {
    Used,  ///< those that a frame rested on; the session may be played without samples
    All,   ///< each, about 40 bytes
};

struct PerfettoConfig {
    latency::SummaryConfig session{};  ///< clock, display and passes
    std::string about{};               ///< what the trace says of itself
    SampleDetail samples = SampleDetail::Used;
};

/// Turns a session into a Perfetto trace while it is played, in memory that its length does not
/// change. For session::play(), which tells the GPU's part of a frame at once: one that comes later
/// than the next frame is left out.
///
/// Frames overlap, and slices of one track must not: each slice is on the first track of its
/// subject that is free. Times are the session's.
class PerfettoObserver final : public frame::FrameObserver {
  public:
    /// `sink`: see TraceWriter.
    PerfettoObserver(PerfettoConfig config, TraceWriter::Sink sink);

    void on_sample(const gaze::GazeSample& sample, std::uint64_t frame) override;
    void on_frame(const frame::FrameRecord& record) override;
    void on_gpu(const frame::FrameGpuRecord& record) override;
    void on_gaze(const frame::FrameGaze& gaze) override;
    void on_event(time::Stamp time, std::string_view kind, std::string_view text) override;

    /// Once, after the last of them: what is open is closed and handed over.
    void finish();

    [[nodiscard]] const Unshown& unshown() const { return unshown_; }
    /// Samples that are not drawn, because no frame rested on them.
    [[nodiscard]] std::uint64_t samples_left_out() const;
    [[nodiscard]] std::uint64_t bytes() const { return writer_.bytes(); }

  private:
    void draw_pending();

    SampleDetail samples_;
    TraceWriter writer_;
    Unshown unshown_;
    Tracks tracks_;
    Drawing drawing_;
    FrameDrawing frames_;
    EventDrawing events_;
    GazeStates states_;
    std::optional<latency::FinishedFrame> pending_;
    time::Stamp latch_;  ///< of the last frame
};

}  // namespace gazeloop::report::perfetto
