#pragma once

#include <chrono>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "runtime/doctor/finding.h"

namespace gazeloop::doctor {

/// What a probe tells while it runs. Each finding is written at once, so that a later crash does
/// not lose it.
class ProbeReport {
  public:
    explicit ProbeReport(int pipe) : pipe_(pipe) {}

    /// What is tried next, "loading the runtime", and what to do if it fails, where that differs
    /// from the general remedy.
    void step(std::string_view what, std::string_view remedy = "");
    void add(const Finding& finding);
    /// Why the probe could not go on.
    void failed(std::string_view why);
    void ended();

  private:
    void send(const nlohmann::json& message) const;

    int pipe_;
};

struct ProbeResult {
    std::vector<Finding> findings;
    std::string step;    ///< the last one begun
    std::string remedy;  ///< its own, or empty
    std::string broken;  ///< empty: it ran to its end; else how it ended, "crashed (SIGSEGV)"

    /// The findings. If the probe broke, also a Failure named `check` that says how, and at which
    /// step. `general_remedy` is for steps without a remedy of their own.
    [[nodiscard]] std::vector<Finding> findings_and_end(std::string_view check,
                                                        std::string_view general_remedy,
                                                        bool stops_loop) &&;
};

/// How long a probe may take, and what ends it before.
struct ProbeLimits {
    std::chrono::milliseconds patience;
    std::function<bool()> stop;  ///< called a few times per second; true ends the probe
};

/// Runs a probe in a process of its own, since what it loads may crash or hang: drivers, runtimes,
/// layers. At its limits it is killed. What it prints is kept from the terminal; its last line
/// becomes part of `broken`. An exception's text becomes `broken`. Precondition: this process has a
/// single thread.
ProbeResult run_probe(const std::function<void(ProbeReport&)>& probe, const ProbeLimits& limits);

}  // namespace gazeloop::doctor
