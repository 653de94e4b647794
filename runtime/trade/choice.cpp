#include "runtime/trade/choice.h"

#include <fmt/core.h>

#include <charconv>
#include <cmath>

#include "runtime/settings/nearest_name.h"

namespace gazeloop::trade {
namespace {

bool keeps(const SweepRow& row, const QualityFloor& floor) {
    const quality::QualityFigure& figure = *find_figure(row, floor.key);
    return figure.lower_is_better ? figure.mean <= floor.value : figure.mean >= floor.value;
}

bool keeps(const SweepRow& row, const ChoiceQuestion& question) {
    if (!row.error.empty() || (question.budget_ms && row.time.median_ms > *question.budget_ms)) {
        return false;
    }
    for (const QualityFloor& floor : question.floors) {
        if (!keeps(row, floor)) {
            return false;
        }
    }
    return true;
}

/// Whether `a` is to be preferred.
bool better(const SweepRow& a, const SweepRow& b, const ChoiceQuestion& question) {
    if (!question.floors.empty()) {
        return a.time.median_ms < b.time.median_ms;
    }
    const quality::QualityFigure& of_a = a.figures.front();
    const quality::QualityFigure& of_b = b.figures.front();
    if (of_a.mean == of_b.mean) {
        return a.time.median_ms < b.time.median_ms;
    }
    return of_a.lower_is_better ? of_a.mean < of_b.mean : of_a.mean > of_b.mean;
}

}  // namespace

Expected<QualityFloor> parse_floor(const std::string& text) {
    const std::size_t equals = text.find('=');
    QualityFloor floor{.key = text.substr(0, equals)};
    const char* const end = text.data() + text.size();
    const char* const begin = equals == std::string::npos ? end : text.data() + equals + 1;
    const auto [stopped, error] = std::from_chars(begin, end, floor.value);
    if (error != std::errc{} || stopped != end || !std::isfinite(floor.value)) {
        return std::unexpected(Error{
            ErrorKind::Usage, fmt::format("'{}' must be FIGURE=NUMBER, e.g. contrast=1.5", text)});
    }
    return floor;
}

std::string ChoiceQuestion::text(const std::vector<SweepRow>& rows) const {
    std::string text;
    if (budget_ms) {
        text = fmt::format("at most {:g} ms", *budget_ms);
    }
    const SweepRow* const some = row_with_figures(rows);
    for (const QualityFloor& floor : floors) {
        const quality::QualityFigure* const figure =
            some == nullptr ? nullptr : find_figure(*some, floor.key);
        text += fmt::format("{}{} at {} {:g}", text.empty() ? "" : ", ", floor.key,
                            figure != nullptr && !figure->lower_is_better ? "least" : "most",
                            floor.value);
    }
    return text;
}

Expected<std::optional<std::size_t>> choose(const std::vector<SweepRow>& rows,
                                            const ChoiceQuestion& question) {
    if (const SweepRow* const some = row_with_figures(rows)) {
        for (const QualityFloor& floor : question.floors) {
            if (find_figure(*some, floor.key) == nullptr) {
                std::vector<std::string> keys;
                keys.reserve(some->figures.size());
                for (const quality::QualityFigure& figure : some->figures) {
                    keys.push_back(figure.key);
                }
                return std::unexpected(
                    Error{ErrorKind::Usage, settings::unknown_name("figure", floor.key, keys)});
            }
        }
    }
    std::optional<std::size_t> chosen;
    for (std::size_t row = 0; row < rows.size(); ++row) {
        if (keeps(rows[row], question) && (!chosen || better(rows[row], rows[*chosen], question))) {
            chosen = row;
        }
    }
    return chosen;
}

}  // namespace gazeloop::trade
