#include "runtime/trade/part_worth.h"

#include <fmt/core.h>

#include <algorithm>
#include <nlohmann/json.hpp>

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

PartWorth worth_of(const SweepRow& row, const SweepRow& base) {
    PartWorth part{.change = row.point.settings_text(), .error = row.error};
    if (!row.error.empty()) {
        return part;
    }
    part.time = base.speedup / row.speedup;
    part.time_is_clear =
        row.time.least_ms > base.time.greatest_ms || row.time.greatest_ms < base.time.least_ms;
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

std::optional<MethodWorth> method_worth(const std::vector<SweepRow>& rows) {
    const SweepRow* const base = unchanged(rows);
    if (base == nullptr) {
        return std::nullopt;
    }
    MethodWorth worth{.method = base->point.method, .figure = base->figures.front().key};
    for (const SweepRow& row : rows) {
        if (row.point.method == base->point.method && !row.point.settings.empty()) {
            worth.parts.push_back(worth_of(row, *base));
        }
    }
    return worth;
}

std::string worth_text(const MethodWorth& worth) {
    std::string text = fmt::format(
        "\nWhat each part of {} costs and is worth: one setting changed at a time\n{:36} {:>7} "
        "{:>7} {:>12}\n",
        worth.method, "change", "time", "cells", worth.figure);
    std::string needless;
    for (const PartWorth& part : worth.parts) {
        if (part.error.empty()) {
            text += fmt::format("{:36} {:>6.2f}x {:>6.2f}x {:>12} {}\n", part.change, part.time,
                                part.cells, part.same ? "same" : fmt::format("{:+.4f}", part.loss),
                                part.verdict());
        } else {
            text += fmt::format("{:36} failed: {}\n", part.change, part.error);
        }
        if (part.is_needless()) {
            needless += " --set " + part.change;
        }
    }
    text += fmt::format(
        "time, cells: over those without the change. {}: by how much it is worse; "
        "same: no figure changes in its last bit.\n",
        worth.figure);
    text += needless.empty() ? "Nothing that is on is needless here.\n"
                             : fmt::format("Needless here, so leave it off:{}\n", needless);
    return text;
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
