// Sessions of schema version 1, recorded once and kept for ever (golden/README.md): they open,
// they report, and what the program made of their gaze then it makes of it now, bit for bit.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sqlite3.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <memory>
#include <nlohmann/json.hpp>
#include <sstream>
#include <stdexcept>

#include "runtime/vulkan/processor.h"
#include "tests/support/run_program.h"

namespace gazeloop::tests {
namespace {

using testing::ContainsRegex;
using testing::HasSubstr;
using testing::IsSupersetOf;
using Words = std::vector<std::string>;
using Rows = std::vector<Words>;

constexpr std::size_t kFrames = 28;
constexpr const char* kTrace = "trace:gaze.csv";

Words joined(Words words, const Words& more) {
    words.insert(words.end(), more.begin(), more.end());
    return words;
}

struct Golden {
    std::string name;  ///< of the file, without .gaze
    Words options;     ///< of `gazeloop run` that recorded it, without --record
};

void PrintTo(const Golden& golden, std::ostream* out) { *out << golden.name; }

/// Those of one target, for every gaze and method.
std::vector<Golden> golden_sessions(const std::string& target, const std::string& clock) {
    // Gaze is lost for longer than it is held, so that every state of the fovea is there.
    const Words loss{"--set", "gaze.stale_ms=40", "--set", "gaze.hold_ms=40",
                     "--set", "gaze.return_ms=60"};
    const Words trace =
        joined({"--gaze", kTrace, "--display", "fove0", "--set", "render.scale=0.08"}, loss);
    const Words sim = joined({"--gaze",    "sim",
                              "--seed",    "18",
                              "--display", "psvr2",
                              "--set",     "render.scale=0.05",
                              "--spp",     "2",
                              "--set",     "sim.dropout_percent=25",
                              "--set",     "sim.dropout_ms=50",
                              "--set",     "sim.eye_loss_percent=30",
                              "--set",     "sim.fixation_ms=60",
                              "--set",     "sim.head.turn_percent=60"},
                             loss);
    const Words end{"--target", target,   "--clock", clock, "--frames", std::to_string(kFrames),
                    "--hash",   "--quiet"};
    std::vector<Golden> sessions{
        {"trace-full", joined(trace, {"--method", "full"})},
        {"trace-kfr", joined(trace, {"--method", "kfr"})},
        {"trace-acuity", joined(trace, {"--method", "acuity", "--mar", "0.1"})},
        {"sim-full", joined(sim, {"--method", "full"})},
        {"sim-kfr", joined(sim, {"--method", "kfr", "--sigma", "2.4", "--alpha", "3"})},
        {"sim-acuity", joined(sim, {"--method", "acuity", "--mar", "0.2"})}};
    for (Golden& session : sessions) {
        session.name += "-" + target;
        session.options = joined(session.options, end);
    }
    return sessions;
}

std::vector<Golden> headless_sessions() { return golden_sessions("headless", "virtual"); }

// In virtual time a runtime's hidden area is left aside, so these are of real time. No such run
// comes out the same twice, because the runtime says when frames begin and where the head is; so
// they are only replayed.
std::vector<Golden> openxr_sessions() { return golden_sessions("openxr", "wall"); }

/// The command's words but for the file's name, which comes last.
Words recording(const Golden& golden) {
    return joined(joined({"run"}, golden.options), {"--record"});
}

std::string golden_file(const std::string& name) {
    return std::string(GAZELOOP_SOURCE_DIR) + "/tests/replay/golden/" + name;
}

struct Close {
    void operator()(sqlite3* database) const { sqlite3_close(database); }
    void operator()(sqlite3_stmt* statement) const { sqlite3_finalize(statement); }
};

/// Numbers exactly: in hexadecimal, where -0 is not 0.
std::string cell(sqlite3_stmt* statement, int column) {
    switch (sqlite3_column_type(statement, column)) {
        case SQLITE_NULL:
            return "NULL";
        case SQLITE_FLOAT: {
            std::ostringstream text;
            text << std::hexfloat << sqlite3_column_double(statement, column);
            return text.str();
        }
        default:
            return reinterpret_cast<const char*>(sqlite3_column_text(statement, column));
    }
}

/// By SQL on what SCHEMA.md promises, not by our own reader: that is part of what is tested.
Rows query(const std::string& file, const std::string& sql) {
    sqlite3* opened = nullptr;
    const int code = sqlite3_open_v2(file.c_str(), &opened, SQLITE_OPEN_READWRITE, nullptr);
    const std::unique_ptr<sqlite3, Close> database(opened);
    sqlite3_stmt* prepared = nullptr;
    if (code == SQLITE_OK) {
        sqlite3_prepare_v2(opened, sql.c_str(), -1, &prepared, nullptr);
    }
    const std::unique_ptr<sqlite3_stmt, Close> statement(prepared);
    Rows rows;
    while (prepared != nullptr && sqlite3_step(prepared) == SQLITE_ROW) {
        Words& row = rows.emplace_back();
        for (int column = 0; column < sqlite3_column_count(prepared); ++column) {
            row.push_back(cell(prepared, column));
        }
    }
    if (const int end = sqlite3_errcode(opened); end != SQLITE_OK && end != SQLITE_DONE) {
        throw std::runtime_error(file + ": " + sql + ": " + sqlite3_errmsg(opened));
    }
    return rows;
}

/// The first column of a query.
Words list(const std::string& file, const std::string& sql) {
    Words values;
    for (const Words& row : query(file, sql)) {
        values.push_back(row.at(0));
    }
    return values;
}

Words columns(const std::string& file, const std::string& table) {
    return list(file, "SELECT name FROM pragma_table_info('" + table + "') ORDER BY name");
}

void expect_same(const std::string& sql, const std::string& golden, const std::string& now) {
    const Rows before = query(golden, sql);
    const Rows after = query(now, sql);
    ASSERT_FALSE(before.empty()) << sql;
    ASSERT_EQ(after.size(), before.size()) << sql;
    for (std::size_t row = 0; row < before.size(); ++row) {
        ASSERT_EQ(after[row], before[row]) << "row " << row << " of " << sql;
    }
}

/// What of views and foveae both files know: a later schema may have more.
std::string every_column(const std::string& table, const std::string& golden,
                         const std::string& now) {
    std::string list;
    const Words known = columns(now, table);
    for (const std::string& column : columns(golden, table)) {
        if (std::ranges::find(known, column) != known.end()) {
            list += (list.empty() ? "" : ", ") + column;
        }
    }
    return "SELECT " + list + " FROM " + table + " ORDER BY frame, eye";
}

void expect_same_foveae(const std::string& golden, const std::string& now) {
    EXPECT_THAT(columns(now, "fovea"),
                IsSupersetOf({"frame", "eye", "x_px", "y_px", "direction_x", "direction_y",
                              "direction_z", "state", "reason", "sample_sequence"}));
    EXPECT_THAT(columns(now, "view"),
                IsSupersetOf({"frame", "eye", "pose_qw", "pose_qx", "pose_qy", "pose_qz",
                              "pose_x_m", "pose_y_m", "pose_z_m", "left_rad", "right_rad", "up_rad",
                              "down_rad", "width_px", "height_px"}));
    expect_same(every_column("fovea", golden, now), golden, now);
    expect_same(every_column("view", golden, now), golden, now);
    expect_same("SELECT number, latch_ns, display_ns FROM frame ORDER BY number", golden, now);
}

void expect_same_pictures(const std::string& golden, const std::string& now) {
    expect_same("SELECT number, pixel_hash FROM frame ORDER BY number", golden, now);
}

std::string renderer(const std::string& session) {
    const Words names = list(session,
                             "SELECT value FROM device WHERE name IN ('vulkan device', "
                             "'vulkan driver') ORDER BY name");
    return names.at(0) + ", driver " + names.at(1);
}

/// Of the processor; lavapipe uses it where there is one, and its names do not say so.
bool has_fused_multiply_add() {
#if defined(__x86_64__)
    return __builtin_cpu_supports("fma") != 0;
#else
    return false;
#endif
}

/// Why pictures of now are not comparable with the golden ones; empty if they are.
std::string other_renderer(const std::string& golden, const std::string& now) {
    const bool fused = has_fused_multiply_add();
    if (fused && renderer(now) == renderer(golden)) {
        return "";
    }
    return "pictures not compared: recorded on " + renderer(golden) +
           ", with fused multiply-add; this is " + renderer(now) + (fused ? ", with" : ", without");
}

/// Lavapipe's pictures depend on the processor's table of inverse square roots (README.md). Those
/// of another table than the first one's stand in a file of their own; empty: there is none.
std::string pictures_of_this_processor() {
    const std::string file =
        golden_file(fmt::format("pictures-{:016x}.csv", vulkan::inverse_square_root_hash()));
    return std::filesystem::exists(file) ? file : "";
}

/// Replaces a golden session's pictures.
void take_pictures(const std::string& session, const std::string& name, const std::string& csv) {
    std::ifstream lines(csv);
    std::size_t taken = 0;
    for (std::string line; std::getline(lines, line);) {
        const std::size_t first = line.find(',');
        const std::size_t second = line.find(',', first + 1);
        if (line.substr(0, first) == name) {
            query(session, "UPDATE frame SET pixel_hash = " + line.substr(second + 1) +
                               " WHERE number = " + line.substr(first + 1, second - first - 1));
            ++taken;
        }
    }
    const Words hashed = list(session, "SELECT 1 FROM frame WHERE pixel_hash IS NOT NULL");
    ASSERT_EQ(taken, hashed.size()) << csv;
}

class GoldenSessions : public testing::Test {
  protected:
    /// SQLite may write beside what it reads: a copy.
    [[nodiscard]] std::string copy_of(const std::string& name) const {
        const std::string copy = folder_.file(name + ".gaze");
        std::filesystem::copy_file(golden_file(name + ".gaze"), copy);
        if (const std::string pictures = pictures_of_this_processor(); !pictures.empty()) {
            take_pictures(copy, name, pictures);
        }
        return copy;
    }

    /// Frames with a picture. Over OpenXR the first has none: the runtime does not ask for it.
    [[nodiscard]] static std::size_t rendered(const std::string& session) {
        return list(session, "SELECT number FROM frame WHERE pixel_hash IS NOT NULL").size();
    }

    /// Afterwards `not_compared_` says why the pictures were not compared, if they were not.
    void replay(const std::string& session, const Words& more) {
        const std::string json = folder_.file("summary.json");
        const std::string again = folder_.file("again.gaze");
        const ProgramResult replayed = run_gazeloop(
            joined({"replay", session, "--hash", "--json", json, "--record", again}, more));
        // 1: something differs; on another renderer that may be pictures alone.
        ASSERT_TRUE(replayed.exit_code == 0 || replayed.exit_code == 1) << replayed.err;

        const auto all = [](std::size_t frames) {
            return nlohmann::json{{"equal", frames}, {"of", frames}};
        };
        nlohmann::json check = nlohmann::json::parse(std::ifstream(json))["replay"];
        ASSERT_EQ(list(session, "SELECT number FROM frame").size(), kFrames);
        EXPECT_EQ(check["foveae"], all(kFrames)) << replayed.out;
        ASSERT_NO_FATAL_FAILURE(expect_same_foveae(session, again));

        not_compared_ = other_renderer(session, again);
        if (!not_compared_.empty()) {
            return;
        }
        EXPECT_EQ(replayed.exit_code, 0) << replayed.err;
        ASSERT_GE(rendered(session), kFrames - 1);
        EXPECT_EQ(check["pixels"], all(rendered(session))) << replayed.out;
        EXPECT_TRUE(check["first_difference"].is_null()) << replayed.out;
        expect_same_pictures(session, again);
    }

    ScratchFolder folder_;
    std::string not_compared_;
};

class GoldenSession : public GoldenSessions, public testing::WithParamInterface<Golden> {};

TEST_P(GoldenSession, IsReadReportedAndReplayed) {
    const std::string session = copy_of(GetParam().name);
    EXPECT_EQ(list(session, "SELECT value FROM meta WHERE name = 'schema_version'"), Words{"1"});
    std::string line = "gazeloop";
    for (const std::string& word : joined(recording(GetParam()), {GetParam().name + ".gaze"})) {
        line += " " + word;
    }
    EXPECT_EQ(list(session, "SELECT value FROM meta WHERE name = 'command_line'"), Words{line});
    const ProgramResult report = run_gazeloop({"report", session});
    EXPECT_EQ(report.exit_code, 0) << report.err;
    EXPECT_THAT(report.out, ContainsRegex("frames +" + std::to_string(kFrames) + ", rendered " +
                                          std::to_string(rendered(session))));
    ASSERT_NO_FATAL_FAILURE(replay(session, {}));
    if (!not_compared_.empty()) {
        GTEST_SKIP() << not_compared_;
    }
}

INSTANTIATE_TEST_SUITE_P(Headless, GoldenSession, testing::ValuesIn(headless_sessions()));
INSTANTIATE_TEST_SUITE_P(OpenXr, GoldenSession, testing::ValuesIn(openxr_sessions()));

class GoldenRun : public GoldenSession {};

TEST_P(GoldenRun, ComesOutTheSame) {
    const std::string golden = copy_of(GetParam().name);
    Words words = recording(GetParam());
    std::ranges::replace(words, std::string(kTrace), "trace:" + golden_file("gaze.csv"));
    const std::string now = folder_.file("now.gaze");
    // What its user has configured on this machine is no part of it.
    const ProgramResult run = run_gazeloop(
        joined(words, {now}), {.environment = {{"XDG_CONFIG_HOME", folder_.file("none")}}});
    ASSERT_EQ(run.exit_code, 0) << run.err;
    ASSERT_NO_FATAL_FAILURE(expect_same_foveae(golden, now));
    if (const std::string why = other_renderer(golden, now); !why.empty()) {
        GTEST_SKIP() << why;
    }
    expect_same_pictures(golden, now);
}

INSTANTIATE_TEST_SUITE_P(Headless, GoldenRun, testing::ValuesIn(headless_sessions()));

// Views and mask are the recorded ones; the runtime takes the pictures, with depth.
TEST_F(GoldenSessions, AreReplayedOverOpenXrToo) {
    ASSERT_NO_FATAL_FAILURE(replay(copy_of("sim-kfr-openxr"), {"--target", "openxr"}));
    if (!not_compared_.empty()) {
        GTEST_SKIP() << not_compared_;
    }
}

TEST_F(GoldenSessions, AreNotComparedWithPicturesOfAnotherProcessor) {
    const std::string session = copy_of("trace-kfr-headless");
    query(session, "UPDATE frame SET pixel_hash = 1");
    const auto replayed = [&] { return run_gazeloop({"replay", session, "--hash", "--quiet"}); };
    EXPECT_EQ(replayed().exit_code, 1);
    query(session,
          "INSERT INTO device (position, name, value) SELECT max(position) + 1, "
          "'processor rsqrt', '0123456789abcdef' FROM device");
    const ProgramResult other = replayed();
    EXPECT_EQ(other.exit_code, 0) << other.err;
    EXPECT_THAT(other.out, HasSubstr("foveae bit-equal in 28 of 28 frames"));
    EXPECT_THAT(other.out, HasSubstr("pictures not compared: recorded with llvmpipe"));
}

TEST_F(GoldenSessions, DifferWhereOneNumberDoes) {
    const std::string session = copy_of("trace-kfr-headless");
    const std::string foveae = "SELECT x_px FROM fovea ORDER BY frame, eye";
    const Words before = list(session, foveae);
    query(session, "UPDATE fovea SET x_px = x_px + 1e-9 WHERE frame = 9 AND eye = 1");
    EXPECT_NE(list(session, foveae), before);
    const ProgramResult replayed = run_gazeloop({"replay", session});
    EXPECT_EQ(replayed.exit_code, 1) << replayed.err;
    EXPECT_THAT(replayed.out, HasSubstr("foveae bit-equal in 27 of 28 frames"));
    EXPECT_THAT(replayed.out, HasSubstr("first difference in frame 9"));
}

}  // namespace
}  // namespace gazeloop::tests
