#pragma once

#include <cstdint>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "runtime/frame/frame_observer.h"
#include "runtime/latency/budget.h"
#include "runtime/latency/latency_summary.h"
#include "runtime/latency/monitor_snapshot.h"

namespace gazeloop::run {

class MonitorFeed;
class MonitorOutput;

/// The budget of one run, its monitor, and what that found.
class RunMonitor {
  public:
    struct Options {
        latency::SummaryConfig display;  ///< its clock, period, switching and rolling times
        bool panel = false;              ///< see MonitorOutputOptions
        std::optional<int> json_fd{};    ///< see MonitorOutputOptions
        std::int64_t window_ns = 0;
        std::int64_t interval_ns = 0;  ///< of frames' time, between lines
    };

    explicit RunMonitor(std::optional<latency::LatencyBudget> budget);
    RunMonitor(const RunMonitor&) = delete;
    RunMonitor& operator=(const RunMonitor&) = delete;
    ~RunMonitor();

    [[nodiscard]] const std::optional<latency::LatencyBudget>& budget() const { return budget_; }

    /// Starts to watch, where somebody looks or a budget is in force; else does nothing.
    void open(const Options& options);
    /// Joins the loop's observers, and tells those before it of what it finds broken or kept.
    void join(std::vector<frame::FrameObserver*>& observers);
    /// What the last frames broke is told while the others still listen; then the panel goes.
    void close();

    /// What the run has made of its budget; nothing without a budget or before close().
    [[nodiscard]] std::string text() const;
    void add_to(nlohmann::ordered_json& json) const;

  private:
    std::optional<latency::LatencyBudget> budget_;
    std::unique_ptr<MonitorOutput> output_;
    std::unique_ptr<MonitorFeed> feed_;
    std::optional<latency::MonitorSnapshot> last_;
};

}  // namespace gazeloop::run
