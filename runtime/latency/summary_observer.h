#pragma once

#include "runtime/frame/frame_observer.h"
#include "runtime/latency/latency_summary.h"

namespace gazeloop::latency {

/// Passes on to the summary, during a run and when a session is played alike.
class SummaryObserver final : public frame::FrameObserver {
  public:
    explicit SummaryObserver(LatencySummary& summary) : summary_(summary) {}
    void on_sample(const gaze::GazeSample& sample, std::uint64_t) override { summary_.add(sample); }
    void on_frame(const frame::FrameRecord& record) override {
        if (record.period_ns > 0) {
            summary_.add_display_period(record.period_ns);
        }
        summary_.add(record);
    }
    void on_gpu(const frame::FrameGpuRecord& record) override { summary_.add(record); }
    void on_gaze(const frame::FrameGaze& gaze) override { summary_.set_gaze_counts(gaze.counts); }
    void on_event(time::Stamp time, std::string_view kind, std::string_view text) override {
        summary_.add_event(time, kind, text);
    }

  private:
    LatencySummary& summary_;
};

}  // namespace gazeloop::latency
