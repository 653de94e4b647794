#include "runtime/report/lag_reasons.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "runtime/report/wrapped_row.h"

namespace gazeloop::report {

LagReasons lag_reasons(const LagFacts& facts) {
    LagReasons reasons{.paragraph = {}, .answers = lag_answers(facts)};
    for (std::size_t subject = 0; subject < kLagSubjectCount; ++subject) {
        for (const LagRule& rule : lag_rules(LagSubject{static_cast<std::uint8_t>(subject)})) {
            if (!rule.holds(facts)) {
                continue;
            }
            reasons.paragraph.push_back({.rule = rule.name, .text = rule.sentence(facts)});
            if (LagSubject{static_cast<std::uint8_t>(subject)} != LagSubject::Unknown) {
                break;
            }
        }
    }
    return reasons;
}

namespace {

std::string paragraph_of(const LagReasons& reasons) {
    std::string text;
    for (const LagSentence& sentence : reasons.paragraph) {
        text += (text.empty() ? "" : " ") + sentence.text;
    }
    return text;
}

}  // namespace

std::string lag_paragraph(const LagReasons& reasons) {
    return "why does the fovea lag?\n" + wrapped_row("", paragraph_of(reasons), 2);
}

std::string lag_text(const LagReasons& reasons) {
    std::string text = lag_paragraph(reasons);
    for (const LagAnswer& answer : reasons.answers) {
        const auto& name = kLagAnswerNames[static_cast<std::size_t>(answer.kind)];
        text += wrapped_row("  -", fmt::format("{} {}: {}.", answer.question, name, answer.why), 4);
    }
    return text;
}

nlohmann::ordered_json lag_json(const LagReasons& reasons) {
    using Json = nlohmann::ordered_json;
    Json rules = Json::array();
    for (const LagSentence& sentence : reasons.paragraph) {
        rules.push_back(sentence.rule);
    }
    Json answers = Json::object();
    for (const LagAnswer& answer : reasons.answers) {
        answers[std::string(answer.key)] = {
            {"question", answer.question},
            {"answer", kLagAnswerNames[static_cast<std::size_t>(answer.kind)]},
            {"why", answer.why}};
    }
    return {{"paragraph", paragraph_of(reasons)}, {"rules", rules}, {"answers", answers}};
}

}  // namespace gazeloop::report
