#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "runtime/frame/passes.h"
#include "runtime/latency/frame_account.h"
#include "runtime/latency/latency_summary.h"
#include "runtime/report/perfetto/drawing.h"

namespace gazeloop::report::perfetto {

/// Draws frames: what the tracker, the loop, the GPU, the runtime and the display did for each.
///
/// Arrows go from the sample that a frame rests on to its photon: its slice on the track "tracker",
/// if it is the first frame that rests on it; its wait for the latch; the part of the loop's frame
/// that begins at the latch; the GPU; the photon. Where the fovea rests on no fresh sample they
/// begin at the latch.
class FrameDrawing {
  public:
    FrameDrawing(TraceWriter& writer, Drawing& drawing, latency::SummaryConfig config);

    /// In the order of their indices.
    void draw(const latency::FinishedFrame& finished);

    /// Samples that frames rested on.
    [[nodiscard]] std::uint64_t samples_used() const { return samples_used_; }

  private:
    /// Of a frame with gaze, by where the gaze went.
    struct Hops {
        std::optional<Drawing::Place> sample;
        std::optional<Drawing::Place> queue;
    };

    /// From the profile, if the display can be the profile's.
    struct DisplayTimes {
        std::optional<std::int64_t> switching_ns{};
        std::optional<std::int64_t> rolling_ns{};
        std::optional<std::int64_t> persistence_ns{};
    };
    struct RestedOn {
        std::uint64_t sequence = 0;
        time::Stamp sampled;
        friend bool operator==(const RestedOn&, const RestedOn&) = default;
    };

    [[nodiscard]] DisplayTimes display_times(const frame::FrameRecord& record) const;
    void draw_rendered(const latency::FinishedFrame& finished);
    void draw_not_rendered(const frame::FrameRecord& record);
    Hops draw_gaze(const frame::FrameRecord& record);
    /// Whether the frame before rested on it.
    [[nodiscard]] bool rested_on(const RestedOn& sample) const;
    std::optional<Drawing::Place> draw_sample(const gaze::FoveaPoint& fovea);
    std::optional<Drawing::Place> draw_loop(const frame::FrameRecord& record);
    std::optional<Drawing::Place> draw_gpu(const latency::FinishedFrame& finished,
                                           const frame::FrameStamps& stamps);
    void draw_runtime(const frame::FrameStamps& stamps, const time::Stamp& shown);
    std::optional<Drawing::Place> draw_display(const frame::FrameRecord& record,
                                               const latency::FrameAccount& account,
                                               const DisplayTimes& display);
    /// A slice of this length about the middle; none where the length is unknown or 0.
    void draw_around(Subject subject, NameId name, const time::Stamp& middle,
                     std::optional<std::int64_t> length_ns);
    void draw_interval(const frame::FrameRecord& record);

    struct Names {
        NameId tracker, delivery, queue, frame, not_rendered, begin, latch, filter, submit,
            end_frame, gpu, present, display, scan_out, light, switching, photon;
    };
    struct Keys {
        KeyId number, sequence, reused, clock_deviation_ns, gaze_age_ms, periods_missed;
    };
    struct Neighbour {
        std::uint64_t index;
        time::Stamp wake_up;
    };
    Drawing& drawing_;
    latency::SummaryConfig config_;
    Names names_;
    Keys keys_;
    std::vector<NameId> passes_;
    std::optional<Neighbour> before_;
    std::array<std::optional<RestedOn>, 2> rested_on_;  ///< by the eyes of the frame before
    std::uint64_t samples_used_ = 0;
};

}  // namespace gazeloop::report::perfetto
