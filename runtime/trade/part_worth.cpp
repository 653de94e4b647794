#include "runtime/trade/part_worth.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string_view>

namespace gazeloop::trade {
namespace {

/// The row that the others are changes of; null: the rows are not of such a sweep.
const SweepRow* unchanged(const std::vector<SweepRow>& rows) {
    if (rows.size() < 2) {
        return nullptr;
    }
    const std::string& method = rows.back().point.method;
    const SweepRow* found = nullptr;
    for (const SweepRow& row : rows) {
        const bool is_reference = &row == &rows.front() && method != "full";
        if (is_reference) {
            continue;
        }
        if (row.point.method != method || row.point.settings.size() > 1) {
            return nullptr;
        }
        if (row.point.settings.empty()) {
            found = &row;
        }
    }
    return found != nullptr && found != &rows.back() && found->error.empty() ? found : nullptr;
}

/// PSNR of equal pictures is infinite, and equal to itself.
bool same_figures(const SweepRow& a, const SweepRow& b) {
    return std::ranges::equal(
        a.figures, b.figures,
        [](const quality::QualityFigure& one, const quality::QualityFigure& other) {
            return one.key == other.key && one.mean == other.mean && one.worst == other.worst;
        });
}

/// Whether a change as worth_points() makes it switches something off: a filter's size is changed
/// to the least only.
bool takes_away(const std::string& key, const std::string& value) {
    constexpr std::array<std::string_view, 4> kOff{"false", "nothing", "none", "off"};
    const bool is_size = std::ranges::all_of(value, [](char c) { return c >= '0' && c <= '9'; });
    return std::ranges::find(kOff, value) != kOff.end() || (is_filter(key) && is_size);
}

PartWorth worth_of(const SweepRow& row, const SweepRow& base, unsigned rounds) {
    const auto& [key, value] = row.point.settings.front();
    PartWorth part{.change = row.point.settings_text(),
                   .error = row.error,
                   .takes_away = takes_away(key, value)};
    if (!row.error.empty()) {
        return part;
    }
    part.time = base.speedup / row.speedup;
    constexpr unsigned kLeastRounds = 3;
    constexpr double kLeastChange = 0.03;
    part.time_is_clear =
        rounds >= kLeastRounds && std::abs(part.time - 1.0) > kLeastChange &&
        (row.time.least_ms > base.time.greatest_ms || row.time.greatest_ms < base.time.least_ms);
    part.cells = row.cells / base.cells;
    part.same = same_figures(row, base);
    const quality::QualityFigure& figure = row.figures.front();
    const double more = figure.mean - base.figures.front().mean;
    part.loss = part.same ? 0.0 : figure.lower_is_better ? more : -more;
    return part;
}

std::string change_of_time(const PartWorth& part) {
    return fmt::format("{:.0f} % of the time", 100.0 * std::abs(1.0 - part.time));
}

}  // namespace

std::string PartWorth::verdict() const {
    if (!error.empty()) {
        return error;
    }
    if (same) {
        return !time_is_clear ? "changes no picture"
               : time < 1.0   ? "changes no picture, and saves " + change_of_time(*this)
                              : "changes no picture, and costs " + change_of_time(*this);
    }
    const bool saves = time_is_clear && time < 1.0;
    const bool costs = time_is_clear && time > 1.0;
    if (loss > 0.0) {
        return saves   ? "a trade: worse, and saves " + change_of_time(*this)
               : costs ? "worse, and dearer"
                       : "worse";
    }
    return costs   ? "a trade: better, and costs " + change_of_time(*this)
           : saves ? "better, and saves " + change_of_time(*this)
                   : "better";
}

std::optional<MethodWorth> method_worth(const SweepSubject& subject,
                                        const std::vector<SweepRow>& rows) {
    const SweepRow* const base = unchanged(rows);
    if (base == nullptr) {
        return std::nullopt;
    }
    MethodWorth worth{.method = base->point.method,
                      .figure = base->figures.front().key,
                      .still = subject.frames == 1};
    for (const SweepRow& row : rows) {
        if (row.point.method == base->point.method && !row.point.settings.empty()) {
            worth.parts.push_back(worth_of(row, *base, subject.rounds));
        }
    }
    return worth;
}

std::string worth_note(const MethodWorth& worth) {
    std::string needless;
    for (const PartWorth& part : worth.parts) {
        needless += part.is_needless() ? " --set " + part.change : std::string();
    }
    std::string text =
        worth.still ? "One frame shows nothing of what needs several: what is kept, and what is "
                      "mixed with it. --frames 8 would. "
                    : "";
    return text + (needless.empty() ? "Nothing that is on is needless here."
                                    : fmt::format("Needless here, so leave it off:{}", needless));
}

std::string worth_text(const MethodWorth& worth) {
    std::string text = fmt::format(
        "\nWhat each part of {} costs and is worth: one setting changed at a time\n{:36} {:>7} "
        "{:>7} {:>12}\n",
        worth.method, "change", "time", "cells", worth.figure);
    for (const PartWorth& part : worth.parts) {
        if (part.error.empty()) {
            text += fmt::format("{:36} {:>6.2f}x {:>6.2f}x {:>12} {}\n", part.change, part.time,
                                part.cells, part.same ? "same" : fmt::format("{:+.4f}", part.loss),
                                part.verdict());
        } else {
            text += fmt::format("{:36} failed: {}\n", part.change, part.error);
        }
    }
    return text + fmt::format(
                      "time, cells: over those without the change. {}: by how much it is "
                      "worse; same: no figure changes in its last bit.\n{}\n",
                      worth.figure, worth_note(worth));
}

nlohmann::ordered_json worth_json(const MethodWorth& worth) {
    auto parts = nlohmann::ordered_json::array();
    for (const PartWorth& part : worth.parts) {
        nlohmann::ordered_json entry{{"change", part.change}};
        if (!part.error.empty()) {
            entry["error"] = part.error;
        } else {
            entry["time"] = part.time;
            entry["time_is_clear"] = part.time_is_clear;
            entry["cells"] = part.cells;
            entry["same_pictures"] = part.same;
            entry["loss"] = part.loss;
            entry["needless"] = part.is_needless();
        }
        parts.push_back(std::move(entry));
    }
    return {{"method", worth.method}, {"figure", worth.figure}, {"parts", std::move(parts)}};
}

}  // namespace gazeloop::trade
