#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "runtime/trade/sweep_record.h"

namespace gazeloop::trade {

/// A time in ms: the median of the rounds' means over the frames, and their extremes.
struct SweepTime {
    double median_ms = 0.0;
    double least_ms = 0.0;
    double greatest_ms = 0.0;
};

/// What was found of a point in one case.
struct SweepRow {
    SweepPoint point;
    std::string error;   ///< why there are no figures; all else is then empty
    double cells = 0.0;  ///< shaded per frame, both eyes; each takes as many rays as samples
    SweepTime time;      ///< of all passes of a frame
    /// How much faster than full resolution with as many samples per pixel: median of the rounds'
    /// ratios, each of one machine.
    double speedup = 0.0;
    /// What the processor takes for a frame, mJ (ProcessorEnergy), and how much less that is than
    /// for full resolution: medians of the rounds. None: no whole round has it.
    std::optional<double> energy_mj{};
    std::optional<double> less_energy{};
    /// Timed frames that waited for views of a light field before their passes, for how many, of
    /// how many frames. Points take turns: whoever comes first waits for what the next ones find.
    std::uint64_t waited_frames = 0;
    std::uint64_t waited_views = 0;
    std::uint64_t timed_frames = 0;
    double fewer_cells = 0.0;  ///< than full resolution; not a number where that failed
    /// Cells over the fewest that the comparison's acuity line asks for.
    double cells_over_fewest = 0.0;
    std::vector<std::pair<std::string, double>>
        pass_ms{};  ///< medians of the rounds, by pass that ran
    std::vector<quality::QualityFigure> figures{};
    /// Whether no other point is both cheaper (cells; time) and better by the first figure.
    bool on_cells_front = false;
    bool on_time_front = false;
    std::string picture{};   ///< see JudgedPoint
    std::string heat_map{};  ///< likewise
};

/// One case's points, full resolution first.
struct SweepSheet {
    SweepCase of;
    std::vector<SweepRow> rows;
    std::optional<quality::ContrastShares> shares{};  ///< of the scene; none: unknown
};

/// What a record says, case by case, with every point of its shard: one that was not judged, or
/// has no whole round, says so. A round counts once all of its frames are timed.
[[nodiscard]] std::vector<SweepSheet> sheets_of(const SweepRecord& record);

/// The figure of a row; null where there is none.
[[nodiscard]] const quality::QualityFigure* find_figure(const SweepRow& row, std::string_view key);
/// Whether any row has an energy.
[[nodiscard]] bool any_energy(const std::vector<SweepRow>& rows);
/// The first row that has figures tells which there are; null: none has.
[[nodiscard]] const SweepRow* row_with_figures(const std::vector<SweepRow>& rows);

/// All cases as one sheet: geometric means of what is a ratio or a cost, means of the figures, of
/// the points that have figures in all cases. Empty `rows` for fewer than two cases.
[[nodiscard]] SweepSheet mean_sheet(const std::vector<SweepSheet>& sheets);

}  // namespace gazeloop::trade
