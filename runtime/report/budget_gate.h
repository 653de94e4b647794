#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "runtime/error.h"
#include "runtime/latency/budget.h"
#include "runtime/latency/latency_summary.h"

namespace gazeloop::report {

enum class GateVerdict : std::uint8_t { Kept, Broken, NotJudgeable };

struct GatePart {
    std::string_view name;  ///< for people
    std::string_view key;   ///< for programs
    std::int64_t allowed_ns = 0;
    std::optional<double> p95_ms{};  ///< over the whole session; none: withheld
    std::uint64_t known = 0;         ///< frames that know the part
    GateVerdict verdict = GateVerdict::NotJudgeable;
};

/// A session held against a budget, for whoever has a program decide by the exit code.
///
/// A part is *broken* when its 95th percentile, over the frames with fresh gaze that know it, is
/// above what is allowed. It is *kept* when that is not above, and at least 95 of 100 frames with
/// fresh gaze know it: of the others nobody can say that they kept it. Else it is *not judgeable*,
/// and so is a part whose percentile is withheld, which needs 20 frames. The budget is kept when
/// every limited part is.
struct BudgetGate {
    std::string budget;
    std::vector<GatePart> parts;  ///< the limited ones: the total, then stages in their order
    std::uint64_t with_gaze = 0;  ///< frames whose foveae rest on a fresh sample
    latency::Verdict pace = latency::Verdict::Unknown;  ///< of the run

    /// Error (GateFailed) where the budget is broken or cannot be judged: says which parts and why.
    [[nodiscard]] Expected<void> result() const;
};

[[nodiscard]] BudgetGate budget_gate(const latency::SummaryReport& report,
                                     const latency::LatencyBudget& budget);

/// A line for each part, at most 100 columns wide, and one for the verdict.
[[nodiscard]] std::string gate_text(const BudgetGate& gate);
[[nodiscard]] nlohmann::ordered_json gate_json(const BudgetGate& gate);

}  // namespace gazeloop::report
