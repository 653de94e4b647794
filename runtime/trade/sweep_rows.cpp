#include "runtime/trade/sweep_rows.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>

namespace gazeloop::trade {
namespace {

double median(std::vector<double> values) {
    std::ranges::sort(values);
    const std::size_t middle = values.size() / 2;
    return values.size() % 2 == 1 ? values[middle] : 0.5 * (values[middle - 1] + values[middle]);
}

std::optional<double> median_of_any(std::vector<double> values) {
    return values.empty() ? std::nullopt : std::optional(median(std::move(values)));
}

double sum(const std::vector<double>& values) {
    double total = 0.0;
    for (const double value : values) {
        total += value;
    }
    return total;
}

/// What a point took in one round, of all turns that it was part of.
struct Round {
    std::size_t frames = 0;
    double ms = 0.0;
    double full_ms = 0.0;  ///< of full resolution in the same turns
    std::vector<double> pass_ms{};
    std::uint64_t waited_frames = 0;
    std::uint64_t waited_views = 0;
    std::optional<double> energy_j{0.0};  ///< none: of one of the turns it is not known
    std::optional<double> full_j{0.0};

    void add(const PointTime& time, const PointTime& full) {
        ++frames;
        ms += sum(time.pass_ms);
        full_ms += sum(full.pass_ms);
        waited_frames += time.waited_views > 0 ? 1 : 0;
        waited_views += time.waited_views;
        energy_j =
            energy_j && time.energy_j ? std::optional(*energy_j + *time.energy_j) : std::nullopt;
        full_j = full_j && full.energy_j ? std::optional(*full_j + *full.energy_j) : std::nullopt;
        pass_ms.resize(std::max(pass_ms.size(), time.pass_ms.size()));
        for (std::size_t pass = 0; pass < time.pass_ms.size(); ++pass) {
            pass_ms[pass] += time.pass_ms[pass];
        }
    }
};

using Rounds = std::map<std::pair<std::size_t, unsigned>, Round>;  ///< by point and round

Rounds rounds_of(const SweepRecord& record, std::size_t at_case) {
    Rounds rounds;
    for (const TimedTurn& turn : record.turns) {
        const auto full = std::ranges::find(turn.times, std::size_t{0}, &PointTime::point);
        if (turn.of_case != at_case || full == turn.times.end()) {
            continue;  // without full resolution, there is no ratio
        }
        for (const PointTime& time : turn.times) {
            rounds[{time.point, turn.round}].add(time, *full);
        }
    }
    return rounds;
}

void add_times(SweepRow& row, const JudgedPoint& judged, const Rounds& rounds,
               std::uint64_t frames) {
    std::vector<double> round_ms;
    std::vector<double> ratios;
    std::vector<double> energies_mj;
    std::vector<double> energy_ratios;
    std::vector<std::vector<double>> pass_ms(judged.passes.size());
    for (auto found = rounds.lower_bound({judged.point, 0});
         found != rounds.end() && found->first.first == judged.point; ++found) {
        const Round& round = found->second;
        if (round.frames < frames || round.frames % frames != 0) {  // each shard has full's
            continue;
        }
        const auto count = static_cast<double>(round.frames);
        round_ms.push_back(round.ms / count);
        row.timed_frames += round.frames;
        row.waited_frames += round.waited_frames;
        row.waited_views += round.waited_views;
        ratios.push_back(round.ms > 0.0 ? round.full_ms / round.ms : 0.0);
        if (round.energy_j) {
            energies_mj.push_back(1e3 * *round.energy_j / count);
        }
        // A round that is over before the counter moves tells no ratio.
        if (round.energy_j && round.full_j && *round.energy_j > 0.0) {
            energy_ratios.push_back(*round.full_j / *round.energy_j);
        }
        for (std::size_t pass = 0; pass < pass_ms.size(); ++pass) {
            pass_ms[pass].push_back(pass < round.pass_ms.size() ? round.pass_ms[pass] / count
                                                                : 0.0);
        }
    }
    if (round_ms.empty()) {
        row = {.point = std::move(row.point), .error = "not timed: no round is whole", .time = {}};
        return;
    }
    row.time = {median(round_ms), std::ranges::min(round_ms), std::ranges::max(round_ms)};
    row.speedup = median(ratios);
    row.energy_mj = median_of_any(std::move(energies_mj));
    row.less_energy = median_of_any(std::move(energy_ratios));
    for (std::size_t pass = 0; pass < pass_ms.size(); ++pass) {
        // One that never ran took no time that could be told.
        if (std::ranges::max(pass_ms[pass]) > 0.0) {
            row.pass_ms.emplace_back(judged.passes[pass], median(pass_ms[pass]));
        }
    }
}

SweepRow row_of(const SweepRecord& record, std::size_t at_case, std::size_t point,
                const Rounds& rounds) {
    SweepRow row{.point = record.points[point], .error = {}, .time = {}};
    const auto judged_point = [&](std::size_t number) {
        return std::ranges::find_if(record.judged, [&](const JudgedPoint& one) {
            return one.of_case == at_case && one.point == number;
        });
    };
    const auto judged = judged_point(point);
    if (judged == record.judged.end()) {
        row.error = "not measured yet";
        return row;
    }
    if (!judged->error.empty()) {
        row.error = judged->error;
        return row;
    }
    // As they were shaded: the eyes' pictures need not be of one size.
    const auto full = judged_point(0);
    row.cells = judged->cells;
    row.fewer_cells = full != record.judged.end() && full->error.empty()
                          ? full->cells / judged->cells
                          : std::numeric_limits<double>::quiet_NaN();
    row.cells_over_fewest = judged->cells / record.cases[at_case].fewest_cells;
    row.figures = judged->figures;
    row.picture = judged->picture;
    row.heat_map = judged->heat_map;
    add_times(row, *judged, rounds, record.subject.frames);
    return row;
}

void mark_fronts(std::vector<SweepRow>& rows) {
    const auto worse_by = [](const SweepRow& row) {
        const quality::QualityFigure& figure = row.figures.front();
        return figure.lower_is_better ? figure.mean : -figure.mean;
    };
    const auto mark = [&](const auto& cost, bool SweepRow::* front) {
        for (SweepRow& row : rows) {
            row.*front = row.error.empty() && std::ranges::none_of(rows, [&](const auto& other) {
                             return other.error.empty() && cost(other) <= cost(row) &&
                                    worse_by(other) <= worse_by(row) &&
                                    (cost(other) < cost(row) || worse_by(other) < worse_by(row));
                         });
        }
    };
    mark([](const SweepRow& row) { return row.cells; }, &SweepRow::on_cells_front);
    // By ratios: shards may have been timed on other machines.
    mark([](const SweepRow& row) { return -row.speedup; }, &SweepRow::on_time_front);
}

double geometric_mean(const std::vector<double>& values) {
    double logs = 0.0;
    for (const double value : values) {
        logs += std::log(value);
    }
    return std::exp(logs / static_cast<double>(values.size()));
}

}  // namespace

std::vector<SweepSheet> sheets_of(const SweepRecord& record) {
    std::vector<SweepSheet> sheets;
    for (std::size_t at_case = 0; at_case < record.cases.size(); ++at_case) {
        const Rounds rounds = rounds_of(record, at_case);
        SweepSheet sheet{.of = record.cases[at_case], .rows = {}};
        for (std::size_t point = 0; point < record.points.size(); ++point) {
            if (!record.shard.has(point)) {
                continue;
            }
            sheet.rows.push_back(row_of(record, at_case, point, rounds));
        }
        for (const JudgedPoint& judged : record.judged) {
            if (judged.of_case == at_case && judged.shares) {
                sheet.shares = judged.shares;
            }
        }
        mark_fronts(sheet.rows);
        sheets.push_back(std::move(sheet));
    }
    return sheets;
}

const quality::QualityFigure* find_figure(const SweepRow& row, std::string_view key) {
    const auto found = std::ranges::find(row.figures, key, &quality::QualityFigure::key);
    return found == row.figures.end() ? nullptr : &*found;
}

bool any_energy(const std::vector<SweepRow>& rows) {
    return std::ranges::any_of(rows, [](const SweepRow& row) { return row.energy_mj.has_value(); });
}

const SweepRow* row_with_figures(const std::vector<SweepRow>& rows) {
    const auto found =
        std::ranges::find_if(rows, [](const SweepRow& row) { return !row.figures.empty(); });
    return found == rows.end() ? nullptr : &*found;
}

SweepSheet mean_sheet(const std::vector<SweepSheet>& sheets) {
    SweepSheet all{.of = {.scene = "all", .gaze = "all"}, .rows = {}};
    if (sheets.size() < 2) {
        return all;
    }
    for (std::size_t at = 0; at < sheets.front().rows.size(); ++at) {
        const auto mean = [&](const auto& of_row) {
            std::vector<double> values;
            values.reserve(sheets.size());
            for (const SweepSheet& sheet : sheets) {
                values.push_back(of_row(sheet.rows[at]));
            }
            return geometric_mean(values);
        };
        SweepRow row{.point = sheets.front().rows[at].point, .error = {}, .time = {}};
        if (std::ranges::any_of(
                sheets, [&](const SweepSheet& sheet) { return !sheet.rows[at].error.empty(); })) {
            row.error = "has no figures in every case";
            all.rows.push_back(std::move(row));
            continue;
        }
        row.cells = mean([](const SweepRow& one) { return one.cells; });
        row.fewer_cells = mean([](const SweepRow& one) { return one.fewer_cells; });
        row.cells_over_fewest = mean([](const SweepRow& one) { return one.cells_over_fewest; });
        row.speedup = mean([](const SweepRow& one) { return one.speedup; });
        row.time = {mean([](const SweepRow& one) { return one.time.median_ms; }),
                    mean([](const SweepRow& one) { return one.time.least_ms; }),
                    mean([](const SweepRow& one) { return one.time.greatest_ms; })};
        const auto mean_of_known = [&](std::optional<double> SweepRow::* known) {
            const bool all_known = std::ranges::all_of(sheets, [&](const SweepSheet& sheet) {
                return (sheet.rows[at].*known).has_value();
            });
            return all_known
                       ? std::optional(mean([&](const SweepRow& one) { return *(one.*known); }))
                       : std::nullopt;
        };
        row.energy_mj = mean_of_known(&SweepRow::energy_mj);
        row.less_energy = mean_of_known(&SweepRow::less_energy);
        for (const SweepSheet& sheet : sheets) {
            row.timed_frames += sheet.rows[at].timed_frames;
            row.waited_frames += sheet.rows[at].waited_frames;
            row.waited_views += sheet.rows[at].waited_views;
        }
        row.figures = sheets.front().rows[at].figures;
        for (std::size_t i = 1; i < sheets.size(); ++i) {
            for (quality::QualityFigure& figure : row.figures) {
                const quality::QualityFigure& other = *find_figure(sheets[i].rows[at], figure.key);
                figure.mean += other.mean;
                const bool worse = figure.lower_is_better ? other.worst > figure.worst
                                                          : other.worst < figure.worst;
                if (worse) {
                    figure.worst = other.worst;
                    figure.worst_frame = other.worst_frame;
                }
            }
        }
        for (quality::QualityFigure& figure : row.figures) {
            figure.mean /= static_cast<double>(sheets.size());
        }
        all.rows.push_back(std::move(row));
    }
    mark_fronts(all.rows);
    return all;
}

}  // namespace gazeloop::trade
