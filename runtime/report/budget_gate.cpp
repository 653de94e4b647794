#include "runtime/report/budget_gate.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <nlohmann/json.hpp>

#include "runtime/latency/monitor_snapshot.h"
#include "runtime/time/milliseconds.h"

namespace gazeloop::report {
namespace {

constexpr std::array<std::string_view, 3> kVerdictKeys{"kept", "broken", "not-judgeable"};
constexpr std::array<std::string_view, 3> kVerdictNames{"kept", "BROKEN", "not judgeable"};

double allowed_ms(const GatePart& part) {
    return static_cast<double>(part.allowed_ns) / time::kNsPerMs;
}

GateVerdict verdict_of(const GatePart& part, std::uint64_t with_gaze) {
    if (!part.p95_ms) {
        return GateVerdict::NotJudgeable;
    }
    if (*part.p95_ms > allowed_ms(part)) {
        return GateVerdict::Broken;
    }
    const double unknown = static_cast<double>(with_gaze - std::min(part.known, with_gaze));
    return 100.0 * unknown > 5.0 * static_cast<double>(with_gaze) ? GateVerdict::NotJudgeable
                                                                  : GateVerdict::Kept;
}

/// Digits by which what was measured and what is allowed differ, if they differ at all.
int digits(const GatePart& part) {
    constexpr int kUsual = 2;
    constexpr int kMost = 6;  // nanoseconds
    int digits = kUsual;
    while (digits < kMost && part.p95_ms && *part.p95_ms != allowed_ms(part) &&
           fmt::format("{:.{}f}", *part.p95_ms, digits) ==
               fmt::format("{:.{}f}", allowed_ms(part), digits)) {
        ++digits;
    }
    return digits;
}

std::string measured(const GatePart& part) {
    return part.p95_ms ? fmt::format("{:.{}f}", *part.p95_ms, digits(part)) : "-";
}

std::string allowed(const GatePart& part) {
    return fmt::format("{:.{}f}", allowed_ms(part), digits(part));
}

/// Why a part is not kept.
std::string reason(const GatePart& part, std::uint64_t with_gaze) {
    if (part.verdict == GateVerdict::Broken) {
        return fmt::format("{}: p95 {} ms, allowed {} ms", part.name, measured(part),
                           allowed(part));
    }
    return fmt::format("{}: only {} of {} frames with gaze know it", part.name, part.known,
                       with_gaze);
}

}  // namespace

BudgetGate budget_gate(const latency::SummaryReport& report, const latency::LatencyBudget& budget) {
    BudgetGate gate{.budget = budget.name,
                    .parts = {},
                    .with_gaze = report.frames.with_gaze(),
                    .pace = report.verdict};
    const auto add = [&gate](std::size_t index, const std::optional<std::int64_t>& allowed_ns,
                             const latency::DurationRow& row) {
        if (allowed_ns) {
            GatePart part{.name = latency::kMonitorPartNames[index],
                          .key = latency::kMonitorPartKeys[index],
                          .allowed_ns = *allowed_ns,
                          .p95_ms = row.p95_ms,
                          .known = row.count};
            part.verdict = verdict_of(part, gate.with_gaze);
            gate.parts.push_back(part);
        }
    };
    add(latency::kAgePart, budget.total_ns, report.gaze_age_at_display);
    for (std::size_t stage = 0; stage < latency::kStageCount; ++stage) {
        add(latency::kFirstStagePart + stage, budget.stages_ns[stage], report.stages[stage]);
    }
    return gate;
}

Expected<void> BudgetGate::result() const {
    std::vector<std::string> broken;
    std::vector<std::string> unjudged;
    for (const GatePart& part : parts) {
        if (part.verdict != GateVerdict::Kept) {
            (part.verdict == GateVerdict::Broken ? broken : unjudged)
                .push_back(reason(part, with_gaze));
        }
    }
    if (!broken.empty()) {
        return std::unexpected(
            Error{ErrorKind::GateFailed,
                  fmt::format("budget {} broken: {}", budget, fmt::join(broken, "; "))});
    }
    if (!unjudged.empty()) {
        return std::unexpected(Error{
            ErrorKind::GateFailed,
            fmt::format("budget {} not judgeable: {}. 20 frames and 95 % of those with gaze must: "
                        "record for longer, with a tracker and a display that tell their times",
                        budget, fmt::join(unjudged, "; "))});
    }
    return {};
}

std::string gate_text(const BudgetGate& gate) {
    std::string text = fmt::format("budget {}\n", gate.budget);
    auto out = std::back_inserter(text);
    constexpr std::string_view kRow = "{:<24}{:>12}{:>12}{:>12}{:>12}  {}\n";
    fmt::format_to(out, kRow, "", "p95, ms", "allowed, ms", "known", "with gaze", "verdict");
    for (const GatePart& part : gate.parts) {
        const bool stage = part.key != latency::kMonitorPartKeys[latency::kAgePart];
        fmt::format_to(out, kRow, fmt::format("{}{}", stage ? "  " : "", part.name), measured(part),
                       allowed(part), part.known, gate.with_gaze,
                       kVerdictNames[static_cast<std::size_t>(part.verdict)]);
    }
    if (gate.pace == latency::Verdict::VirtualTime) {
        text += "These are modelled times of a virtual run: they say nothing of a headset.\n";
    } else if (gate.pace == latency::Verdict::NotRealTime) {
        text += "The run did not keep up with its display: a headset's figures would be others.\n";
    }
    return text;
}

nlohmann::ordered_json gate_json(const BudgetGate& gate) {
    using Json = nlohmann::ordered_json;
    Json parts = Json::object();
    for (const GatePart& part : gate.parts) {
        parts[std::string(part.key)] = {
            {"p95_ms", part.p95_ms ? Json(*part.p95_ms) : Json(nullptr)},
            {"allowed_ms", allowed_ms(part)},
            {"known", part.known},
            {"verdict", kVerdictKeys[static_cast<std::size_t>(part.verdict)]}};
    }
    return {{"name", gate.budget},
            {"kept", gate.result().has_value()},
            {"frames_with_gaze", gate.with_gaze},
            {"parts", parts}};
}

}  // namespace gazeloop::report
