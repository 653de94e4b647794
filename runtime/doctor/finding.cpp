#include "runtime/doctor/finding.h"

#include <fmt/core.h>

#include <algorithm>

namespace gazeloop::doctor {
namespace {

std::ptrdiff_t count(std::span<const Finding> findings, Verdict verdict) {
    return std::ranges::count(findings, verdict, &Finding::verdict);
}

}  // namespace

void to_json(nlohmann::json& json, const Finding& finding) {
    json = {{"check", finding.check}, {"verdict", name(finding.verdict)},
            {"found", finding.found}, {"remedy", finding.remedy},
            {"facts", finding.facts}, {"stops_loop", finding.stops_loop}};
}

void from_json(const nlohmann::json& json, Finding& finding) {
    const auto verdict = std::ranges::find(kVerdictNames, json.at("verdict").get<std::string>());
    finding.verdict = verdict == kVerdictNames.end()
                          ? Verdict::Failure
                          : static_cast<Verdict>(verdict - kVerdictNames.begin());
    json.at("check").get_to(finding.check);
    json.at("found").get_to(finding.found);
    json.at("remedy").get_to(finding.remedy);
    json.at("stops_loop").get_to(finding.stops_loop);
    finding.facts = json.at("facts");
}

bool loop_can_run(std::span<const Finding> findings) {
    return std::ranges::none_of(findings, [](const Finding& finding) {
        return finding.verdict == Verdict::Failure && finding.stops_loop;
    });
}

std::string findings_text(std::span<const Finding> findings) {
    std::string stopping;
    for (const Finding& finding : findings) {
        if (finding.verdict == Verdict::Failure && finding.stops_loop) {
            stopping += fmt::format("{}{}", stopping.empty() ? "" : ", ", finding.check);
        }
    }
    std::string text =
        fmt::format("{}; ok {}, warnings {}, failures {}\n\n",
                    stopping.empty() ? "the loop can run" : "THE LOOP CANNOT RUN: " + stopping,
                    count(findings, Verdict::Ok), count(findings, Verdict::Warning),
                    count(findings, Verdict::Failure));
    std::size_t width = 0;
    for (const Finding& finding : findings) {
        width = std::max(width, finding.check.size());
    }
    for (const Finding& finding : findings) {
        const std::string_view verdict =
            finding.verdict == Verdict::NotApplicable ? "-" : name(finding.verdict);
        text += fmt::format("{:8} {:{}}  {}\n", verdict, finding.check, width, finding.found);
        if (!finding.remedy.empty()) {
            text += fmt::format("{:8} {:{}}  -> {}\n", "", "", width, finding.remedy);
        }
    }
    return text;
}

nlohmann::json findings_json(std::span<const Finding> findings) {
    return {{"loop_can_run", loop_can_run(findings)},
            {"counts",
             {{"ok", count(findings, Verdict::Ok)},
              {"warning", count(findings, Verdict::Warning)},
              {"failure", count(findings, Verdict::Failure)},
              {"not applicable", count(findings, Verdict::NotApplicable)}}},
            {"checks", findings}};
}

}  // namespace gazeloop::doctor
