#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "runtime/report/lag_facts.h"

namespace gazeloop::report {

/// A sentence and when it is true.
struct LagRule {
    std::string_view name;
    bool (*holds)(const LagFacts&);
    std::string (*sentence)(const LagFacts&);
};

/// What the sentences of the paragraph are about, in its order. Of each subject the first rule that
/// holds speaks; of Unknown all do.
enum class LagSubject : std::uint8_t {
    Standing,  ///< how late the gaze is, or why that cannot be said
    Cost,      ///< the stage that costs most
    Budget,    ///< whether the budget is kept
    Loss,      ///< that it is lost so often that this matters more
    Remedy,    ///< the one thing to try
    Unknown,   ///< what is unknown, why, and what would make it known
};
inline constexpr std::size_t kLagSubjectCount = 6;

[[nodiscard]] std::span<const LagRule> lag_rules(LagSubject subject);

struct LagSentence {
    std::string_view rule;
    std::string text;
};

enum class LagAnswerKind : std::uint8_t { Yes, No, CannotBeKnown };
inline constexpr std::array<std::string_view, 3> kLagAnswerNames{"yes", "no", "cannot be known"};

/// The answer to a question that users ask.
struct LagAnswer {
    std::string_view key;       ///< "smoothed", "late", "reused", "lost"
    std::string_view question;  ///< as it is asked
    LagAnswerKind kind = LagAnswerKind::CannotBeKnown;
    std::string why{};  ///< begins with a small letter and ends without a stop
};
inline constexpr std::size_t kLagQuestionCount = 4;

/// Why the fovea lags, in words.
struct LagReasons {
    std::vector<LagSentence> paragraph;
    std::array<LagAnswer, kLagQuestionCount> answers;
};

[[nodiscard]] LagReasons lag_reasons(const LagFacts& facts);
[[nodiscard]] std::array<LagAnswer, kLagQuestionCount> lag_answers(const LagFacts& facts);

/// A heading and the paragraph, at most 100 columns wide, every line ended by a newline.
[[nodiscard]] std::string lag_paragraph(const LagReasons& reasons);
/// The same with the four answers.
[[nodiscard]] std::string lag_text(const LagReasons& reasons);

/// {"paragraph": text, "rules": [names], "answers": {"smoothed": {"question", "answer", "why"},
/// ...}}.
[[nodiscard]] nlohmann::ordered_json lag_json(const LagReasons& reasons);

}  // namespace gazeloop::report
