// `gazeloop report` on sessions that something is wrong with: true in every form, or refused.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include "tests/support/perfetto_trace.h"
#include "tests/support/run_program.h"

namespace gazeloop::tests {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

std::string text_of(const std::string& file) {
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

/// "nan", "-nan", "inf", "NaN" ... as a word of its own: a division by zero that was shown.
void expect_no_such_number(const std::string& text, const char* what) {
    constexpr std::string_view kBefore = " \t\r\n>,:";
    constexpr std::string_view kAfter = " \t\r\n<,";
    for (const std::string_view word : {"nan", "inf", "NaN", "Infinity"}) {
        for (std::size_t at = text.find(word); at != std::string::npos;
             at = text.find(word, at + 1)) {
            const std::size_t from = at > 0 && text[at - 1] == '-' ? at - 1 : at;
            const std::size_t end = at + word.size();
            EXPECT_FALSE((from == 0 || kBefore.contains(text[from - 1])) &&
                         (end == text.size() || kAfter.contains(text[end])))
                << what << ": " << text.substr(from, 20);
        }
    }
}

/// Each quantity: what no frame knows is null, and what is below 0 is flagged.
void expect_honest(const json& rows, const std::string& unit, const std::string& text) {
    for (const auto& [key, row] : rows.items()) {
        if (!row.contains("frames")) {
            continue;
        }
        SCOPED_TRACE(key);
        const bool known = row["frames"].get<std::uint64_t>() > 0;
        for (const char* const name : {"min", "mean", "max"}) {
            EXPECT_EQ(row[name + unit].is_null(), !known) << name;
        }
        for (const auto& [name, value] : row.items()) {
            if (!known && name.starts_with("p")) {
                EXPECT_TRUE(value.is_null()) << name;
            }
        }
        if (known && row["min" + unit].get<double>() < 0.0) {
            EXPECT_GT(row["negative_frames"].get<std::uint64_t>(), 0U);
            if (key != "stage_scan_to_row") {
                EXPECT_THAT(text, HasSubstr("Below 0: "));
            }
        }
    }
}

class OddSession : public testing::Test {
  protected:
    static constexpr int kFrames = 200;

    void record() {
        const ProgramResult run =
            run_gazeloop({"run", "--gaze", "sim", "--target", "headless", "--clock", "virtual",
                          "--frames", fmt::format("{}", kFrames), "--set", "render.scale=0.02",
                          "--seed", "3", "--record", session_, "--quiet"});
        EXPECT_EQ(run.exit_code, 0) << run.err;
    }

    /// A whole session after these statements.
    std::string changed(const std::string& sql) {
        record();
        const ProgramResult result = run_program({"sqlite3", session_, sql});
        EXPECT_EQ(result.exit_code, 0) << result.err;
        return session_;
    }

    /// Reports it in every form, and holds each to what is true of any session.
    void report(const std::string& session) {
        const std::string trace = folder_.file("trace.pftrace");
        const ProgramResult result = run_gazeloop(
            {"report", session, "--json", folder_.file("r.json"), "--csv", folder_.file("r.csv"),
             "--html", folder_.file("r.html"), "--perfetto", trace, "--perfetto-samples", "all"});
        ASSERT_EQ(result.exit_code, 0) << result.err;
        text = result.out;
        told = json::parse(text_of(folder_.file("r.json")));
        page = text_of(folder_.file("r.html"));
        const std::string csv = text_of(folder_.file("r.csv"));
        expect_no_such_number(text, "text");
        expect_no_such_number(csv, "CSV");
        expect_no_such_number(page.substr(0, page.find("id=\"plot-data\"")), "page");
        expect_honest(told["durations"], "_ms", text);
        expect_honest(told["gaze_error"], "_degrees", text);
        std::istringstream lines(csv);
        std::string head;
        std::getline(lines, head);
        const auto cells = std::ranges::count(head, ',');
        std::uint64_t rows = 0;
        for (std::string line; std::getline(lines, line); ++rows) {
            ASSERT_EQ(std::ranges::count(line, ','), cells) << line;
        }
        EXPECT_EQ(rows, told["frames"]["total"]);
        const PerfettoTrace read = read_perfetto(text_of(trace));
        EXPECT_THAT(read.faults, IsEmpty());
        // A budget is kept, broken or not judgeable, and the session is like itself.
        const int judged = run_gazeloop({"report", session, "--budget", "albert2017"}).exit_code;
        EXPECT_TRUE(judged == 0 || judged == 1) << judged;
        const ProgramResult against =
            run_gazeloop({"report", session, "--against", session, "--json", "-"});
        if (told["durations"]["gaze_age_at_display"]["frames"] == 0) {
            EXPECT_EQ(against.exit_code, 3);
            EXPECT_THAT(against.err, HasSubstr("it has no frame whose gaze has a known age"));
            return;
        }
        ASSERT_EQ(against.exit_code, 0) << against.err;
        const json compared = json::parse(against.out)["against"]["rows"];
        for (const auto& [key, row] : compared.items()) {
            if (row.contains("mean") && !row["mean"].is_null()) {
                EXPECT_EQ(row["mean"]["change"], 0.0) << key;
            }
        }
    }

    [[nodiscard]] std::string answer(const char* question) const {
        return told["why_the_fovea_lags"]["answers"][question]["answer"];
    }
    [[nodiscard]] std::string paragraph() const { return told["why_the_fovea_lags"]["paragraph"]; }

    ScratchFolder folder_;
    std::string session_ = folder_.file("odd.gaze");
    std::string text;
    std::string page;
    json told;
};

TEST_F(OddSession, Whole) {
    report(changed("SELECT 1"));
    EXPECT_EQ(told["frames"]["total"], kFrames);
    EXPECT_EQ(told["recording"]["closed"], true);
    EXPECT_EQ(told["by_eye_event"]["source"], "found");
    EXPECT_LT(told["by_eye_event"]["frames_unknown"], kFrames / 10);
}

TEST_F(OddSession, WithoutGaze) {
    report(
        changed("DELETE FROM gaze; UPDATE fovea SET state = 4, reason = 3, sample_sequence = 0, "
                "sampled_kind = 0, arrived_kind = 0, ready_ns = NULL; UPDATE frame SET "
                "gaze_received = 0, gaze_invalid = 0, gaze_lost = 0, gaze_out_of_order = 0, "
                "gaze_error_gap = NULL, gaze_error_rad = NULL, gaze_error_no_poses_rad = NULL"));
    EXPECT_EQ(told["durations"]["gaze_age_at_display"]["frames"], 0);
    EXPECT_EQ(answer("late"), "cannot be known");
    EXPECT_EQ(answer("smoothed"), "cannot be known");
    EXPECT_EQ(answer("lost"), "yes");
    EXPECT_THAT(paragraph(), HasSubstr("no fresh gaze to follow"));
    EXPECT_THAT(paragraph(), HasSubstr("gazeloop devices"));
    EXPECT_TRUE(told["worst_frames"].empty());
}

TEST_F(OddSession, WithoutFrames) {
    report(changed("DELETE FROM frame; DELETE FROM view; DELETE FROM fovea"));
    EXPECT_EQ(told["frames"]["total"], 0);
    EXPECT_THAT(paragraph(), HasSubstr("There is no frame"));
    for (const char* const question : {"late", "reused", "lost"}) {
        EXPECT_EQ(answer(question), "cannot be known") << question;
    }
}

TEST_F(OddSession, WithOneFrame) {
    report(
        changed("DELETE FROM frame WHERE number <> 100; DELETE FROM view WHERE frame <> 100; "
                "DELETE FROM fovea WHERE frame <> 100"));
    EXPECT_EQ(told["frames"]["total"], 1);
    for (const auto& [key, row] : told["durations"].items()) {
        EXPECT_TRUE(row["p50_ms"].is_null()) << key << ": a median needs two";
    }
}

TEST_F(OddSession, WithUnknownStamps) {
    report(
        changed("UPDATE frame SET wake_up_kind = 0, begin_kind = 0, latch_kind = 0, submit_kind "
                "= 0, end_frame_kind = 0, gpu_begin_kind = 0, gpu_end_kind = 0, display_kind = "
                "0, filtered_ns = NULL, reported_gpu_begin_kind = 0, reported_gpu_end_kind = 0; "
                "UPDATE gaze SET sampled_kind = 0, arrived_kind = 0; UPDATE fovea SET "
                "sampled_kind = 0, arrived_kind = 0"));
    EXPECT_EQ(told["durations"]["gaze_age_at_display"]["frames"], 0);
    EXPECT_EQ(told["durations"]["frame_interval"]["frames"], 0);
    EXPECT_TRUE(told["eye_to_photon_percent_by_kind"].is_null());
    EXPECT_EQ(answer("late"), "cannot be known");
    EXPECT_EQ(told["by_eye_event"]["frames_unknown"], told["by_eye_event"]["frames"]);
}

/// All times of the frames from the middle on, but not those of the samples, are shifted by this.
std::string step_of(const std::string& ns) {
    std::string set;
    for (const char* const column :
         {"wake_up_ns", "begin_ns", "latch_ns", "filtered_ns", "submit_ns", "end_frame_ns",
          "gpu_begin_ns", "gpu_end_ns", "display_ns", "reported_gpu_begin_ns",
          "reported_gpu_end_ns"}) {
        set += fmt::format("{}{} = {} + {}", set.empty() ? "" : ", ", column, column, ns);
    }
    return fmt::format("UPDATE frame SET {} WHERE number >= 100", set);
}

TEST_F(OddSession, WithAClockThatWasSetBack) {
    report(changed(step_of("-3600000000000")));
    const json& ages = told["durations"]["gaze_age_at_display"];
    EXPECT_GT(ages["negative_frames"], kFrames / 3);
    EXPECT_THAT(page, HasSubstr("Below 0: gaze age at display"));
    EXPECT_EQ(told["durations"]["frame_interval"]["negative_frames"], 1);
}

TEST_F(OddSession, WithAClockThatWasSetForward) {
    report(changed(step_of("86400000000000000")));
    EXPECT_GT(told["durations"]["gaze_age_at_display"]["max_ms"], 8e10);
    EXPECT_LT(page.size(), 5'000'000U);
}

TEST_F(OddSession, FromAMachineOfWhichNothingIsKnown) {
    report(
        changed("DELETE FROM device; DELETE FROM config; DELETE FROM meta WHERE name LIKE "
                "'display%'; UPDATE frame SET period_ns = 0; DELETE FROM event"));
    EXPECT_EQ(told["verdict"], "virtual-time");
    EXPECT_EQ(told["frames"]["total"], kFrames);
    EXPECT_TRUE(told["switching_ns"].is_null());
}

TEST_F(OddSession, OfTheFirstSchema) {
    std::filesystem::copy_file(
        std::filesystem::path(GAZELOOP_SOURCE_DIR) / "tests/replay/golden/sim-kfr-headless.gaze",
        session_);
    report(session_);
    EXPECT_EQ(told["recording"]["schema_version"], 1);
    EXPECT_EQ(told["frames"]["total"], 28);
    EXPECT_GT(told["durations"]["gaze_age_at_display"]["frames"], 10);
}

TEST_F(OddSession, OfAProgramThatWasKilled) {
    // In real time: its recorder has more to lose. Once frames have passed, it is killed.
    const ProgramResult killed = run_gazeloop(
        {"run", "--gaze", "sim", "--target", "headless", "--set", "render.scale=0.02", "--seconds",
         "60", "--record", session_, "--monitor-json", "1", "--set", "monitor.interval_s=0.5",
         "--quiet"},
        {.trigger = "\"interval\"", .on_trigger = [](int pid) { kill(pid, SIGKILL); }});
    ASSERT_EQ(killed.exit_code, 137) << killed.err;
    report(session_);
    EXPECT_EQ(told["recording"]["closed"], false);
    EXPECT_GT(told["frames"]["total"], 1);
    EXPECT_THAT(text, HasSubstr("The recording was not closed: it ends at frame"));
}

TEST_F(OddSession, ThatIsNoneIsRefused) {
    for (const auto& [name, content] :
         {std::pair{"empty.gaze", ""}, {"text.gaze", "This is no database.\n"}}) {
        const ProgramResult result = run_gazeloop({"report", folder_.write(name, content)});
        EXPECT_EQ(result.exit_code, 3) << name;
        EXPECT_THAT(result.err, HasSubstr(name));
    }
    const std::string damaged = changed("DROP TABLE fovea");
    const ProgramResult result = run_gazeloop({"report", damaged, "--html", folder_.file("r")});
    EXPECT_EQ(result.exit_code, 3);
    EXPECT_THAT(result.err, HasSubstr("fovea"));
    EXPECT_FALSE(std::filesystem::exists(folder_.file("r")));
}

}  // namespace
}  // namespace gazeloop::tests
