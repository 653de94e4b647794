#include "runtime/report/page/report_sections.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string_view>

#include "runtime/time/milliseconds.h"

namespace gazeloop::report::page {
namespace {

constexpr std::array<std::string_view, 3> kVerdicts{"kept", "broken", "not judgeable"};

std::string trimmed(const std::string& label) {
    return label.substr(std::min(label.find_first_not_of(' '), label.size()));
}

std::vector<std::string> row_of(const std::string& label, std::string_view figure,
                                const statistics::Difference& difference) {
    return {fmt::format("{}, {}", trimmed(label), figure),
            fmt::format("{:.2f}", difference.before),
            fmt::format("{:.2f}", difference.after),
            fmt::format("{:+.3f}", difference.change()),
            fmt::format("{:+.3f} to {:+.3f}", difference.low, difference.high),
            difference.may_be_chance() ? "may be chance" : "changed"};
}

}  // namespace

std::vector<std::string> why_of(const LagReasons& reasons) {
    std::vector<std::string> texts(1);
    for (const LagSentence& sentence : reasons.paragraph) {
        texts.front() += texts.front().empty() ? sentence.text : " " + sentence.text;
    }
    for (const LagAnswer& answer : reasons.answers) {
        texts.push_back(fmt::format("{} {}: {}.", answer.question,
                                    kLagAnswerNames[static_cast<std::size_t>(answer.kind)],
                                    answer.why));
    }
    return texts;
}

PageSection section_of(const BudgetGate& gate) {
    PageSection section{.id = "budget",
                        .title = fmt::format("Budget {}", gate.budget),
                        .paragraphs = {},
                        .heads = {"part", "p95 (ms)", "allowed (ms)", "frames that know it", ""}};
    for (const GatePart& part : gate.parts) {
        section.rows.push_back(
            {std::string(part.name), part.p95_ms ? fmt::format("{:.2f}", *part.p95_ms) : "-",
             fmt::format("{:.2f}", static_cast<double>(part.allowed_ns) / time::kNsPerMs),
             fmt::format("{} of {}", part.known, gate.with_gaze),
             std::string(kVerdicts[static_cast<std::size_t>(part.verdict)])});
    }
    return section;
}

PageSection section_of(const PredictionTable& prediction) {
    PageSection section{.id = "prediction",
                        .title = "Prediction from the parts",
                        .paragraphs = prediction.notes,
                        .heads = {"milliseconds"}};
    section.heads.insert(section.heads.end(), PredictionTable::kHeads.begin(),
                         PredictionTable::kHeads.end());
    for (const PredictionTable::Row& row : prediction.rows) {
        section.rows.push_back({row.label});
        section.rows.back().insert(section.rows.back().end(), row.cells.begin(), row.cells.end());
    }
    return section;
}

PageSection section_of_lines(std::string id, std::string title, std::string_view lines) {
    const std::size_t first = std::min(lines.find_first_not_of('\n'), lines.size());
    lines.remove_prefix(first);
    lines = lines.substr(0, lines.find_last_not_of('\n') + 1);
    return {.id = std::move(id), .title = std::move(title), .lines = std::string(lines)};
}

PageSection section_of(const Comparison& comparison, const Percentiles& percentiles,
                       const std::string& before) {
    PageSection section{
        .id = "against",
        .title = fmt::format("Compared with {}", before),
        .paragraphs = comparison.doubts,
        .heads = {"ms, degrees or counts", "before", "now", "change",
                  fmt::format("{:.0f} % interval", 100.0 * comparison.options.level), ""}};
    const std::vector<std::string> names = percentiles.names();
    for (const ComparedRow& row : comparison.rows) {
        if (!row.refused.empty()) {
            section.rows.push_back(
                {trimmed(row.name.label), "-", "-", "-", "-", "not compared: " + row.refused});
            continue;
        }
        if (row.mean) {
            section.rows.push_back(row_of(row.name.label, "mean", *row.mean));
        }
        for (std::size_t place = 0; place < row.percentiles.size(); ++place) {
            if (row.percentiles[place]) {
                section.rows.push_back(
                    row_of(row.name.label, names[place], *row.percentiles[place]));
            }
        }
    }
    return section;
}

}  // namespace gazeloop::report::page
