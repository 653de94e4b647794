#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "runtime/latency/budget.h"
#include "runtime/run/monitor_message.h"

namespace gazeloop::run {

struct MonitorOutputOptions {
    bool panel = false;  ///< on stderr: drawn in place where that is a terminal, else lines
    std::optional<int> json_fd{};  ///< see report/MONITOR.md
    std::optional<latency::LatencyBudget> budget{};
    std::string clock{};  ///< of the frames' times: wall or virtual
};

/// Shows and writes what a monitor says, on a thread of its own. The loop feeds it through a
/// bounded lock-free queue, as its only producer, and is never held up: what finds the queue full
/// or the descriptor's reader slow is dropped and counted.
class MonitorOutput {
  public:
    explicit MonitorOutput(const MonitorOutputOptions& options);
    MonitorOutput(const MonitorOutput&) = delete;
    MonitorOutput& operator=(const MonitorOutput&) = delete;
    ~MonitorOutput();

    /// Allocates nothing. What does not fit is dropped.
    void add(const MonitorRecord& record);

    /// Writes what is queued, takes the panel off the terminal, and says what was dropped (log).
    /// Idempotent; what is added later is lost. Called by the destructor.
    void close();

  private:
    class Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace gazeloop::run
