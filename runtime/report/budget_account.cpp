#include "runtime/report/budget_account.h"

#include <fmt/format.h>

#include <iterator>
#include <nlohmann/json.hpp>

#include "runtime/time/milliseconds.h"

namespace gazeloop::report {
namespace {

double milliseconds(std::int64_t ns) { return static_cast<double>(ns) / time::kNsPerMs; }

}  // namespace

std::string budget_account_text(const latency::MonitorSnapshot& last,
                                const latency::LatencyBudget& budget) {
    std::string text = fmt::format("budget {}\n", budget.name);
    auto out = std::back_inserter(text);
    constexpr std::string_view kRow = "{:<24}{:>12}{:>12}{:>12}{:>12}  {}\n";
    fmt::format_to(out, kRow, "", "allowed, ms", "above", "of frames", "unknown", "longest run");
    for (std::size_t i = 0; i < latency::kMonitorPartCount; ++i) {
        const latency::MonitorPart& part = last.parts[i];
        if (!part.limit_ns) {
            continue;
        }
        const bool known = part.all_known > 0;
        fmt::format_to(
            out, kRow,
            fmt::format("{}{}", i == latency::kAgePart ? "" : "  ", latency::kMonitorPartNames[i]),
            fmt::format("{:.2f}", milliseconds(*part.limit_ns)),
            known ? fmt::format("{}", part.violations) : "-", part.all_known, part.all_unknown,
            part.violations > 0 ? fmt::format("{} frames, {:.1f} ms", part.longest_run_frames,
                                              milliseconds(part.longest_run_ns))
                                : "-");
    }
    return text;
}

nlohmann::ordered_json budget_account_json(const latency::MonitorSnapshot& last,
                                           const latency::LatencyBudget& budget) {
    using Json = nlohmann::ordered_json;
    Json parts = Json::object();
    for (std::size_t i = 0; i < latency::kMonitorPartCount; ++i) {
        const latency::MonitorPart& part = last.parts[i];
        if (!part.limit_ns) {
            continue;
        }
        const bool known = part.all_known > 0;
        parts[std::string(latency::kMonitorPartKeys[i])] = {
            {"allowed_ms", milliseconds(*part.limit_ns)},
            {"frames", part.all_known},
            {"unknown", part.all_unknown},
            {"above", known ? Json(part.violations) : Json(nullptr)},
            {"longest_frames", known ? Json(part.longest_run_frames) : Json(nullptr)},
            {"longest_ms", known ? Json(milliseconds(part.longest_run_ns)) : Json(nullptr)}};
    }
    return {{"name", budget.name}, {"source", budget.source}, {"parts", parts}};
}

}  // namespace gazeloop::report
