#include "runtime/trade/sweep_rows.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "runtime/trade/choice.h"
#include "runtime/trade/equal_quality.h"
#include "runtime/trade/setting_fit.h"
#include "tests/unit/trade/made_sweep.h"

namespace gazeloop::trade {
namespace {

using testing::HasSubstr;
using tests::made_sweep;

TEST(SweepRows, SayWhatWasMeasured) {
    SweepRecord record = made_sweep();
    // The second round twice as slow, by all: medians of two rounds lie between.
    for (TimedTurn& turn : record.turns) {
        for (PointTime& time : turn.times) {
            for (double& ms : time.pass_ms) {
                ms *= turn.round == 1 ? 2.0 : 1.0;
            }
        }
    }
    const std::vector<SweepRow> rows = sheets_of(record).front().rows;
    ASSERT_EQ(rows.size(), 3U);
    EXPECT_DOUBLE_EQ(rows[1].time.median_ms, 3.0);
    EXPECT_DOUBLE_EQ(rows[1].time.least_ms, 2.0);
    EXPECT_DOUBLE_EQ(rows[1].time.greatest_ms, 4.0);
    EXPECT_DOUBLE_EQ(rows[1].speedup, 4.0);
    EXPECT_DOUBLE_EQ(rows[1].fewer_cells, 4.0);
    EXPECT_DOUBLE_EQ(rows[1].cells_over_fewest, 10.0);
    ASSERT_EQ(rows[1].pass_ms.size(), 2U);
    EXPECT_EQ(rows[1].pass_ms[1].first, "two");
    EXPECT_DOUBLE_EQ(rows[1].pass_ms[1].second, 2.25);
    for (const SweepRow& row : rows) {
        EXPECT_TRUE(row.on_cells_front && row.on_time_front);
    }
}

TEST(SweepRows, TellEnergyOfRoundsThatAreKnownWhole) {
    SweepRecord record = made_sweep(2);
    EXPECT_FALSE(sheets_of(record).front().rows[1].energy_mj);
    EXPECT_FALSE(any_energy(sheets_of(record).front().rows));
    for (TimedTurn& turn : record.turns) {
        for (PointTime& time : turn.times) {
            time.energy_j = (time.point == 0 ? 0.8 : 0.1) * (turn.round == 1 ? 3.0 : 1.0);
        }
    }
    std::vector<SweepRow> rows = sheets_of(record).front().rows;
    EXPECT_DOUBLE_EQ(rows[1].energy_mj.value(), 200.0);
    EXPECT_DOUBLE_EQ(rows[1].less_energy.value(), 8.0);
    EXPECT_DOUBLE_EQ(rows[0].less_energy.value(), 1.0);
    EXPECT_NEAR(mean_sheet(sheets_of(record)).rows[1].energy_mj.value(), 200.0, 1e-9);
    // A turn of the second round without: that round tells nothing of the point.
    record.turns[3].times[1].energy_j.reset();
    rows = sheets_of(record).front().rows;
    EXPECT_DOUBLE_EQ(rows[1].energy_mj.value(), 100.0);
    EXPECT_DOUBLE_EQ(rows[2].energy_mj.value(), 200.0);
    // Over before the counter moved: no ratio.
    for (TimedTurn& turn : record.turns) {
        turn.times[2].energy_j = 0.0;
    }
    rows = sheets_of(record).front().rows;
    EXPECT_EQ(rows[2].energy_mj, 0.0);
    EXPECT_FALSE(rows[2].less_energy);
}

// The other eye's picture may be as small as can be.
TEST(SweepRows, HoldSamplesAgainstThoseOfFullResolution) {
    SweepRecord record = made_sweep();
    record.judged[0].cells *= 0.5;
    const std::vector<SweepRow> rows = sheets_of(record).front().rows;
    EXPECT_DOUBLE_EQ(rows[0].fewer_cells, 1.0);
    EXPECT_DOUBLE_EQ(rows[1].fewer_cells, 2.0);
    record.judged[0].error = "no";
    EXPECT_TRUE(std::isnan(sheets_of(record).front().rows[1].fewer_cells));
}

TEST(SweepRows, TellNoTimeOfAPassThatDidNotRun) {
    SweepRecord record = made_sweep();
    for (TimedTurn& turn : record.turns) {
        turn.times[1].pass_ms[0] = 0.0;
    }
    const std::vector<SweepRow> rows = sheets_of(record).front().rows;
    ASSERT_EQ(rows[1].pass_ms.size(), 1U);
    EXPECT_EQ(rows[1].pass_ms.front().first, "two");
    EXPECT_EQ(rows[0].pass_ms.size(), 2U);
}

TEST(SweepRows, CountOnlyWholeRounds) {
    SweepRecord record = made_sweep();
    record.turns.pop_back();
    EXPECT_EQ(sheets_of(record).front().rows[1].error, "");
    EXPECT_DOUBLE_EQ(sheets_of(record).front().rows[1].time.median_ms, 2.0);
    record.turns.resize(1);
    EXPECT_THAT(sheets_of(record).front().rows[1].error, HasSubstr("not timed"));
    record.judged.pop_back();
    EXPECT_THAT(sheets_of(record).front().rows[2].error, HasSubstr("not measured"));
}

TEST(SweepRows, LeaveOffTheFrontWhatAnotherPointBeats) {
    SweepRecord record = made_sweep();
    record.judged[2].figures[0].mean = 1.0;  // as good as full, and cheaper than all
    const std::vector<SweepRow> rows = sheets_of(record).front().rows;
    EXPECT_FALSE(rows[0].on_cells_front);
    EXPECT_FALSE(rows[1].on_time_front);
    EXPECT_TRUE(rows[2].on_cells_front && rows[2].on_time_front);
}

TEST(SweepRows, HaveMeansOverTheCases) {
    SweepRecord record = made_sweep(2);
    for (JudgedPoint& judged : record.judged) {
        if (judged.of_case == 1 && judged.point == 1) {
            judged.cells = 12.5;
            judged.figures[0].mean = 4.0;
        }
    }
    const SweepSheet mean = mean_sheet(sheets_of(record));
    EXPECT_NEAR(mean.rows[1].fewer_cells, 8.0, 1e-12);  // of 4 and 16
    EXPECT_DOUBLE_EQ(mean.rows[1].figures.front().mean, 3.0);
    EXPECT_TRUE(mean_sheet(sheets_of(made_sweep(1))).rows.empty());
    record.judged[1] = {.of_case = 0, .point = 1, .error = "no"};
    EXPECT_FALSE(mean_sheet(sheets_of(record)).rows[1].error.empty());
}

TEST(Choice, IsTheFastestThatKeepsTheFloorOrTheBestWithinTheBudget) {
    const std::vector<SweepRow> rows = sheets_of(made_sweep()).front().rows;
    const auto chosen = [&](const ChoiceQuestion& question) {
        return choose(rows, question).value();
    };
    EXPECT_EQ(chosen({.budget_ms = 2.0}), 1U);
    EXPECT_EQ(chosen({.budget_ms = 100.0}), 0U);
    EXPECT_EQ(chosen({.budget_ms = 0.5}), std::nullopt);
    EXPECT_EQ(chosen({.floors = {{"contrast", 2.0}}}), 1U);
    EXPECT_EQ(chosen({.floors = {{"contrast", 9.0}}}), 2U);
    EXPECT_EQ(chosen({.budget_ms = 1.5, .floors = {{"contrast", 2.0}}}), std::nullopt);
    const auto unknown = choose(rows, {.floors = {{"contrats", 2.0}}});
    ASSERT_FALSE(unknown);
    EXPECT_EQ(unknown.error().kind, ErrorKind::Usage);
    EXPECT_THAT(unknown.error().message, HasSubstr("contrast"));
    for (const char* const bad : {"", "contrast", "contrast=", "contrast=a", "contrast=inf"}) {
        EXPECT_FALSE(parse_floor(bad)) << bad;
    }
    EXPECT_EQ(parse_floor("psnr_db=35").value().value, 35.0);
}

TEST(EqualQuality, IsInterpolatedBetweenAMethodsPoints) {
    const std::vector<SweepRow> rows = sheets_of(made_sweep()).front().rows;
    EXPECT_FALSE(saving_at(rows, "kfr", 1.9));  // worse than any of its points
    EXPECT_DOUBLE_EQ(saving_at(rows, "kfr", 2.0)->fewer_cells, 4.0);
    EXPECT_NEAR(saving_at(rows, "kfr", 3.0)->fewer_cells, 8.0, 1e-12);  // halfway in logarithms
    EXPECT_NEAR(saving_at(rows, "kfr", 3.0)->speedup, std::sqrt(32.0), 1e-12);
    EXPECT_NEAR(saving_at(rows, "kfr", 100.0)->speedup, 8.0, 1e-12);  // nothing beyond the cheapest
    EXPECT_FALSE(saving_at(rows, "acuity", 2.0));
    EXPECT_FALSE(saving_at({}, "kfr", 2.0));
    const EqualQuality equal = equal_quality(rows);
    EXPECT_EQ(equal.figure, "contrast");
    EXPECT_THAT(equal.levels, testing::ElementsAre(1.0, 2.0, 4.0));
    ASSERT_EQ(equal.methods.size(), 2U);
    EXPECT_FALSE(equal.methods[1].at[0]);
    EXPECT_DOUBLE_EQ(equal.methods[0].at[2]->fewer_cells, 1.0);
}

/// kfr with every sigma and alpha given, by laws that are known.
std::vector<SweepRow> lawful(const std::vector<double>& sigmas, const std::vector<double>& alphas) {
    std::vector<SweepRow> rows;
    for (const double sigma : sigmas) {
        for (const double alpha : alphas) {
            SweepRow row;
            row.point = {.method = "kfr",
                         .settings = {{"kfr.sigma", std::to_string(sigma)},
                                      {"kfr.alpha", std::to_string(alpha)}}};
            row.cells = 1e6 * std::pow(sigma, -2.0) * std::pow(alpha, 0.3);
            row.time.median_ms = 0.5 + 30e-6 * row.cells;
            row.figures = {{.key = "contrast", .meaning = "", .mean = 0.2 * std::pow(sigma, 1.5)}};
            rows.push_back(std::move(row));
        }
    }
    return rows;
}

TEST(SettingFit, FindsTheLawsThatThePointsFollow) {
    const std::vector<MethodFit> fits = setting_fits(lawful({1.0, 2.0, 3.0}, {1.0, 2.0, 4.0}));
    ASSERT_EQ(fits.size(), 1U);
    EXPECT_EQ(fits[0].points, 9U);
    ASSERT_EQ(fits[0].laws.size(), 3U);
    const PowerLaw& cells = fits[0].laws[0];
    EXPECT_NEAR(cells.factor, 1e6, 1.0);
    EXPECT_NEAR(cells.exponents[0].second, -2.0, 1e-6);
    EXPECT_NEAR(cells.exponents[1].second, 0.3, 1e-6);
    EXPECT_LT(cells.worst_percent, 1e-3);
    EXPECT_NEAR(fits[0].laws[2].exponents[0].second, 1.5, 1e-6);
    EXPECT_GT(fits[0].laws[1].standard_error_percent,
              0.1);  // a line is no power law, and the fit says so
    ASSERT_TRUE(fits[0].time);
    EXPECT_NEAR(fits[0].time->fixed_ms, 0.5, 1e-9);
    EXPECT_NEAR(fits[0].time->ns_per_cell, 30.0, 1e-9);
}

TEST(SettingFit, SaysWhyThereIsNoLaw) {
    EXPECT_TRUE(setting_fits({}).empty());
    const auto notes_of = [](const std::vector<SweepRow>& rows) {
        const std::vector<MethodFit> fits = setting_fits(rows);
        EXPECT_EQ(fits.size(), 1U);
        EXPECT_TRUE(fits.front().laws.size() < 3U);
        return testing::PrintToString(fits.front().notes);
    };
    EXPECT_THAT(notes_of(lawful({1.0, 2.0}, {1.0})), HasSubstr("one more"));
    std::vector<SweepRow> rows = lawful({1.0, 2.0, 3.0}, {1.0});
    for (SweepRow& row : rows) {
        row.point.settings = {{"kfr.kernel", row.cells > 5e5 ? "power" : "sine"}};
    }
    EXPECT_THAT(notes_of(rows), HasSubstr("kfr.kernel"));
    rows = lawful({1.0, 2.0, 3.0, 4.0}, {1.0});
    for (SweepRow& row : rows) {
        row.point.settings[1].second = row.point.settings[0].second;  // both say the same
    }
    EXPECT_THAT(notes_of(rows), HasSubstr("independently"));
    rows = lawful({1.0, 2.0, 3.0}, {1.0});
    rows[0].figures[0].mean = 0.0;
    EXPECT_THAT(notes_of(rows), HasSubstr("contrast"));
}

}  // namespace
}  // namespace gazeloop::trade
