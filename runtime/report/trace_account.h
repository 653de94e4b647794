#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "runtime/frame/frame_observer.h"
#include "runtime/gaze/trace_report.h"

namespace gazeloop::report {

/// What a trace's reader says of it, as the texts of events (frame::kTraceEvent): counts ("rows
/// 800, used 799, ..."), how its clocks were tied ("clock: ..."), what the directions were found to
/// be ("directions: ..."), each finding that was kept ("302: time outlier: ...", the line first;
/// without one, the file as a whole), and of each kind how many more there are. Empty for a trace
/// of no file.
[[nodiscard]] std::vector<std::string> trace_events(const gaze::TraceReport& report);

/// One of these texts, for the log: with the file, and the line where there is one.
[[nodiscard]] std::string at_file(const std::string& file, std::string_view event);

/// The same without a file: "line 302: time outlier: ...".
[[nodiscard]] std::string at_line(std::string_view event);

/// Whether one of these texts is a finding, and no count.
[[nodiscard]] bool is_finding(std::string_view event);

/// Gathers what a run says of the trace that it plays, and of a live source's directions, from
/// events: its own or a session's.
class TraceAccount {
  public:
    void take(std::string_view kind, std::string_view text);

    /// For the summary, at most 100 columns wide; empty where there is nothing to say.
    [[nodiscard]] std::string text() const;
    /// Adds "trace" (null: none was played) and "directions" (null: not looked at).
    void add_to(nlohmann::ordered_json& summary) const;

  private:
    std::string counts_;
    std::vector<std::string> findings_;
    std::string clock_;
    std::string directions_;
};

/// Passes events on to an account.
class TraceObserver final : public frame::FrameObserver {
  public:
    explicit TraceObserver(TraceAccount& account) : account_(account) {}
    void on_event(time::Stamp, std::string_view kind, std::string_view text) override {
        account_.take(kind, text);
    }

  private:
    TraceAccount& account_;
};

}  // namespace gazeloop::report
