#include "runtime/doctor/eye_gaze_findings.h"

#include <fmt/core.h>

namespace gazeloop::doctor {

Findings eye_gaze_findings(const drivers::GazeGates& gates) {
    Findings findings;
    bool shut_before = false;
    for (std::size_t i = 0; i < drivers::kGazeGateCount; ++i) {
        const auto gate = static_cast<drivers::GazeGate>(i);
        const auto& state = gates.state(gate);
        Finding& finding = findings.emplace_back();
        finding.check = fmt::format("openxr.eye_gaze.{}", drivers::kGazeGateNames[i]);
        finding.facts["gate"] = drivers::describe(gate);
        if (!state) {
            finding.verdict = Verdict::NotApplicable;
            finding.found = shut_before ? "not reached: a gate before it is shut"
                                        : "shows in a running session only: gazeloop devices";
            continue;
        }
        finding.verdict = state->open ? Verdict::Ok : Verdict::Warning;
        finding.found = fmt::format("{}: {} ({})", drivers::describe(gate),
                                    state->open ? "yes" : "no", state->found);
        finding.remedy = state->open             ? ""
                         : state->remedy.empty() ? drivers::remedy(gate)
                                                 : state->remedy;
        shut_before = shut_before || !state->open;
    }
    return findings;
}

}  // namespace gazeloop::doctor
