#include "runtime/study/session_responses.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sqlite3.h>

#include <filesystem>

#include "runtime/session/open_session.h"
#include "runtime/session/session_recorder.h"
#include "runtime/session/study_rows.h"
#include "runtime/study/published_plans.h"
#include "runtime/study/sittings.h"
#include "runtime/study/trial_queue.h"
#include "tests/support/temporary_folder.h"

namespace gazeloop::study {
namespace {

using testing::HasSubstr;

class StudySession : public testing::Test {
  protected:
    /// The answer to the next trial of a subject's queue, as the loop records it.
    session::ResponseRecord next_answer() {
        const Trial& trial = *queue.next();
        using Text = FixedText<120>;
        session::ResponseRecord record{
            .frame = 7,
            .subject = 3,
            .trial = trial.number,
            .kind = Text(kTrialKindNames[static_cast<std::size_t>(trial.kind)]),
            .reference_first = trial.reference_first,
            .levels = Text(
                trial.levels.empty() ? "" : fmt::format("{},{}", trial.levels[0], trial.levels[1])),
            .answer = Text("same"),
            .after_s = 1.25,
            .fault = Text("none")};
        queue.answered({.subject = 3, .trial = trial, .answer = Answer::Same});
        return record;
    }
    void record(const std::filesystem::path& file, int answers) {
        const auto recorder =
            value_or_throw(session::SessionRecorder::create(file, {.study = true}));
        recorder->add(session::TrialRecord{.first_frame = 2,
                                           .subject = 3,
                                           .screen = FixedText<240>("picture"),
                                           .method = FixedText<240>("kfr"),
                                           .settings = FixedText<240>("kfr.sigma=1.8")});
        for (int i = 0; i < answers; ++i) {
            recorder->add(next_answer());
        }
        EXPECT_TRUE(recorder->close().complete());
    }

    const Plan& plan = *published_plan("kfr-final");
    TrialQueue queue{plan, 3};
    tests::TemporaryFolder folder;
};

TEST_F(StudySession, HoldsWhatWasShownAndAnswered) {
    const std::filesystem::path file = folder / "a.gaze";
    record(file, 9);
    const auto open = session::OpenSession::open(file);
    ASSERT_TRUE(open) << open.error().message;
    const auto trials = session::read_trials(*open);
    ASSERT_TRUE(trials) << trials.error().message;
    ASSERT_EQ(trials->size(), 1U);
    EXPECT_EQ(trials->at(0).first_frame, 2U);
    EXPECT_EQ(trials->at(0).settings, "kfr.sigma=1.8");
    EXPECT_TRUE(trials->at(0).follows_gaze);
    EXPECT_EQ(session_subject(file), 3U);
    const auto responses = session_responses(plan, file);
    ASSERT_TRUE(responses) << responses.error().message;
    ASSERT_EQ(responses->size(), 9U);
    EXPECT_EQ(responses->at(8).after_s, 1.25);
    EXPECT_FALSE(responses->at(8).settled);
    TrialQueue again(plan, 3);
    EXPECT_TRUE(again.resume(*responses));
    EXPECT_EQ(again.next()->number, queue.next()->number);
}

TEST_F(StudySession, IsNamedBySubjectAndSitting) {
    auto at_first = find_sittings(plan, 3, folder / "new");
    ASSERT_TRUE(at_first) << at_first.error().message;
    EXPECT_EQ(at_first->next.filename(), "kfr-final.003.001.gaze");
    EXPECT_EQ(std::filesystem::status(folder / "new").permissions(),
              std::filesystem::perms::owner_all);
    record(at_first->next, 4);
    // One program at a time asks a subject; another subject is another matter.
    const auto meanwhile = find_sittings(plan, 3, folder / "new");
    ASSERT_FALSE(meanwhile);
    EXPECT_THAT(meanwhile.error().message,
                testing::HasSubstr("another program asks this subject: wait until it ends"));
    EXPECT_TRUE(find_sittings(plan, 4, folder / "new"));
    *at_first = {};
    EXPECT_FALSE(std::filesystem::exists(folder / "new" / "kfr-final.003.lock"));
    const auto then = find_sittings(plan, 3, folder / "new");
    ASSERT_TRUE(then) << then.error().message;
    EXPECT_EQ(then->next.filename(), "kfr-final.003.002.gaze");
    EXPECT_EQ(then->responses.size(), 4U);
    EXPECT_TRUE(find_sittings(plan, 4, folder / "new")->responses.empty());
}

TEST_F(StudySession, OrdinaryOnesHaveNoSuchTables) {
    const std::filesystem::path file = folder / "b.gaze";
    value_or_throw(session::SessionRecorder::create(file, {}))->close();
    const auto open = session::OpenSession::open(file);
    ASSERT_TRUE(open);
    EXPECT_TRUE(session::read_trials(*open)->empty());
    EXPECT_EQ(session_subject(file), 0U);
    EXPECT_TRUE(session_responses(plan, file)->empty());
}

TEST_F(StudySession, ThatIsDamagedIsSaidToBe) {
    const auto error = [&](const std::string& sql) {
        const std::filesystem::path file = folder / "c.gaze";
        std::filesystem::remove(file);
        queue = TrialQueue(plan, 3);
        record(file, 2);
        sqlite3* database = nullptr;
        EXPECT_EQ(sqlite3_open(file.c_str(), &database), SQLITE_OK);
        EXPECT_EQ(sqlite3_exec(database, sql.c_str(), nullptr, nullptr, nullptr), SQLITE_OK);
        sqlite3_close(database);
        const auto read = session_responses(plan, file);
        return read ? std::string("read") : read.error().message;
    };
    EXPECT_THAT(error("UPDATE response SET answer = 'perhaps'"), HasSubstr("no study writes"));
    EXPECT_THAT(error("UPDATE response SET answer = 'up'"), HasSubstr("has no answer 'up'"));
    EXPECT_THAT(error("UPDATE response SET levels = '1.8;4'"), HasSubstr("no study writes"));
    EXPECT_THAT(error("UPDATE response SET levels = '9,4'"), HasSubstr("9 is no level of sigma"));
    EXPECT_THAT(error("UPDATE response SET subject = -1"), HasSubstr("response"));
    EXPECT_THAT(error("ALTER TABLE response DROP COLUMN answer"), HasSubstr("answer"));
}

}  // namespace
}  // namespace gazeloop::study
