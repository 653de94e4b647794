#include "runtime/trade/measured_front.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace gazeloop::trade {
namespace {

/// Levels by their places; the first and the last stay.
std::vector<governor::Level> thinned(const std::vector<governor::Level>& all) {
    if (all.size() <= governor::kMostLevels) {
        return all;
    }
    std::vector<governor::Level> kept;
    std::size_t next = 0;
    for (std::size_t i = 0; i < governor::kMostLevels; ++i) {
        const double share = static_cast<double>(i) / (governor::kMostLevels - 1);
        const double wanted =
            std::log(all.front().ms) + share * std::log(all.back().ms / all.front().ms);
        const std::size_t last = all.size() - (governor::kMostLevels - 1 - i);  // leaves the rest
        std::size_t nearest = next;
        for (std::size_t at = next; at < last; ++at) {
            if (std::abs(std::log(all[at].ms) - wanted) <
                std::abs(std::log(all[nearest].ms) - wanted)) {
                nearest = at;
            }
        }
        kept.push_back(all[nearest]);
        next = nearest + 1;
    }
    return kept;
}

}  // namespace

Expected<governor::Front> measured_front(const SweepReport& report) {
    const std::vector<SweepRow>& rows = report.summed_rows();
    const SweepRow* const some = row_with_figures(rows);
    if (some == nullptr) {
        return std::unexpected(
            Error{ErrorKind::Usage, "--front: no point has figures: it has no points"});
    }
    const quality::QualityFigure& figure = some->figures.front();
    if (!figure.lower_is_better) {
        return std::unexpected(Error{
            ErrorKind::Usage,
            fmt::format("--front: of {} higher is better, and a governor's floors are losses: "
                        "put --metric contrast or --metric flip first",
                        figure.key)});
    }
    const double full_ms = rows.front().time.median_ms;
    std::vector<governor::Level> levels;
    for (const SweepRow& row : rows) {
        if (row.on_time_front) {
            levels.push_back({.method = row.point.method,
                              .settings = row.point.settings,
                              .ms = full_ms / row.speedup,
                              .loss = row.figures.front().mean});
        }
    }
    std::ranges::sort(levels, {}, &governor::Level::loss);
    // Points that are equal in both are on a front together.
    const auto [same, end] = std::ranges::unique(levels, {}, &governor::Level::loss);
    levels.erase(same, end);
    governor::Front front{.figure = figure.key, .levels = thinned(levels)};
    if (const auto fault = governor::fault_of(front)) {
        return std::unexpected(Error{ErrorKind::Usage, fmt::format("--front: {}", fault->message)});
    }
    return front;
}

std::string front_source(const SweepReport& report) {
    const SweepSubject& subject = report.subject;
    return fmt::format(
        "Made by: {}\n{}, {}x{} px per eye, {} sample{} per cell, {} round{}, on {}.\n"
        "ms: of a frame, both eyes; loss: the figure against full resolution with {} samples.",
        report.command_line, subject.display, subject.width_px, subject.height_px, subject.samples,
        subject.samples == 1 ? "" : "s", subject.rounds, subject.rounds == 1 ? "" : "s",
        subject.device, subject.reference_samples);
}

}  // namespace gazeloop::trade
