#pragma once

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "runtime/frame/frame_observer.h"
#include "runtime/latency/budget_monitor.h"
#include "runtime/latency/commonest_period.h"
#include "runtime/latency/latency_summary.h"
#include "runtime/latency/pending_frames.h"
#include "runtime/run/monitor_output.h"

namespace gazeloop::run {

/// Feeds a budget monitor as the loop goes on, beside the summary and by the same accounts. What
/// the monitor finds broken or kept is told to the other observers, and so comes into log, session
/// and summary. Unlike the summary, it cannot wait until the end to say whose display it is: the
/// profile's figures count while the commonest period so far is that display's.
class MonitorFeed final : public frame::FrameObserver {
  public:
    struct Options {
        latency::SummaryConfig display;  ///< its period, switching and rolling times
        std::optional<latency::LatencyBudget> budget;
        std::int64_t window_ns = 0;
        std::int64_t interval_ns = 0;     ///< of frames' time, between lines
        MonitorOutput* output = nullptr;  ///< null: nobody watches
    };
    explicit MonitorFeed(const Options& options);

    /// Who is told of events besides; before the first frame.
    void tell(const std::vector<frame::FrameObserver*>& observers) { others_ = observers; }

    void on_frame(const frame::FrameRecord& record) override;
    void on_gpu(const frame::FrameGpuRecord& record) override;
    void on_event(time::Stamp time, std::string_view kind, std::string_view text) override;

    /// After the last frame: those that still lack their GPU part count as they are.
    latency::MonitorSnapshot finish();

  private:
    void complete(const latency::FinishedFrame& finished);
    void report(const latency::BudgetEvent& event);
    void publish(const time::Stamp& time);

    Options options_;
    latency::BudgetMonitor monitor_;
    latency::CommonestPeriod periods_;
    latency::PendingFrames pending_;
    std::vector<frame::FrameObserver*> others_;
    std::optional<std::int64_t> last_line_ns_;  ///< by the frames' time
    std::int64_t last_picture_ns_ = 0;          ///< by the wall's
};

}  // namespace gazeloop::run
