#include "runtime/session/session_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sqlite3.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <string>

#include "runtime/session/session_recorder.h"
#include "tests/support/nobody.h"
#include "tests/support/temporary_folder.h"
#include "tests/unit/latency/example_frame.h"
#include "tests/unit/session/child_process.h"

namespace gazeloop::session {
namespace {

using ::testing::HasSubstr;

class ReadSession : public ::testing::Test {
  protected:
    /// A closed session of three frames, a sample and an event.
    void record() {
        const auto recorder = value_or_throw(SessionRecorder::create(file, {}));
        for (std::uint64_t index = 0; index < 3; ++index) {
            recorder->add(latency::example_frame(index));
            recorder->add(latency::example_gpu(index));
        }
        recorder->add(gaze::GazeSample{}, 1);
        recorder->event({}, "kind", "text");
        recorder->close();
    }

    void change(const std::string& sql) const {
        sqlite3* database = nullptr;
        ASSERT_EQ(sqlite3_open(file.c_str(), &database), SQLITE_OK);
        char* error = nullptr;
        sqlite3_exec(database, sql.c_str(), nullptr, nullptr, &error);
        EXPECT_EQ(error, nullptr) << error;
        sqlite3_close(database);
    }

    /// Replaces a table by one with the same rows and no constraints.
    void loosen(const std::string& table) const {
        change("CREATE TABLE loose AS SELECT * FROM " + table + "; DROP TABLE " + table +
               "; ALTER TABLE loose RENAME TO " + table);
    }

    /// The message of the error with which reading must end; it names the file.
    std::string error() const {
        const Expected<SessionFile> session = read_session(file);
        if (session) {
            return "no error";
        }
        EXPECT_EQ(session.error().kind, ErrorKind::BadInput);
        EXPECT_THAT(session.error().message, HasSubstr(file.string()));
        return session.error().message;
    }

    tests::TemporaryFolder folder;
    std::filesystem::path file = folder / "run.session";
};

TEST_F(ReadSession, RefusesWhatIsNotThere) {
    EXPECT_THAT(error(), HasSubstr("does not exist"));
    EXPECT_FALSE(looks_like_session(file));
}

TEST_F(ReadSession, RefusesAFolder) {
    std::filesystem::create_directory(file);
    EXPECT_THAT(error(), HasSubstr("is not a file"));
    EXPECT_FALSE(looks_like_session(file));
}

TEST_F(ReadSession, RefusesAnEmptyFile) {
    std::ofstream(file).close();
    EXPECT_THAT(error(), HasSubstr("not a session"));
}

TEST_F(ReadSession, RefusesOtherFiles) {
    std::ofstream(file) << "time;x;y\n1;2;3\n4;5;6\n";
    EXPECT_THAT(error(), HasSubstr("not a session"));
    EXPECT_FALSE(looks_like_session(file));
}

TEST_F(ReadSession, RefusesGarbageThatBeginsAsSqlite) {
    std::ofstream(file, std::ios::binary)
        << std::string("SQLite format 3\0", 16) << std::string(5000, '\x5a');
    EXPECT_TRUE(looks_like_session(file));
    EXPECT_THAT(error(), HasSubstr("not a database"));
}

TEST_F(ReadSession, RefusesOtherDatabases) {
    change("CREATE TABLE urls (id INTEGER)");
    EXPECT_THAT(error(), HasSubstr("not a session: has no table meta"));
}

TEST_F(ReadSession, RefusesANewerSchemaAndNamesBothVersions) {
    record();
    change("UPDATE meta SET value = '7' WHERE name = 'schema_version'; DROP TABLE gaze");
    EXPECT_THAT(error(), HasSubstr("schema version 7"));
    EXPECT_THAT(error(), HasSubstr("up to version 2"));
}

TEST_F(ReadSession, RefusesAVersionThatIsNoNumber) {
    record();
    change("UPDATE meta SET value = '1a' WHERE name = 'schema_version'");
    EXPECT_THAT(error(), HasSubstr("schema_version is '1a'"));
}

TEST_F(ReadSession, RefusesAMissingTable) {
    record();
    change("DROP TABLE event");
    EXPECT_THAT(error(), HasSubstr("no table event"));
}

TEST_F(ReadSession, RefusesAViewInPlaceOfATable) {
    record();
    change(
        "DROP TABLE event; CREATE VIEW event AS WITH RECURSIVE n(x) AS "
        "(SELECT 1 UNION ALL SELECT x + 1 FROM n) SELECT x AS position FROM n");
    EXPECT_THAT(error(), HasSubstr("no table event"));
}

TEST_F(ReadSession, RefusesAMissingColumn) {
    record();
    change("ALTER TABLE gaze DROP COLUMN left_valid");
    EXPECT_THAT(error(), HasSubstr("table gaze"));
    EXPECT_THAT(error(), HasSubstr("left_valid"));
}

TEST_F(ReadSession, IgnoresColumnsAndTablesThatItDoesNotKnow) {
    record();
    change("ALTER TABLE gaze ADD COLUMN pupil_m ANY; CREATE TABLE trial (id INTEGER)");
    EXPECT_EQ(error(), "no error");
}

// A session of version 1, which knew two methods, is read into today's grids and passes.
TEST_F(ReadSession, ReadsVersionOne) {
    std::filesystem::copy_file(GAZELOOP_SOURCE_DIR "/tests/replay/golden/trace-kfr-openxr.gaze",
                               file);
    const Expected<SessionFile> session = read_session(file);
    ASSERT_TRUE(session.has_value()) << session.error().message;
    EXPECT_EQ(session->header.passes, (frame::PassList{"full", "pass_i", "resolve", "disc"}));
    EXPECT_EQ(session->header.grids, (frame::GridList{"lp", "picture"}));
    const RecordedFrame& last = session->frames.back();
    EXPECT_EQ(last.frame.samples.grid_count, 2U);
    const frame::GridCounts& lp = last.frame.samples.grids[0];
    EXPECT_GT(lp.shaded, 0U);
    EXPECT_GT(lp.hidden, 0U);
    EXPECT_EQ(lp.planned, lp.shaded + lp.off_screen + lp.covered + lp.hidden);
    EXPECT_TRUE(std::ranges::any_of(session->frames, [](const RecordedFrame& one) {
        return one.frame.samples.grids[1].shaded > 0;
    }));
    EXPECT_EQ(last.gpu.passes[0], std::nullopt) << "full resolution was not rendered";
    EXPECT_GT(last.gpu.passes[1], 0);
    EXPECT_GT(last.gpu.passes[2], 0);

    // As the first of them were written, before there were masks.
    change("ALTER TABLE frame DROP COLUMN texels_hidden; DROP TABLE hidden_area");
    change("ALTER TABLE frame DROP COLUMN pixels_hidden");
    const Expected<SessionFile> first = read_session(file);
    ASSERT_TRUE(first.has_value()) << first.error().message;
    EXPECT_TRUE(first->hidden.empty());
    EXPECT_EQ(first->frames.back().frame.samples.grids[0].hidden, 0U);
    EXPECT_EQ(first->frames.back().frame.samples.grids[0].shaded, lp.shaded);
}

TEST_F(ReadSession, RefusesNamesThatAreNone) {
    record();
    change("UPDATE meta SET value = 'lp picture lp' WHERE name = 'grids'");
    EXPECT_THAT(error(), HasSubstr("table meta: grids is 'lp picture lp': 'lp' is there twice"));
    change("UPDATE meta SET value = 'lp; picture' WHERE name = 'grids'");
    EXPECT_THAT(error(), HasSubstr("names of lower case letters"));
    change("UPDATE meta SET value = 'a b c d e f g h i' WHERE name = 'grids'");
    EXPECT_THAT(error(), HasSubstr("more than 8 names"));
    change("DELETE FROM meta WHERE name = 'passes'");
    EXPECT_THAT(error(), HasSubstr("table meta has no passes"));
}

TEST_F(ReadSession, KnowsWhatWasHiddenFromWhichFrameOn) {
    const gaze::HiddenTriangle triangle{{glm::dvec2{1, 2}, glm::dvec2{3, 4}, glm::dvec2{5, 6}}};
    const auto meshes = std::make_shared<const gaze::PerEye<gaze::HiddenMesh>>(
        gaze::PerEye<gaze::HiddenMesh>{gaze::HiddenMesh{}, gaze::HiddenMesh{triangle, triangle}});
    {
        const auto recorder = value_or_throw(SessionRecorder::create(file, {}));
        recorder->add(gaze::HiddenChange{3, meshes});
        recorder->add(gaze::HiddenChange{8, nullptr});
        EXPECT_TRUE(recorder->close().complete());
    }
    const Expected<SessionFile> session = read_session(file);
    ASSERT_TRUE(session.has_value()) << session.error().message;
    ASSERT_EQ(session->hidden.size(), 2U);
    EXPECT_EQ(session->hidden[0].frame, 3U);
    EXPECT_EQ(*session->hidden[0].meshes, *meshes);
    EXPECT_EQ(session->hidden[1].frame, 8U);
    EXPECT_TRUE((*session->hidden[1].meshes)[1].empty());
    change("UPDATE hidden_area SET frame = 1 WHERE frame = 8");
    EXPECT_THAT(error(), HasSubstr("table hidden_area, row 3: is of an earlier frame"));
}

TEST_F(ReadSession, KnowsHowTheOriginMovedAtWhichFrame) {
    const gaze::OriginChange first{
        .frame = 3, .new_in_old = {{0.6, 0.0, 0.8, 0.0}, {1.0, -0.0, 3.0}}, .announced = true};
    const gaze::OriginChange second{.frame = 4, .new_in_old = {}, .announced = false};
    {
        const auto recorder = value_or_throw(SessionRecorder::create(file, {}));
        recorder->add(first);
        recorder->add(second);
        EXPECT_TRUE(recorder->close().complete());
    }
    const Expected<SessionFile> session = read_session(file);
    ASSERT_TRUE(session.has_value()) << session.error().message;
    ASSERT_EQ(session->origins.size(), 2U);
    EXPECT_EQ(session->origins[0].frame, 3U);
    EXPECT_EQ(session->origins[0].new_in_old.orientation, first.new_in_old.orientation);
    EXPECT_EQ(session->origins[0].new_in_old.position_m, first.new_in_old.position_m);
    EXPECT_TRUE(session->origins[0].announced);
    EXPECT_EQ(session->origins[1].frame, 4U);
    EXPECT_FALSE(session->origins[1].announced);
    change("UPDATE origin SET frame = 3 WHERE frame = 4");
    EXPECT_THAT(error(),
                HasSubstr("table origin, row 2: is not of a later frame than the row before it"));
    change("UPDATE origin SET frame = 4, new_qw = 0.5 WHERE announced = 0");
    EXPECT_THAT(error(), HasSubstr("table origin, row 2: is no pose"));
    change("UPDATE origin SET new_x_m = NULL");
    EXPECT_THAT(error(), HasSubstr("table origin, row 1: is no pose"));
    // As the first of version 2 were written.
    change("DROP TABLE origin");
    EXPECT_TRUE(value_or_throw(read_session(file)).origins.empty());
}

TEST_F(ReadSession, ReadsFilesFromBeforeTheseColumns) {
    record();
    for (const char* const table : {"gaze", "fovea"}) {
        for (const char* const column : {"ready_ns", "uncertainty_ns", "parallax_rad"}) {
            change(std::string("ALTER TABLE ") + table + " DROP COLUMN " + column);
        }
    }
    for (const char* const column : {"event", "horizon_ns", "uncertainty_rad", "filter_delay_ns"}) {
        change(std::string("ALTER TABLE fovea DROP COLUMN ") + column);
    }
    EXPECT_EQ(error(), "no error");
}

TEST_F(ReadSession, RefusesAnEventThatItDoesNotKnow) {
    record();
    change("UPDATE fovea SET event = 5");
    EXPECT_EQ(error(), "no error");
    change("UPDATE fovea SET event = 6 WHERE frame = 2 AND eye = 1");
    EXPECT_THAT(error(), HasSubstr("table fovea, row 6: column event holds '6' where an integer "
                                   "from 0 to 5"));
    change("UPDATE fovea SET event = 0");
    EXPECT_THAT(error(), HasSubstr("column event holds '0' where an integer from 1 to 5"));
}

TEST_F(ReadSession, NamesTableRowAndColumnOfAWrongType) {
    record();
    loosen("frame");
    change("UPDATE frame SET wake_up_ns = 'soon' WHERE number = 1");
    EXPECT_THAT(error(), HasSubstr("table frame, row 2: column wake_up_ns holds 'soon' where an "
                                   "integer was expected"));
}

TEST_F(ReadSession, RefusesAnIntegerWhereARealNumberBelongs) {
    record();
    change("UPDATE fovea SET x_px = 3 WHERE frame = 2 AND eye = 1");
    EXPECT_THAT(error(), HasSubstr("table fovea, row 6: column x_px holds '3'"));
}

TEST_F(ReadSession, RefusesAKindThatItDoesNotKnow) {
    record();
    change("UPDATE gaze SET sampled_kind = 5");
    EXPECT_THAT(error(), HasSubstr("table gaze, row 1: column sampled_kind holds '5' where an "
                                   "integer from 0 to 4"));
}

TEST_F(ReadSession, RefusesNullWhereSomethingBelongs) {
    record();
    loosen("event");
    change("UPDATE event SET text = NULL");
    EXPECT_THAT(error(), HasSubstr("column text holds NULL where text was expected"));
}

TEST_F(ReadSession, RefusesAFrameThatLacksAView) {
    record();
    change("DELETE FROM view WHERE frame = 1 AND eye = 0");
    EXPECT_THAT(error(), HasSubstr("table view, row 3: the left eye of frame 1 is missing"));
}

TEST_F(ReadSession, RefusesALastFrameThatLacksAFovea) {
    record();
    change("DELETE FROM fovea WHERE frame = 2 AND eye = 1");
    EXPECT_THAT(error(), HasSubstr("table fovea, row 6: the right eye of frame 2 is missing"));
}

TEST_F(ReadSession, RefusesViewsOfNoFrame) {
    record();
    change("DELETE FROM frame WHERE number = 2");
    EXPECT_THAT(error(), HasSubstr("table view, row 5: belongs to no frame"));
}

TEST_F(ReadSession, RefusesRowsThatComeTwice) {
    record();
    loosen("event");
    change("INSERT INTO event SELECT * FROM event");
    EXPECT_THAT(error(), HasSubstr("table event, row 2: is out of order"));
}

TEST_F(ReadSession, RefusesATableThatIsNotStoredByItsKey) {
    record();
    loosen("view");
    EXPECT_THAT(error(), HasSubstr("table view, row 1: is not stored by its key"));
}

TEST_F(ReadSession, RefusesSamplesThatGoBackInFrames) {
    record();
    change(
        "CREATE TEMP TABLE copy AS SELECT * FROM gaze; UPDATE copy SET position = 2, frame = 0; "
        "INSERT INTO gaze SELECT * FROM copy");
    EXPECT_THAT(error(), HasSubstr("table gaze, row 2: was consumed by an earlier frame"));
}

TEST_F(ReadSession, RefusesTruncatedFiles) {
    record();
    const auto whole = std::filesystem::file_size(file);
    for (std::uintmax_t size = whole - 1; size > 0; size -= std::min<std::uintmax_t>(size, 1500)) {
        std::filesystem::resize_file(file, size);
        EXPECT_NE(error(), "no error") << size;
    }
}

TEST_F(ReadSession, SurvivesAnyFlippedByte) {
    record();
    std::string bytes(std::filesystem::file_size(file), '\0');
    std::ifstream(file, std::ios::binary)
        .read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    for (std::size_t at = 0; at < bytes.size(); at += 397) {
        std::string damaged = bytes;
        damaged[at] = static_cast<char>(~damaged[at]);
        std::ofstream(file, std::ios::binary | std::ios::trunc)
            .write(damaged.data(), static_cast<std::streamsize>(damaged.size()));
        const Expected<SessionFile> session = read_session(file);
        EXPECT_TRUE(session || session.error().kind == ErrorKind::BadInput);
    }
}

// Such bytes would drive the terminal that shows the message.
TEST_F(ReadSession, SaysWhatIsDamagedWithoutItsBytes) {
    record();
    std::string bytes(std::filesystem::file_size(file), '\0');
    std::ifstream(file, std::ios::binary)
        .read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    constexpr std::string_view kSchema = "CREATE TABLE ";
    bool any = false;
    for (std::size_t at = bytes.find(kSchema); at != std::string::npos;
         at = bytes.find(kSchema, at + 1)) {
        std::string damaged = bytes;
        damaged.replace(at + kSchema.size() + 7, 3, "\x1b[\xff");
        std::ofstream(file, std::ios::binary | std::ios::trunc)
            .write(damaged.data(), static_cast<std::streamsize>(damaged.size()));
        const std::string message = error();
        EXPECT_TRUE(std::ranges::all_of(message, [](char c) { return c >= ' ' && c <= '~'; }))
            << message;
        any = any || message.find("\\x1b") != std::string::npos;
    }
    EXPECT_TRUE(any) << "no message quoted what is damaged";
}

TEST_F(ReadSession, LeavesAClosedFileAlone) {
    if (const std::string missing = tests::missing_for_nobody(); !missing.empty()) {
        GTEST_SKIP() << missing;
    }
    record();
    std::filesystem::permissions(file, std::filesystem::perms(0444));
    std::filesystem::permissions(folder.path(), std::filesystem::perms(0555));
    const int frames = run_in_child([this] {
        return tests::become_nobody()
                   ? static_cast<int>(value_or_throw(read_session(file)).frames.size())
                   : -1;
    });
    std::filesystem::permissions(folder.path(), std::filesystem::perms(0755));
    EXPECT_EQ(frames, 3);
    EXPECT_FALSE(std::filesystem::exists(file.string() + "-wal"));
    EXPECT_FALSE(std::filesystem::exists(file.string() + "-journal"));
}

}  // namespace
}  // namespace gazeloop::session
