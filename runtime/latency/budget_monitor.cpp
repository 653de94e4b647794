#include "runtime/latency/budget_monitor.h"

#include <algorithm>
#include <utility>

namespace gazeloop::latency {
namespace {

std::int64_t between_ns(std::int64_t from_ns, std::int64_t to_ns, std::int64_t more_ns = 0) {
    return time::saturated(static_cast<__int128>(to_ns) - from_ns + more_ns);
}

std::optional<std::int64_t> known_ns(const time::Span& span) {
    return span.known() ? std::optional(span.ns) : std::nullopt;
}

}  // namespace

BudgetMonitor::BudgetMonitor(const std::optional<LatencyBudget>& budget, std::int64_t window_ns)
    : window_ns_(window_ns), rows_(kMost), parts_(kMonitorPartCount, Part(kMost)) {
    if (budget) {
        parts_[kAgePart].limit_ns = budget->total_ns;
        for (std::size_t stage = 0; stage < kStageCount; ++stage) {
            parts_[kFirstStagePart + stage].limit_ns = budget->stages_ns[stage];
        }
    }
}

bool BudgetMonitor::first_has_gone(std::int64_t now_ns) const {
    return size_ >= kFewest && between_ns(row_at(0).time_ns, now_ns) > window_ns_;
}

void BudgetMonitor::take(const FrameAccount& account, std::uint64_t index, std::int64_t period_ns) {
    const time::Stamp& wake_up = account.stamps.wake_up;
    if (wake_up.known()) {
        last_ = last_.known() ? time::Stamp{std::max(last_.ns, wake_up.ns), wake_up.kind} : wake_up;
    }
    last_index_ = index;
    Row row{
        .time_ns = last_.ns, .state = account.state, .judged = account.with_gaze(), .parts = {}};
    row.parts[kAgePart] = account.age.at_display;
    std::ranges::copy(account.age.stages, row.parts.begin() + kFirstStagePart);
    row.parts[kUnaccountedPart] = account.age.unaccounted;

    ++frames_;
    with_gaze_ += row.judged ? 1 : 0;
    missed_ += account.shown.periods_missed > 0 ? 1 : 0;
    for (std::size_t part = 0; part < kMonitorPartCount; ++part) {
        count(parts_[part], row, row.parts[part], period_ns);
    }

    // The last one that goes makes place in each part for the one that comes.
    std::optional<Row> gone;
    const auto first_goes = [&] {
        if (gone) {
            exchange(&*gone, nullptr);
        }
        gone = row_at(0);
        first_ = (first_ + 1) % rows_.size();
        --size_;
    };
    while (first_has_gone(row.time_ns)) {
        first_goes();
        cut_ = false;
    }
    if (size_ == rows_.size()) {
        first_goes();
        cut_ = true;
    }
    exchange(gone ? &*gone : nullptr, &row);
    row_at(size_) = row;
    ++size_;
}

void BudgetMonitor::exchange(const Row* gone, const Row* come) {
    const auto known = [](const Row* row, std::size_t part) {
        return row != nullptr && row->judged ? known_ns(row->parts[part]) : std::nullopt;
    };
    for (std::size_t i = 0; i < kMonitorPartCount; ++i) {
        parts_[i].window.replace(known(gone, i), known(come, i));
        for (const Row* const row : {gone, come}) {
            if (row != nullptr && row->judged && !row->parts[i].known()) {
                parts_[i].unknown += row == come ? 1 : -std::uint64_t{1};
            }
        }
    }
    for (const Row* const row : {gone, come}) {
        if (row != nullptr) {
            const int sign = row == come ? 1 : -1;
            by_state_[static_cast<std::size_t>(row->state)] += static_cast<std::uint64_t>(sign);
            add_lengths(*row, sign);
        }
    }
}

void BudgetMonitor::add_lengths(const Row& row, int sign) {
    if (!row.judged || !row.parts[kAgePart].known()) {
        return;
    }
    for (std::size_t i = kFirstStagePart; i < kMonitorPartCount; ++i) {
        const time::Span& span = row.parts[i];
        const time::StampKind kind = i == kUnaccountedPart ? time::StampKind::Unknown : span.kind;
        if (span.known()) {
            const __int128 length = span.ns < 0 ? -static_cast<__int128>(span.ns) : span.ns;
            length_by_kind_ns_[static_cast<std::size_t>(kind)] += sign * length;
        }
    }
}

void BudgetMonitor::count(Part& part, const Row& row, const time::Span& span,
                          std::int64_t period_ns) {
    if (!row.judged) {
        part.run = {};
        return;
    }
    if (!span.known()) {
        ++part.all_unknown;
        return;
    }
    ++part.all_known;
    part.known_within += part.within_since_ns ? 1 : 0;
    if (!part.limit_ns || span.ns <= *part.limit_ns) {
        part.run = {};
        return;
    }
    ++part.violations;
    part.run.begin_ns = part.run.frames == 0 ? row.time_ns : part.run.begin_ns;
    ++part.run.frames;
    const std::int64_t lasted_ns = between_ns(part.run.begin_ns, row.time_ns, period_ns);
    if (part.run.frames >= part.longest_run_frames) {
        part.longest_run_ns = part.run.frames > part.longest_run_frames
                                  ? lasted_ns
                                  : std::max(part.longest_run_ns, lasted_ns);
        part.longest_run_frames = part.run.frames;
    }
}

std::optional<BudgetEvent> BudgetMonitor::judge(std::size_t index, const time::Stamp& time) {
    Part& part = parts_[index];
    const std::optional<std::int64_t> p95_ns =
        part.limit_ns ? part.window.percentile(kJudgedPercent) : std::nullopt;
    if (!p95_ns) {
        part.within_since_ns.reset();
        return std::nullopt;
    }
    BudgetEvent event{.time = time,
                      .part = index,
                      .broken = true,
                      .p95_ns = *p95_ns,
                      .limit_ns = *part.limit_ns,
                      .frames = part.window.size(),
                      .window_ns = span_of_window_ns()};
    if (*p95_ns > *part.limit_ns) {
        part.within_since_ns.reset();
        if (std::exchange(part.broken, true)) {
            return std::nullopt;
        }
        part.broken_at_ns = last_.ns;
        return event;
    }
    if (!part.broken) {
        return std::nullopt;
    }
    if (!part.within_since_ns) {
        part.within_since_ns = last_.ns;
        part.known_within = 1;
    }
    if (between_ns(*part.within_since_ns, last_.ns) < window_ns_ || part.known_within < kFewest) {
        return std::nullopt;
    }
    part.broken = false;
    part.within_since_ns.reset();
    event.broken = false;
    event.lasted_ns = between_ns(part.broken_at_ns, last_.ns);
    return event;
}

std::int64_t BudgetMonitor::span_of_window_ns() const {
    return size_ == 0 ? 0 : between_ns(row_at(0).time_ns, last_.ns);
}

MonitorSnapshot BudgetMonitor::snapshot() const {
    MonitorSnapshot snapshot{
        .time = last_,
        .frame = last_index_,
        .frames = frames_,
        .with_gaze = with_gaze_,
        .missed = missed_,
        .state = size_ == 0 ? gaze::FoveaState::Ahead : row_at(size_ - 1).state,
        .window_ns = span_of_window_ns(),
        .window_frames = size_,
        .window_cut = cut_,
        .by_state = by_state_,
        .share_by_kind_percent = std::nullopt};
    __int128 all_ns = 0;
    for (const __int128 ns : length_by_kind_ns_) {
        all_ns += ns;
    }
    if (all_ns > 0) {
        auto& share = snapshot.share_by_kind_percent.emplace();
        for (std::size_t kind = 0; kind < share.size(); ++kind) {
            share[kind] =
                100.0 * static_cast<double>(length_by_kind_ns_[kind]) / static_cast<double>(all_ns);
        }
    }
    for (std::size_t i = 0; i < kMonitorPartCount; ++i) {
        const Part& part = parts_[i];
        snapshot.parts[i] = {.limit_ns = part.limit_ns,
                             .broken = part.broken,
                             .known = part.window.size(),
                             .unknown = part.unknown,
                             .p50_ns = part.window.percentile(50),
                             .p95_ns = part.window.percentile(95),
                             .p99_ns = part.window.percentile(99),
                             .all_known = part.all_known,
                             .all_unknown = part.all_unknown,
                             .violations = part.violations,
                             .longest_run_frames = part.longest_run_frames,
                             .longest_run_ns = part.longest_run_ns};
    }
    return snapshot;
}

}  // namespace gazeloop::latency
