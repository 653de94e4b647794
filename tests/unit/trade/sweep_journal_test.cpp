#include "runtime/trade/sweep_journal.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <limits>

#include "runtime/trade/journal_lines.h"
#include "runtime/trade/sweep_report.h"
#include "tests/support/temporary_folder.h"
#include "tests/unit/trade/made_sweep.h"

namespace gazeloop::trade {
namespace {

using testing::HasSubstr;
using tests::made_sweep;

/// What is asked for, of which nothing is measured.
SweepRecord asked() {
    SweepRecord record = made_sweep();
    record.judged.clear();
    record.turns.clear();
    return record;
}

std::string text_of(const SweepRecord& record) {
    std::string text = header_line(record) + '\n';
    for (const JudgedPoint& judged : record.judged) {
        text += judged_line(judged) + '\n';
    }
    for (const TimedTurn& turn : record.turns) {
        text += turn_line(turn) + '\n';
    }
    return text;
}

TEST(SweepJournal, GivesBackAllThatItWasTold) {
    const tests::TemporaryFolder folder;
    SweepRecord record = made_sweep(2);
    record.judged[1].figures[0].mean = std::numeric_limits<double>::infinity();
    record.judged[1].picture = "aGVsbG8=";
    record.judged[2] = {.of_case = 0, .point = 2, .error = "cannot be\nrendered"};
    for (std::size_t turn = 0; turn < 4; ++turn) {  // of the first case, all but one
        for (PointTime& time : record.turns[turn].times) {
            time.energy_j = 0.1 + 0.01 * static_cast<double>(time.point);
        }
    }
    record.turns[2].times[1].energy_j.reset();
    record.turns[1].times[2].waited_views = 12;
    record.judged[0].shares = {.kept = 0.25, .between = 0.5, .beyond = 0.25, .contrast = 0.125};
    record.judged[0].reference_hash = 0xFEDCBA9876543210;
    {
        SweepRecord nothing = record;
        nothing.judged.clear();
        nothing.turns.clear();
        auto journal = SweepJournal::open(folder / "j", std::move(nothing));
        ASSERT_TRUE(journal) << journal.error().message;
        for (const JudgedPoint& judged : record.judged) {
            ASSERT_TRUE(journal->add(judged));
        }
        for (const TimedTurn& turn : record.turns) {
            ASSERT_TRUE(journal->add(turn));
        }
    }
    const auto read = read_journal(folder / "j");
    ASSERT_TRUE(read) << read.error().message;
    EXPECT_EQ(difference_of(*read, record), "");
    EXPECT_EQ(text_of(*read), text_of(record));
    EXPECT_EQ(read->judged[0].reference_hash, record.judged[0].reference_hash);
    EXPECT_EQ(read->torn_bytes, 0U);
    EXPECT_EQ(read->turns[1].times[2].waited_views, 12U);
    // Reports of both are the same, to the last bit.
    EXPECT_EQ(sweep_csv(report_of(*read)), sweep_csv(report_of(record)));
}

TEST(SweepJournal, GoesOnAfterAnyCut) {
    const tests::TemporaryFolder folder;
    const SweepRecord whole = made_sweep();
    const std::string text = text_of(whole);
    for (std::size_t cut = 0; cut <= text.size(); cut += cut + 40 < text.size() ? 37 : 1) {
        std::ofstream(folder / "j") << text.substr(0, cut);
        auto journal = SweepJournal::open(folder / "j", asked());
        ASSERT_TRUE(journal) << cut << ": " << journal.error().message;
        const std::size_t judged = journal->record().judged.size();
        const std::size_t turns = journal->record().turns.size();
        for (std::size_t i = judged; i < whole.judged.size(); ++i) {
            ASSERT_TRUE(journal->add(whole.judged[i]));
        }
        for (std::size_t i = turns; i < whole.turns.size(); ++i) {
            ASSERT_TRUE(journal->add(whole.turns[i]));
        }
        const auto read = read_journal(folder / "j");
        ASSERT_TRUE(read) << cut << ": " << read.error().message;
        ASSERT_EQ(text_of(*read), text) << cut;
    }
}

TEST(SweepJournal, IsOfOneSweepAndOneWriter) {
    const tests::TemporaryFolder folder;
    std::ofstream(folder / "j") << text_of(made_sweep());
    const auto refused = [&](SweepRecord other, const char* why) {
        const auto journal = SweepJournal::open(folder / "j", std::move(other));
        ASSERT_FALSE(journal) << why;
        EXPECT_EQ(journal.error().kind, ErrorKind::BadInput);
        EXPECT_THAT(journal.error().message, HasSubstr(why));
    };
    SweepRecord other = asked();
    other.subject.samples = 1;
    refused(other, "samples");
    other = asked();
    other.points[1].settings[0].second = "3";
    refused(other, "kfr.sigma=3");
    other = asked();
    other.cases[0].scene = "gallery";
    refused(other, "gallery");
    other = asked();
    other.shard = {.index = 1, .count = 2};
    refused(other, "shard");
    other = asked();
    other.subject.settings.clear();
    refused(other, "render.spp=4");
    const auto first = SweepJournal::open(folder / "j", asked());
    ASSERT_TRUE(first);
    refused(asked(), "another sweep is writing it");
}

TEST(SweepJournal, NamesTheLineThatIsDamaged) {
    const std::string good = text_of(made_sweep());
    for (const auto& [bad, why] : std::vector<std::pair<std::string, const char*>>{
             {"", "no complete line"},
             {"{}\n", "j:1"},
             {"[1,2]\n", "j:1"},
             {good + "not JSON\n", "j:9: is damaged"},
             {good + "{\"case\":7,\"point\":0}\n", "no case 7"},
             {good + "{\"case\":-1,\"point\":0}\n", "no case -1"},
             {good + "{\"case\":0,\"point\":0,\"cells\":-5}\n", "-5"},
             {good + "{\"case\":0,\"point\":1,\"cells\":1,\"passes\":[],\"figures\":[]}\n",
              "figures"},
             {good + "{\"case\":0,\"round\":0,\"frame\":0,\"ms\":[[0,-1]]}\n", "-1"},
             {good + "{\"case\":0,\"round\":0,\"frame\":0,\"ms\":[[0,1]],\"joules\":[]}\n", "j:9"},
             {good + "{\"case\":0,\"round\":0,\"frame\":0,\"ms\":[[0,1]],\"waited_views\":[-2]}\n",
              "views is -2"},
             {good + "{\"case\":0,\"round\":0,\"frame\":0,\"ms\":[[0,1]],\"joules\":[-2]}\n",
              "energy is -2"},
             {good + "{\"case\":0,\"point\":0,\"contrast_shares\":{\"kept\":0.7,\"between\":0.7,"
                     "\"beyond\":0,\"contrast\":1}}\n",
              "over 1"},
             {good + "{\"case\":0,\"point\":0,\"reference\":\"not hexadecimal\"}\n", "hash"},
             {good + "{\"case\":0,\"round\":9,\"frame\":0,\"ms\":[]}\n", "no round 9"}}) {
        const auto read = parse_journal(bad, "j");
        ASSERT_FALSE(read) << why;
        EXPECT_EQ(read.error().kind, ErrorKind::BadInput);
        EXPECT_THAT(read.error().message, HasSubstr(why));
    }
    EXPECT_FALSE(read_journal("/nowhere/at/all"));
}

/// What one machine measures of a shard.
SweepRecord shard_of(const SweepRecord& whole, std::size_t index, std::size_t count,
                     double slower) {
    SweepRecord part = whole;
    part.shard = {.index = index, .count = count};
    std::erase_if(part.judged, [&](const JudgedPoint& one) { return !part.shard.has(one.point); });
    for (TimedTurn& turn : part.turns) {
        std::erase_if(turn.times, [&](const PointTime& one) { return !part.shard.has(one.point); });
        for (PointTime& time : turn.times) {
            for (double& ms : time.pass_ms) {
                ms *= slower;
            }
        }
    }
    return part;
}

TEST(Shards, MergeIntoWhatOneMachineWouldSay) {
    const SweepRecord whole = made_sweep(2);
    const auto all = merged({shard_of(whole, 0, 2, 1.0), shard_of(whole, 1, 2, 3.0)}, {"a", "b"});
    ASSERT_TRUE(all) << all.error().message;
    const std::vector<SweepSheet> sheets = sheets_of(*all);
    const std::vector<SweepSheet> expected = sheets_of(whole);
    for (std::size_t sheet = 0; sheet < 2; ++sheet) {
        for (std::size_t row = 0; row < 3; ++row) {
            EXPECT_EQ(sheets[sheet].rows[row].error, "");
            // A machine that is three times slower changes no ratio.
            EXPECT_DOUBLE_EQ(sheets[sheet].rows[row].speedup, expected[sheet].rows[row].speedup);
            EXPECT_EQ(sheets[sheet].rows[row].cells, expected[sheet].rows[row].cells);
            EXPECT_EQ(sheets[sheet].rows[row].on_time_front,
                      expected[sheet].rows[row].on_time_front);
        }
    }
    EXPECT_EQ(sheets_of(shard_of(whole, 1, 2, 1.0))[0].rows.size(), 2U);  // full, its own
    const auto half = merged({shard_of(whole, 0, 2, 1.0)}, {"a"});
    ASSERT_TRUE(half);
    EXPECT_THAT(sheets_of(*half)[0].rows[1].error, HasSubstr("not measured"));
}

TEST(Shards, AreOfOneSweepEachOnce) {
    const SweepRecord whole = made_sweep();
    EXPECT_FALSE(merged({}, {}));
    const auto twice = merged({shard_of(whole, 0, 2, 1.0), shard_of(whole, 0, 2, 1.0)}, {"a", "b"});
    ASSERT_FALSE(twice);
    EXPECT_THAT(twice.error().message, HasSubstr("both shard 1 of 2"));
    EXPECT_FALSE(merged({shard_of(whole, 0, 2, 1.0), shard_of(whole, 1, 3, 1.0)}, {"a", "b"}));
    SweepRecord other = shard_of(whole, 1, 2, 1.0);
    other.subject.device = "another device";
    EXPECT_FALSE(merged({shard_of(whole, 0, 2, 1.0), other}, {"a", "b"}));
}

TEST(Shards, AreOfTheSameScene) {
    SweepRecord one = shard_of(made_sweep(), 0, 2, 1.0);
    SweepRecord other = shard_of(made_sweep(), 1, 2, 1.0);
    one.judged[0].reference_hash = 1;
    EXPECT_TRUE(merged({one, other}, {"a", "b"}));  // of a sweep of before, which has none
    other.judged[0].reference_hash = 1;
    EXPECT_TRUE(merged({one, other}, {"a", "b"}));
    other.judged[0].reference_hash = 2;
    const auto both = merged({one, other}, {"a", "b"});
    ASSERT_FALSE(both);
    EXPECT_THAT(both.error().message, HasSubstr("a and b do not compare"));
    EXPECT_THAT(both.error().message, HasSubstr("'scene0'"));
}

TEST(Shards, AreReadFromText) {
    const auto shard = parse_shard("2/3");
    ASSERT_TRUE(shard);
    EXPECT_EQ(shard->index, 1U);
    EXPECT_TRUE(shard->has(0));
    EXPECT_FALSE(shard->has(2));
    EXPECT_TRUE(shard->has(4));
    for (const char* const bad :
         {"", "1", "0/1", "2/1", "1/0", "-1/2", "1/2/3", "a/b", "1/99999"}) {
        EXPECT_FALSE(parse_shard(bad)) << bad;
    }
}

}  // namespace
}  // namespace gazeloop::trade
