#include "runtime/report/gaze_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <optional>
#include <vector>

#include "runtime/frame/event.h"
#include "runtime/gaze/anatomy.h"
#include "runtime/latency/sample_counter.h"
#include "runtime/memory/long_vector.h"
#include "runtime/report/gaze_events_text.h"
#include "runtime/report/gaze_quality_text.h"
#include "runtime/report/trace_account.h"
#include "runtime/report/wrapped_row.h"

namespace gazeloop::report {
namespace {

using Json = nlohmann::ordered_json;

struct Gap {
    std::int64_t after_ns;  ///< since the first sample
    std::int64_t length_ns;
};

/// What the samples say, whoever read them.
struct Samples {
    std::optional<double> rate_hz;
    std::int64_t duration_ns = 0;
    std::vector<Gap> gaps;  ///< the longest that are longer than two intervals, longest first
    gaze::PerEye<std::uint64_t> valid{};
    std::uint64_t both_valid = 0;
    std::uint64_t with_head = 0;
    latency::GazeCounts counts;
};

/// Puts it among the longest, if it is one: longest first, and the earlier one of two alike.
void keep_longest(const Gap& gap, std::vector<Gap>& longest) {
    constexpr std::size_t kMost = 3;
    const auto shorter = std::ranges::find_if(
        longest, [&](const Gap& kept) { return kept.length_ns < gap.length_ns; });
    longest.insert(shorter, gap);
    if (longest.size() > kMost) {
        longest.pop_back();
    }
}

Samples look_at(const gaze::RecordingView& trace) {
    Samples found;
    latency::SampleCounter counter;
    memory::LongVector<std::int64_t> intervals_ns;
    std::optional<std::int64_t> first_ns;
    std::optional<std::int64_t> before_ns;
    for (const gaze::GazeSample& sample : trace.samples) {
        counter.add(sample);
        for (const std::size_t e : {0U, 1U}) {
            found.valid[e] += sample.eyes[e].valid ? 1 : 0;
        }
        found.both_valid += sample.eyes[0].valid && sample.eyes[1].valid ? 1 : 0;
        found.with_head += sample.head ? 1 : 0;
        if (!sample.sampled.known() || (before_ns && sample.sampled.ns < *before_ns)) {
            continue;
        }
        const std::int64_t now_ns = sample.sampled.ns;
        first_ns = first_ns.value_or(now_ns);
        if (before_ns) {
            intervals_ns.push_back(now_ns - *before_ns);
            keep_longest({*before_ns - *first_ns, now_ns - *before_ns}, found.gaps);
        }
        before_ns = now_ns;
        found.duration_ns = now_ns - *first_ns;
    }
    found.counts = counter.counts();
    if (intervals_ns.empty()) {
        return found;
    }
    const auto middle = intervals_ns.begin() + static_cast<std::ptrdiff_t>(intervals_ns.size() / 2);
    std::ranges::nth_element(intervals_ns, middle, std::ranges::greater{});
    std::erase_if(found.gaps,
                  [twice_ns = 2 * *middle](const Gap& gap) { return gap.length_ns <= twice_ns; });
    if (const double rate_hz = trace.rate_hz(); rate_hz > 0.0) {
        found.rate_hz = rate_hz;
    }
    return found;
}

/// Unknown where a trace has no sequence numbers that count; a session's samples always have.
std::optional<std::uint64_t> lost_by_tracker(const gaze::RecordingView& trace,
                                             const Samples& found) {
    return trace.report.rows > 0 ? trace.report.lost_by_tracker : found.counts.lost;
}

double seconds(std::int64_t ns) { return static_cast<double>(ns) * 1e-9; }

double percent(std::uint64_t part, std::uint64_t whole) {
    return whole > 0 ? 100.0 * static_cast<double>(part) / static_cast<double>(whole) : 0.0;
}

std::string directions_of(const gaze::RecordingView& trace) {
    return trace.report.axes.empty() ? gaze::anatomy_text(gaze::anatomy_of(trace.samples))
                                     : trace.report.axes;
}

std::string gaps_text(const std::vector<Gap>& gaps) {
    if (gaps.empty()) {
        return "none longer than two intervals";
    }
    std::string text;
    for (const Gap& gap : gaps) {
        text += fmt::format("{}{:.3g} s at {:.2f} s", text.empty() ? "" : ", ",
                            seconds(gap.length_ns), seconds(gap.after_ns));
    }
    return text;
}

std::string findings_text(const gaze::TraceReport& report) {
    std::string text;
    for (const std::string& event : trace_events(report)) {
        if (is_finding(event)) {
            text += wrapped_row(text.empty() ? "found" : "", at_line(event));
        }
    }
    return text.empty() ? wrapped_row("found", "nothing dropped or changed") : text;
}

/// How many rows each kind of finding concerns, over the whole file.
Json counts_json(const gaze::TraceReport& report) {
    Json counts = Json::array();
    for (std::size_t kind = 0; kind < gaze::kTraceFindingKinds; ++kind) {
        const auto& count = report.count(static_cast<gaze::TraceFindingKind>(kind));
        if (count.times > 0) {
            counts.push_back({{"kind", gaze::kTraceFindingNames[kind]},
                              {"findings", count.times},
                              {"rows", count.rows},
                              {"dropped", count.dropped}});
        }
    }
    return counts;
}

}  // namespace

std::string gaze_text(const gaze::RecordingView& trace, const GazeFindings& findings) {
    const Samples found = look_at(trace);
    const std::size_t all = trace.samples.size();
    std::string text = fmt::format("{}\n", trace.file);
    const auto row = [&text](std::string_view label, const std::string& what) {
        text += wrapped_row(label, what);
    };
    row("format", fmt::format("{}, {}", trace.format, trace.device));
    if (trace.report.rows > 0) {
        row("rows", fmt::format("{}, used {}", trace.report.rows, all));
    } else {
        row("samples", fmt::format("{}", all));
    }
    row("rate", found.rate_hz ? fmt::format("{:.4g} Hz for {:.4g} s", *found.rate_hz,
                                            seconds(found.duration_ns))
                              : std::string("unknown"));
    row("gaps", gaps_text(found.gaps));
    if (!trace.report.clock.empty()) {
        row("clock", trace.report.clock);
    }
    row("eyes", fmt::format("left valid {:.1f} %, right {:.1f} %, both {:.1f} %",
                            percent(found.valid[0], all), percent(found.valid[1], all),
                            percent(found.both_valid, all)));
    text += quality_text(findings);
    text += events_text(findings.statistics);
    row("axes", directions_of(trace));
    row("head", found.with_head > 0 ? fmt::format("recorded with {:.1f} % of the samples",
                                                  percent(found.with_head, all))
                                    : std::string("not recorded"));
    const std::optional<std::uint64_t> lost = lost_by_tracker(trace, found);
    const bool anew = trace.report.count(gaze::TraceFindingKind::SequenceRestarted).times > 0;
    row("lost", lost   ? fmt::format("{} by the tracker", *lost)
                : anew ? std::string("unknown where the sequence begins anew")
                       : std::string("unknown: no sequence numbers that count"));
    return trace.report.rows > 0 ? text + findings_text(trace.report) : text;
}

Json gaze_json(const gaze::RecordingView& trace, const GazeFindings& findings) {
    const Samples found = look_at(trace);
    const std::size_t all = trace.samples.size();
    Json gaps = Json::array();
    for (const Gap& gap : found.gaps) {
        gaps.push_back({{"at_s", seconds(gap.after_ns)}, {"length_s", seconds(gap.length_ns)}});
    }
    Json json{{"file", trace.file},
              {"format", trace.format},
              {"device", trace.device},
              {"samples", all},
              {"rate_hz", found.rate_hz ? Json(*found.rate_hz) : Json(nullptr)},
              {"duration_s", seconds(found.duration_ns)},
              {"longest_gaps", gaps},
              {"clock", trace.report.clock.empty() ? Json(nullptr) : Json(trace.report.clock)},
              {"valid_percent",
               {{"left", percent(found.valid[0], all)},
                {"right", percent(found.valid[1], all)},
                {"both", percent(found.both_valid, all)}}},
              {"head_percent", percent(found.with_head, all)}};
    add_quality(findings, json);
    json["events"] = events_json(findings.statistics);
    json["counts"] = counts_json(trace.report);
    TraceAccount account;
    for (const std::string& event : trace_events(trace.report)) {
        account.take(frame::kTraceEvent.name, event);
    }
    account.add_to(json);
    json["directions"] = directions_of(trace);
    const std::optional<std::uint64_t> lost = lost_by_tracker(trace, found);
    json["lost"] = lost ? Json(*lost) : Json(nullptr);
    return json;
}

std::string gaze_text(const gaze::RecordingView& trace) {
    return gaze_text(trace, gaze_findings(trace));
}

Json gaze_json(const gaze::RecordingView& trace) { return gaze_json(trace, gaze_findings(trace)); }

}  // namespace gazeloop::report
