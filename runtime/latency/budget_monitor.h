#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "runtime/latency/budget.h"
#include "runtime/latency/budget_event.h"
#include "runtime/latency/frame_account.h"
#include "runtime/latency/monitor_snapshot.h"
#include "runtime/latency/ordered_values.h"

namespace gazeloop::latency {

/// Holds frames against a budget while they pass: exact percentiles over the last seconds, and what
/// was above its limit, how often and how long in a row. In memory that is there from the start.
///
/// The window holds the rendered frames of the last window_ns, and at least the last kFewest, so
/// that a loop that is slower than it should be is judged as well. It holds kMost frames at most.
///
/// Only frames whose foveae rest on a fresh sample are judged: while the gaze is lost, an age says
/// how long, not what the chain of stages takes. A part that a judged frame does not know counts
/// apart: neither as kept nor as above its limit.
///
/// A part is *broken* when the 95th percentile of the window is above its limit: so one late frame
/// breaks nothing, and what breaks it can be felt. It is *kept again* once that percentile has been
/// within the limit all the time that a window lasts, and for kFewest frames that know the part:
/// the frames that broke it have all left the window by then. So a latency that lingers at its
/// limit makes no event with each frame. While fewer than kFewest frames know the part, nothing
/// changes.
///
/// A run of violations goes on until a judged frame is within the limit, or one is not judged: a
/// frame that does not know the part neither ends it nor counts in it. It lasts from the wake-up of
/// its first frame to the end of the period of its last.
class BudgetMonitor {
  public:
    static constexpr std::size_t kFewest = 20;  ///< what a 95th percentile needs
    static constexpr std::size_t kMost = 4096;
    static constexpr unsigned kJudgedPercent = 95;

    /// `budget`: none: nothing is limited. Precondition: window_ns >= 0.
    BudgetMonitor(const std::optional<LatencyBudget>& budget, std::int64_t window_ns);

    /// Rendered frames in the order in which they were finished, `period_ns` of the display, or 0.
    /// A wake-up before the last one's counts as at the same time. `tell(BudgetEvent)` is called
    /// for each part that is broken or kept again by this frame.
    template <typename Tell>
    void add(const FrameAccount& account, std::uint64_t index, std::int64_t period_ns,
             const Tell& tell) {
        take(account, index, period_ns);
        for (std::size_t part = 0; part < kMonitorPartCount; ++part) {
            if (const auto event = judge(part, account.stamps.end_frame)) {
                tell(*event);
            }
        }
    }

    [[nodiscard]] MonitorSnapshot snapshot() const;

  private:
    struct Row {
        std::int64_t time_ns = 0;
        gaze::FoveaState state = gaze::FoveaState::Ahead;
        bool judged = false;
        std::array<time::Span, kMonitorPartCount> parts;
    };

    struct Run {
        std::uint64_t frames = 0;
        std::int64_t begin_ns = 0;
    };

    struct Part {
        explicit Part(std::size_t capacity) : window(capacity) {}
        std::optional<std::int64_t> limit_ns;
        OrderedValues window;
        std::uint64_t unknown = 0;  ///< in the window
        std::uint64_t all_known = 0;
        std::uint64_t all_unknown = 0;
        std::uint64_t violations = 0;
        Run run;
        std::uint64_t longest_run_frames = 0;
        std::int64_t longest_run_ns = 0;
        bool broken = false;
        std::int64_t broken_at_ns = 0;
        std::optional<std::int64_t> within_since_ns;  ///< the window's percentile, while broken
        std::uint64_t known_within = 0;               ///< frames that know it, since then
    };

    void take(const FrameAccount& account, std::uint64_t index, std::int64_t period_ns);
    void count(Part& part, const Row& row, const time::Span& span, std::int64_t period_ns);
    [[nodiscard]] std::optional<BudgetEvent> judge(std::size_t index, const time::Stamp& time);
    [[nodiscard]] Row& row_at(std::size_t place) { return rows_[(first_ + place) % rows_.size()]; }
    [[nodiscard]] const Row& row_at(std::size_t place) const {
        return rows_[(first_ + place) % rows_.size()];
    }
    [[nodiscard]] bool first_has_gone(std::int64_t now_ns) const;
    [[nodiscard]] std::int64_t span_of_window_ns() const;
    /// Takes one row out of all figures of the window and puts another in; null: none.
    void exchange(const Row* gone, const Row* come);
    void add_lengths(const Row& row, int sign);

    std::int64_t window_ns_;
    std::vector<Row> rows_;  ///< a ring
    std::size_t first_ = 0;
    std::size_t size_ = 0;
    std::vector<Part> parts_;
    std::array<std::uint64_t, gaze::kFoveaStateNames.size()> by_state_{};
    std::array<__int128, time::kStampKindCount> length_by_kind_ns_{};
    time::Stamp last_;
    std::uint64_t last_index_ = 0;
    std::uint64_t frames_ = 0;
    std::uint64_t with_gaze_ = 0;
    std::uint64_t missed_ = 0;
    bool cut_ = false;
};

}  // namespace gazeloop::latency
