// The program as its users run it, headless: determinism, recording, summary, pictures.
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "runtime/session/session_file.h"
#include "tests/support/recorded_data.h"
#include "tests/support/run_program.h"

namespace gazeloop::tests {
namespace {

constexpr const char* kSmall = "render.scale=0.05";  // 64x72 an eye

class Replay : public testing::Test {
  protected:
    void SetUp() override {
        const ProgramResult made =
            run_gazeloop({"simulate", "gaze", trace(), "--seconds", "2", "--seed", "3",
                          // two seconds are then sure to hold a blink
                          "--set", "sim.blinks_per_min=60"});
        ASSERT_EQ(made.exit_code, 0) << made.err;
    }

    [[nodiscard]] std::string trace() const { return folder_.file("gaze.csv"); }

    static std::vector<std::string> with(std::vector<std::string> words,
                                         const std::vector<std::string>& more) {
        words.insert(words.end(), more.begin(), more.end());
        return words;
    }

    /// A replay in virtual time; gives the hash lines.
    [[nodiscard]] std::string hashes(const std::vector<std::string>& more) const {
        const ProgramResult result = run_gazeloop(
            with({"replay", trace(), "--frames", "6", "--quiet", "--hash", "--set", kSmall}, more));
        EXPECT_EQ(result.exit_code, 0) << result.err;
        EXPECT_NE(result.out.find("hash pixels"), std::string::npos) << result.out;
        return result.out;
    }

    ScratchFolder folder_;
};

TEST_F(Replay, OfATraceIsTheSameEveryTime) {
    const std::string first = hashes({});
    EXPECT_EQ(hashes({}), first);
    EXPECT_EQ(hashes({"--set", "render.frames_in_flight=1"}), first);
    EXPECT_EQ(hashes({"--set", "render.profile=false"}), first);
    EXPECT_NE(hashes({"--sigma", "2.4"}), first);
    EXPECT_NE(hashes({"--alpha", "3"}), first);
    EXPECT_NE(hashes({"--speed", "2"}), first);
}

TEST_F(Replay, OfASessionGivesTheRecordedFrames) {
    const std::string session = folder_.file("session.gaze");
    const ProgramResult recorded =
        run_gazeloop({"run", "--gaze", "trace:" + trace(), "--target", "headless", "--frames", "8",
                      "--hash", "--record", session, "--set", kSmall, "--sigma", "2"});
    ASSERT_EQ(recorded.exit_code, 0) << recorded.err;
    const std::string summary = folder_.file("summary.json");
    const ProgramResult replayed = run_gazeloop({"replay", session, "--hash", "--json", summary});
    EXPECT_EQ(replayed.exit_code, 0) << replayed.err;
    EXPECT_NE(replayed.out.find("foveae bit-equal in 8 of 8 frames"), std::string::npos)
        << replayed.out;
    EXPECT_NE(replayed.out.find("pictures equal in 8 of 8 frames"), std::string::npos)
        << replayed.out;
    // What is printed is in the file too.
    const auto json = nlohmann::json::parse(std::ifstream(summary));
    const auto all = nlohmann::json{{"equal", 8}, {"of", 8}};
    EXPECT_EQ(json["replay"]["foveae"], all);
    EXPECT_EQ(json["replay"]["pixels"], all);
    EXPECT_TRUE(json["replay"]["first_difference"].is_null());
    for (const std::string what : {"foveae", "pixels"}) {
        const std::string line =
            "hash " + what + " " + json["hash"][what]["hash"].get<std::string>() + " over 8 frames";
        EXPECT_NE(replayed.out.find(line), std::string::npos) << line << '\n' << replayed.out;
    }
    // Another sampling leaves the foveae as they are, and the pictures are no longer comparable.
    const ProgramResult other = run_gazeloop({"replay", session, "--hash", "--sigma", "3"});
    EXPECT_EQ(other.exit_code, 0) << other.err;
    EXPECT_NE(other.out.find("foveae bit-equal in 8 of 8 frames"), std::string::npos);
    EXPECT_NE(other.out.find("settings differ"), std::string::npos) << other.out;
    // Its gaze can be played like a trace.
    const ProgramResult wall =
        run_gazeloop({"replay", session, "--clock", "wall", "--frames", "3", "--set", kSmall});
    EXPECT_EQ(wall.exit_code, 0) << wall.err;
}

// A live tracker's session: its first samples and its losses have no time, the rest have `ready`.
TEST_F(Replay, PlaysALiveTrackersSessionLikeATrace) {
    const std::string session = folder_.file("session.gaze");
    ASSERT_EQ(run_gazeloop({"run", "--gaze", "sim", "--target", "headless", "--frames", "60",
                            "--record", session, "--set", kSmall, "--set", "sim.blinks_per_min=0"})
                  .exit_code,
              0);
    const std::string change =
        "sqlite3 '" + session +
        "' 'UPDATE gaze SET sampled_ns = 0, sampled_kind = 0 WHERE position <= 16;"
        "UPDATE gaze SET sampled_ns = 0, sampled_kind = 0, left_valid = 0, right_valid = 0 "
        "WHERE position BETWEEN 40 AND 60;"
        "UPDATE gaze SET ready_ns = sampled_ns + 1000000 WHERE sampled_kind <> 0' 2>&1";
    ASSERT_EQ(std::system(change.c_str()), 0);
    const auto recorded = session::read_session(session);
    ASSERT_TRUE(recorded.has_value());
    const std::string json = folder_.file("summary.json");
    const std::string again = folder_.file("again.gaze");
    const ProgramResult wall = run_gazeloop(
        {"replay", session, "--clock", "wall", "--set", kSmall, "--json", json, "--record", again});
    ASSERT_EQ(wall.exit_code, 0) << wall.err;
    EXPECT_NE(wall.err.find("gaze source ended"), std::string::npos) << wall.err;
    const auto played = session::read_session(again);
    ASSERT_TRUE(played.has_value());
    ASSERT_EQ(played->samples.size(), recorded->samples.size());
    const std::int64_t shift_ns =
        played->samples[0].sample.arrived.ns - recorded->samples[0].sample.arrived.ns;
    for (std::size_t i = 0; i < played->samples.size(); ++i) {
        const gaze::GazeSample& before = recorded->samples[i].sample;
        const gaze::GazeSample& after = played->samples[i].sample;
        EXPECT_EQ(after.arrived.ns, before.arrived.ns + shift_ns) << i;
        ASSERT_EQ(after.sampled.known(), before.sampled.known()) << i;
        if (after.sampled.known()) {
            EXPECT_EQ(after.sampled.ns, before.sampled.ns + shift_ns) << i;
            EXPECT_EQ(after.ready.ns, before.ready.ns + shift_ns) << i;
        }
    }
    // 21 lost samples of 120 Hz are held and known as such, not left out.
    EXPECT_TRUE(std::ranges::any_of(played->frames, [](const session::RecordedFrame& frame) {
        return frame.frame.fovea.eyes[0].state == gaze::FoveaState::Held;
    }));
    const nlohmann::json rows = nlohmann::json::parse(std::ifstream(json))["durations"];
    EXPECT_EQ(rows["stage_tracker"]["max_ms"], 1.0);
    EXPECT_GE(rows["stage_delivery"]["min_ms"], 0.0);
    EXPECT_LT(rows["stage_delivery"]["max_ms"], rows["gaze_age_at_display"]["max_ms"]);
}

TEST_F(Replay, NoticesWhenTheSessionWasTamperedWith) {
    const std::string session = folder_.file("session.gaze");
    ASSERT_EQ(run_gazeloop({"run", "--gaze", "fixed:3,4", "--target", "headless", "--frames", "3",
                            "--hash", "--record", session, "--set", kSmall})
                  .exit_code,
              0);
    const std::string change =
        "sqlite3 '" + session + "' \"UPDATE fovea SET x_px = x_px + 1e-9 WHERE frame = 1\" 2>&1";
    ASSERT_EQ(std::system(change.c_str()), 0);
    const ProgramResult replayed = run_gazeloop({"replay", session, "--hash"});
    EXPECT_EQ(replayed.exit_code, 1);
    EXPECT_NE(replayed.out.find("first difference in frame 1"), std::string::npos) << replayed.out;
}

TEST_F(Replay, SaysThatVirtualTimeWasVirtual) {
    const std::string session = folder_.file("session.gaze");
    ASSERT_EQ(
        run_gazeloop({"replay", trace(), "--frames", "4", "--record", session, "--set", kSmall})
            .exit_code,
        0);
    for (const char* command : {"replay", "report"}) {
        const ProgramResult again = run_gazeloop({command, session});
        EXPECT_EQ(again.exit_code, 0) << again.err;
        EXPECT_NE(again.out.find("virtual time"), std::string::npos) << again.out;
    }
}

TEST_F(Replay, RefusesADamagedView) {
    const std::string session = folder_.file("session.gaze");
    ASSERT_EQ(
        run_gazeloop({"replay", trace(), "--frames", "4", "--record", session, "--set", kSmall})
            .exit_code,
        0);
    const std::string change =
        "sqlite3 '" + session + "' 'UPDATE view SET width_px = 0 WHERE frame = 2' 2>&1";
    ASSERT_EQ(std::system(change.c_str()), 0);
    const ProgramResult replayed = run_gazeloop({"replay", session});
    EXPECT_EQ(replayed.exit_code, 3) << replayed.err;
    EXPECT_NE(replayed.err.find("frame 2"), std::string::npos) << replayed.err;
}

TEST_F(Replay, NeedsNoProfileThatTheSessionWasRecordedWith) {
    const std::string session = folder_.file("session.gaze");
    const std::string display = folder_.write(
        "mine.toml",
        "width_px = 64\nheight_px = 64\nrefresh_hz = 100\n[fov_deg]\nleft = [-40, 40, 40, -40]\n"
        "right = [-40, 40, 40, -40]\n[optics]\nipd_mm = 63\n[photons]\nswitching_ms = 2\n");
    ASSERT_EQ(run_gazeloop({"replay", trace(), "--frames", "4", "--record", session, "--display",
                            display, "--hash"})
                  .exit_code,
              0);
    std::filesystem::remove(display);
    const std::string summary = folder_.file("summary.json");
    const ProgramResult replayed = run_gazeloop({"replay", session, "--hash", "--json", summary});
    EXPECT_EQ(replayed.exit_code, 0) << replayed.err;
    EXPECT_NE(replayed.out.find("pictures equal in 4 of 4"), std::string::npos) << replayed.out;
}

TEST_F(Replay, NeedsNoKernelTableThatTheSessionWasRecordedWith) {
    const std::string session = folder_.file("session.gaze");
    const std::string table = folder_.write("kernel.csv", "x,y\n0,0\n0.4,0.05\n0.7,0.3\n1,1\n");
    const std::string another = folder_.write("another.csv", "0,0\n0.5,0.4\n1,1\n");
    ASSERT_EQ(
        run_gazeloop({"replay", trace(), "--frames", "4", "--record", session, "--set", kSmall,
                      "--set", "kfr.kernel=table", "--set", "kfr.kernel_table=" + table, "--hash"})
            .exit_code,
        0);
    const auto recorded = value_or_throw(session::read_session(session));
    EXPECT_EQ(recorded.config("kfr.kernel_samples"), "0,0;0.4,0.05;0.7,0.3;1,1");
    // The file may be another by then, or gone.
    std::filesystem::copy_file(another, table, std::filesystem::copy_options::overwrite_existing);
    for (int round = 0; round < 2; ++round) {
        const ProgramResult replayed = run_gazeloop({"replay", session, "--hash"});
        EXPECT_EQ(replayed.exit_code, 0) << replayed.err;
        EXPECT_NE(replayed.out.find("pictures equal in 4 of 4"), std::string::npos) << replayed.out;
        std::filesystem::remove(table);
    }
    // A table that is stated now is another one, and is said to be.
    const ProgramResult other =
        run_gazeloop({"replay", session, "--hash", "--set", "kfr.kernel_table=" + another});
    EXPECT_EQ(other.exit_code, 0) << other.err;
    EXPECT_NE(other.out.find("settings differ"), std::string::npos) << other.out;
    // What print-config says is a configuration again, without the file.
    const ProgramResult config = run_gazeloop({"run", "--print-config", "--set", "kfr.kernel=table",
                                               "--set", "kfr.kernel_table=" + another});
    EXPECT_NE(config.out.find("0,0;0.5,0.4;1,1"), std::string::npos) << config.out;
}

// The map is another, so the pictures are no longer comparable.
TEST_F(Replay, SaysThatAnotherAcuityLineIsAnotherPicture) {
    const std::string session = folder_.file("session.gaze");
    ASSERT_EQ(run_gazeloop({"replay", trace(), "--frames", "4", "--record", session, "--set",
                            kSmall, "--method", "acuity", "--hash"})
                  .exit_code,
              0);
    const ProgramResult same = run_gazeloop({"replay", session, "--hash"});
    EXPECT_NE(same.out.find("pictures equal in 4 of 4"), std::string::npos) << same.out;
    const ProgramResult other = run_gazeloop({"replay", session, "--hash", "--mar", "0.05"});
    EXPECT_EQ(other.exit_code, 0) << other.err;
    EXPECT_NE(other.out.find("settings differ"), std::string::npos) << other.out;
}

// What a setting concerns decides: an output or the machine leaves both comparable, and so does
// what was simulated, and a method that is not in force.
TEST_F(Replay, ComparesWhatTheChangedSettingsLeaveComparable) {
    const std::string session = folder_.file("session.gaze");
    ASSERT_EQ(run_gazeloop({"replay", trace(), "--frames", "4", "--record", session, "--set",
                            kSmall, "--hash"})
                  .exit_code,
              0);
    const auto replayed = [&](const std::vector<std::string>& more) {
        const ProgramResult result = run_gazeloop(with({"replay", session, "--hash"}, more));
        EXPECT_EQ(result.exit_code, 0) << result.err;
        return result.out;
    };
    const std::string all = "pictures equal in 4 of 4 frames";
    for (const char* change :
         {"render.profile=false", "render.frames_in_flight=1", "vulkan.validation=true",
          "sim.noise_deg=3", "profile.display=vive_pro_eye", "render.scale=0.1", "layers.n=2",
          "acuity.mar=0.03"}) {
        const std::string out = replayed({"--set", change});
        EXPECT_NE(out.find("foveae bit-equal in 4 of 4 frames"), std::string::npos) << change;
        EXPECT_NE(out.find(all), std::string::npos) << change << '\n' << out;
    }
    const std::string other_picture = replayed({"--set", "render.spp=2"});
    EXPECT_NE(other_picture.find("foveae bit-equal in 4 of 4"), std::string::npos) << other_picture;
    EXPECT_NE(other_picture.find("pictures not compared: the settings differ"), std::string::npos)
        << other_picture;
    const std::string other_foveae = replayed({"--set", "gaze.fixation_distance_m=2"});
    EXPECT_NE(other_foveae.find("foveae not compared: gaze settings differ"), std::string::npos)
        << other_foveae;
    EXPECT_NE(other_foveae.find("pictures not compared: gaze settings differ"), std::string::npos)
        << other_foveae;
}

TEST_F(Replay, KeepsJsonAlone) {
    const ProgramResult result = run_gazeloop(
        {"replay", trace(), "--frames", "2", "--hash", "--json", "-", "--set", kSmall});
    EXPECT_EQ(result.exit_code, 0) << result.err;
    EXPECT_TRUE(nlohmann::json::accept(result.out)) << result.out;
    EXPECT_NE(result.err.find("hash pixels"), std::string::npos);
}

TEST_F(Replay, RecordsWhatTheReportSays) {
    const std::string session = folder_.file("session.gaze");
    const std::string live_json = folder_.file("live.json");
    const ProgramResult run =
        run_gazeloop({"run", "--gaze", "trace:" + trace(), "--target", "headless", "--seconds", "1",
                      "--record", session, "--json", live_json, "--set", "render.scale=0.02"});
    ASSERT_EQ(run.exit_code, 0) << run.err;
    struct stat file{};
    ASSERT_EQ(stat(session.c_str(), &file), 0);
    EXPECT_EQ(file.st_mode & 0777U, 0600U) << "gaze is personal";
    const ProgramResult report = run_gazeloop({"report", session, "--json", "-"});
    ASSERT_EQ(report.exit_code, 0) << report.err;
    const auto from_session = nlohmann::json::parse(report.out);
    const auto live = nlohmann::json::parse(std::ifstream(live_json));
    // Exact percentiles are those of the session alone; the run's are of a histogram.
    for (const auto& [key, value] : live.items()) {
        if (key == "left_out") {
            EXPECT_TRUE(value.contains("parts"));  // only the run knows its scene
            continue;
        }
        if (key == "prediction") {  // what is compared there are percentiles as well
            const auto& exact = from_session.at(key);
            ASSERT_EQ(exact.size(), value.size());
            const auto worst = nlohmann::json::json_pointer("/eye_to_photon/worst_ms");
            EXPECT_NEAR(exact.at(worst).get<double>(), value.at(worst).get<double>(),
                        0.002 * exact.at(worst).get<double>());
            continue;
        }
        if (key == "why_the_fovea_lags") {  // and what is told of them
            for (const auto& [question, answer] : value.at("answers").items()) {
                EXPECT_EQ(from_session.at(key).at("answers").at(question).at("answer"),
                          answer.at("answer"))
                    << question;
            }
            continue;
        }
        if (key != "durations") {
            EXPECT_EQ(from_session.at(key), value) << key;
            continue;
        }
        ASSERT_EQ(from_session.at(key).size(), value.size());
        for (const auto& [name, row] : value.items()) {
            const auto& exact = from_session.at(key).at(name);
            for (const char* same :
                 {"frames", "kind", "frames_by_kind", "min_ms", "mean_ms", "max_ms"}) {
                EXPECT_EQ(exact.at(same), row.at(same)) << name << " " << same;
            }
            for (const char* near : {"p50_ms", "p95_ms", "p99_ms"}) {
                ASSERT_EQ(exact.at(near).is_null(), row.at(near).is_null()) << name << " " << near;
                if (!row.at(near).is_null()) {
                    const double value_ms = exact.at(near).get<double>();
                    EXPECT_NEAR(row.at(near).get<double>(), value_ms,
                                0.002 * std::abs(value_ms) + 1e-6)
                        << name << " " << near;
                }
            }
        }
    }
    EXPECT_EQ(from_session.at("schema_version"), 1);
    const ProgramResult text = run_gazeloop({"report", session});
    EXPECT_NE(text.out.find("gaze age at display"), std::string::npos) << text.out;
    EXPECT_NE(text.out.find("tracker"), std::string::npos);
}

TEST_F(Replay, KeepsTheRecordingWhenInterrupted) {
    for (const int signal : {SIGINT, SIGTERM}) {
        const std::string session = folder_.file("session" + std::to_string(signal));
        const ProgramResult run =
            run_gazeloop({"run", "--gaze", "trace:" + trace(), "--target", "headless", "--record",
                          session, "--set", kSmall, "--log-level", "debug"},
                         {.timeout = std::chrono::seconds(60),
                          .trigger = "gaze: left eye: tracking",
                          .on_trigger = [signal](int pid) { kill(pid, signal); }});
        EXPECT_EQ(run.exit_code, 130) << run.err;
        const auto read = session::read_session(session);
        ASSERT_TRUE(read.has_value()) << read.error().message;
        EXPECT_TRUE(read->closed_cleanly);
        EXPECT_FALSE(read->frames.empty());
        EXPECT_NE(run.out.find("gaze age at latch"), std::string::npos) << run.out;
    }
}

TEST_F(Replay, KeepsTheRecordingWhenKilled) {
    const std::string session = folder_.file("session.gaze");
    const ProgramResult run =
        run_gazeloop({"run", "--gaze", "trace:" + trace(), "--target", "headless", "--record",
                      session, "--set", kSmall, "--log-level", "debug"},
                     {.timeout = std::chrono::seconds(60),
                      .trigger = "gaze: left eye: held",
                      .on_trigger = [](int pid) { kill(pid, SIGKILL); }});
    EXPECT_EQ(run.exit_code, 128 + SIGKILL) << run.err;
    const auto read = session::read_session(session);
    ASSERT_TRUE(read.has_value()) << read.error().message;
    EXPECT_FALSE(read->closed_cleanly);
    EXPECT_FALSE(read->frames.empty());
    const ProgramResult replayed = run_gazeloop({"replay", session});
    EXPECT_EQ(replayed.exit_code, 0) << replayed.err;
    EXPECT_NE(replayed.err.find("was not closed"), std::string::npos);
    EXPECT_EQ(replayed.err.find("-wal"), std::string::npos) << replayed.err;

    // Copied without its log, it says what is missing, whatever is in the one file.
    const std::string copy = folder_.file("copy.gaze");
    std::filesystem::copy_file(session, copy);
    EXPECT_NE(run_gazeloop({"replay", copy}).err.find("copy copy.gaze-wal from where"),
              std::string::npos);
    const ProgramResult report = run_gazeloop({"report", copy});
    EXPECT_NE(report.out.find("copy copy.gaze-wal from where"), std::string::npos) << report.out;
}

TEST_F(Replay, WritesPicturesOfBothEyes) {
    const std::string pictures = folder_.file("pictures");
    const ProgramResult run = run_gazeloop({"replay", trace(), "--frames", "3", "--set", kSmall,
                                            "--quiet", "--snapshot", pictures, "--mark-fovea"});
    ASSERT_EQ(run.exit_code, 0) << run.err;
    for (const char* eye : {"left", "right"}) {
        for (const char* what : {"full", "result", "lp", "difference"}) {
            const std::string file = pictures + "/" + eye + "-" + what + ".png";
            EXPECT_GT(std::filesystem::file_size(file), 100U) << file;
            EXPECT_NE(run.out.find(file), std::string::npos);
        }
    }
}

TEST_F(Replay, PlaysEveryMethodAndTarget) {
    for (const char* method : {"full", "kfr"}) {
        const ProgramResult run =
            run_gazeloop({"replay", trace(), "--method", method, "--frames", "3", "--set", kSmall,
                          "--spp", "2", "--set", "vulkan.validation=true"});
        EXPECT_EQ(run.exit_code, 0) << run.err;
        EXPECT_EQ(run.err.find("error"), std::string::npos) << run.err;
    }
}

TEST_F(Replay, PlaysARecordingFromAHeadset) {
    const std::string name = "traces/htc_vive_pro/TESTNA01_360VR_Fist3.csv";
    if (const std::string missing = no_recorded_data(name); !missing.empty()) {
        GTEST_SKIP() << missing;
    }
    const std::string recorded = recorded_data(name).string();
    const ProgramResult run =
        run_gazeloop({"replay", recorded, "--frames", "30", "--set", "render.scale=0.02"});
    EXPECT_EQ(run.exit_code, 0) << run.err;
    EXPECT_NE(run.err.find("HTC Vive Pro"), std::string::npos) << run.err;
}

}  // namespace
}  // namespace gazeloop::tests
