#include "runtime/doctor/openxr_gaze_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <nlohmann/json.hpp>
#include <string_view>

namespace gazeloop::doctor {
namespace {

using doctor::Finding;
using doctor::Findings;
using doctor::Verdict;
using Json = nlohmann::ordered_json;

const Finding* find(const Findings& findings, std::string_view check) {
    const auto found = std::ranges::find(findings, check, &Finding::check);
    return found == findings.end() ? nullptr : &*found;
}

Json fact(const Finding* finding, const char* name) {
    return finding != nullptr && finding->facts.contains(name) ? Json(finding->facts[name])
                                                               : Json(nullptr);
}

constexpr std::string_view kVerified =
    "XR_EXT_eye_gaze_interaction: verified with an emulated tracker, not tried on hardware";

bool is_gate(const Finding& finding) { return finding.facts.contains("gate"); }

}  // namespace

std::string openxr_gaze_text(const Findings& findings) {
    std::string text;
    auto out = std::back_inserter(text);
    const Finding* const runtime = find(findings, "openxr.eye_gaze.runtime");
    fmt::format_to(
        out, "OpenXR eye gaze{}\n",
        runtime != nullptr
            ? fmt::format(": {} ({})", runtime->facts["system"].get<std::string>(), runtime->found)
            : "");
    fmt::format_to(out, "  support   {}\n", kVerified);
    for (const Finding& finding : findings) {
        if (&finding == runtime) {
            continue;
        }
        const std::string said =
            finding.verdict == Verdict::NotApplicable && is_gate(finding)
                ? fmt::format("{}: {}", finding.facts["gate"].get<std::string>(), finding.found)
                : finding.found;
        fmt::format_to(out, "  {}\n", said);
        if (!finding.remedy.empty()) {
            fmt::format_to(out, "  PROBLEM   {}\n", finding.remedy);
        }
    }
    return text;
}

Json openxr_gaze_json(const Findings& findings) {
    const Finding* const runtime = find(findings, "openxr.eye_gaze.runtime");
    const Finding* const samples = find(findings, "openxr.eye_gaze.samples");
    Json gates = Json::array();
    Json problems = Json::array();
    for (const Finding& finding : findings) {
        if (is_gate(finding)) {
            const bool reached = finding.verdict != Verdict::NotApplicable;
            gates.push_back({{"check", finding.check},
                             {"gate", finding.facts["gate"]},
                             {"open", reached ? Json(finding.verdict == Verdict::Ok) : Json()},
                             {"found", finding.found}});
        } else if (finding.verdict == Verdict::Failure) {
            problems.push_back(finding.found);
        }
        if (!finding.remedy.empty()) {
            problems.push_back(finding.remedy);
        }
    }
    return {{"source", "openxr"},
            {"name", fact(runtime, "system")},
            {"runtime", fact(runtime, "runtime")},
            {"tried_on_hardware", false},
            {"gates", gates},
            {"seconds", fact(samples, "seconds")},
            {"samples", fact(samples, "samples")},
            {"samples_with_gaze", fact(samples, "samples_with_gaze")},
            {"samples_with_time", fact(samples, "samples_with_time")},
            {"problems", problems}};
}

bool any_gaze(const Findings& findings) {
    const Json with_gaze = fact(find(findings, "openxr.eye_gaze.samples"), "samples_with_gaze");
    return with_gaze.is_number() && with_gaze.get<double>() > 0.0;
}

}  // namespace gazeloop::doctor
