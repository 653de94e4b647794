// `gazeloop probe` as its users run it: a tracker that is blinded at known times, and a video.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <png.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>

#include "drivers/trace/native_trace.h"
#include "runtime/session/playback.h"
#include "sim/gaze_generator.h"
#include "tests/support/camera_video.h"
#include "tests/support/run_program.h"

namespace gazeloop::tests {
namespace {

using nlohmann::json;
using testing::HasSubstr;

struct Blinded {
    double from_s = 0.0;
    double to_s = 0.0;
};

/// A trace of a tracker that loses both eyes at known times, and else never.
void write_blinded_trace(const std::string& file, double seconds,
                         const std::vector<Blinded>& times) {
    sim::GazeSimulation simulation;
    simulation.eye.blinks_per_min = 0.0;
    simulation.tracker.rate_hz = 200.0;
    simulation.tracker.delay_ms = 7.0;
    gaze::GazeTrace trace = sim::generate_gaze(simulation, seconds);
    const std::int64_t begin_ns = trace.samples.front().device_ns;
    for (gaze::GazeSample& sample : trace.samples) {
        const double at_s = static_cast<double>(sample.device_ns - begin_ns) / 1e9;
        for (const Blinded& blinded : times) {
            if (at_s >= blinded.from_s && at_s < blinded.to_s) {
                sample.eyes[0].valid = sample.eyes[1].valid = false;
            }
        }
    }
    ASSERT_TRUE(drivers::write_native_trace(trace, file).has_value());
}

/// The frames of a session, and the first sample of each stretch of invalid or valid ones.
class Recorded final : public frame::FrameObserver {
  public:
    struct Turn {
        bool lost = false;
        gaze::GazeSample sample;
        std::uint64_t frame = 0;
    };

    explicit Recorded(const std::string& session) {
        const std::array<frame::FrameObserver*, 1> observers{this};
        const auto played = session::play(std::filesystem::path(session), observers);
        EXPECT_TRUE(played.has_value()) << played.error().message;
    }
    void on_sample(const gaze::GazeSample& sample, std::uint64_t frame) override {
        const bool valid = sample.eyes[0].valid && sample.eyes[1].valid;
        if (seen_ && valid != valid_) {
            turns_.push_back({!valid, sample, frame});
        }
        seen_ = true;
        valid_ = valid;
    }
    void on_frame(const frame::FrameRecord& record) override { frames_[record.index] = record; }

    [[nodiscard]] const std::vector<Turn>& turns() const { return turns_; }
    [[nodiscard]] const frame::FrameRecord& frame(std::uint64_t index) const {
        return frames_.at(index);
    }

  private:
    std::vector<Turn> turns_;
    std::map<std::uint64_t, frame::FrameRecord> frames_;
    bool seen_ = false;
    bool valid_ = true;
};

std::vector<std::string> words(std::vector<std::string> first,
                               const std::vector<std::string>& more) {
    first.insert(first.end(), more.begin(), more.end());
    return first;
}

json read_json(const std::string& file) {
    std::ifstream in(file);
    return json::parse(in);
}

const std::vector<std::string> kVirtual{
    "--target", "headless",          "--clock", "virtual",
    "--set",    "render.scale=0.05", "--set",   "vulkan.validation=true"};

TEST(ProbeLive, FlipsInTheFrameThatReadTheLossFirst) {
    const ScratchFolder folder;
    const std::string trace = folder.file("blinded.csv");
    // Two blinks and three flashes of the lamp; the tracker is still blind at the end.
    const std::vector<Blinded> times{{0.3, 0.45}, {0.7333, 1.8}, {2.5, 3.3071}, {3.4, 3.402},
                                     {3.6, 3.7},  {3.9, 4.9},    {5.2, 9.0}};
    write_blinded_trace(trace, 5.5, times);
    const std::string session = folder.file("s.gaze");
    const std::string result = folder.file("r.json");
    const ProgramResult run = run_gazeloop(words(
        {"probe", "--gaze", "trace:" + trace, "--record", session, "--json", result}, kVirtual));
    ASSERT_EQ(run.exit_code, 0) << run.err;
    EXPECT_THAT(run.out, HasSubstr("How to measure eye-to-photon"));
    EXPECT_THAT(run.out, HasSubstr("went white 6 times: 3 as long as a lamp, 2 as short as a"))
        << run.out;

    const Recorded recorded(session);
    // One loss is over within a single frame, which cannot show it.
    std::vector<Recorded::Turn> turns;
    for (const Recorded::Turn& turn : recorded.turns()) {
        if (!turns.empty() && turns.back().frame == turn.frame) {
            turns.pop_back();
        } else {
            turns.push_back(turn);
        }
    }
    ASSERT_EQ(recorded.turns().size(), 13U);
    ASSERT_EQ(turns.size(), 11U);
    const json losses = read_json(result).at("losses");
    ASSERT_EQ(losses.size(), 6U);
    for (std::size_t i = 0; i < turns.size(); ++i) {
        const Recorded::Turn& turn = turns[i];
        const json& flip = losses[i / 2][i % 2 == 0 ? "lost" : "found"];
        const frame::FrameRecord& frame = recorded.frame(turn.frame);
        EXPECT_EQ(flip.at("patch"), turn.lost ? "white" : "black");
        EXPECT_EQ(flip.at("frame"), turn.frame);
        EXPECT_EQ(flip.at("sample"), turn.sample.sequence);
        EXPECT_EQ(flip.at("sampled").at("ns"), turn.sample.sampled.ns);
        EXPECT_EQ(flip.at("arrived").at("ns"), turn.sample.arrived.ns);
        EXPECT_EQ(flip.at("latched").at("ns"), frame.stamps.latch.ns);
        EXPECT_EQ(flip.at("display").at("ns"), frame.stamps.display.ns);
        EXPECT_EQ(flip.at("shown").at("ns"), frame.stamps.display.ns);
        // No earlier frame could have known.
        EXPECT_GE(frame.stamps.latch.ns, turn.sample.arrived.ns);
        EXPECT_LT(recorded.frame(turn.frame - 1).stamps.latch.ns, turn.sample.arrived.ns);
    }
    EXPECT_EQ(losses.back().at("found"), nullptr);

    // The patch is no part of what is replayed.
    const ProgramResult replayed = run_gazeloop({"replay", session});
    EXPECT_EQ(replayed.exit_code, 0) << replayed.out << replayed.err;
}

TEST(ProbeLive, EndsAfterItsTrials) {
    const ScratchFolder folder;
    const std::string trace = folder.file("blinded.csv");
    write_blinded_trace(trace, 6.0, {{0.5, 1.5}, {2.0, 3.0}, {4.0, 5.0}});
    const ProgramResult run = run_gazeloop(
        words({"probe", "--gaze", "trace:" + trace, "--trials", "2", "--json", "-"}, kVirtual));
    ASSERT_EQ(run.exit_code, 0) << run.err;
    const json result = json::parse(run.out);
    EXPECT_EQ(result.at("lamp_flashes"), 2);
    EXPECT_EQ(result.at("losses").size(), 2U);
}

TEST(ProbeLive, SaysThatTheEyeWasNeverLost) {
    const ProgramResult run =
        run_gazeloop(words({"probe", "--gaze", "fixed:0,0", "--frames", "5"}, kVirtual));
    EXPECT_EQ(run.exit_code, 0) << run.err;
    EXPECT_THAT(run.out, HasSubstr("The tracker never lost the eye"));
}

struct Rgb {
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    std::vector<std::array<std::uint8_t, 3>> pixels;
};

Rgb read_png(const std::string& file) {
    png_image image{};
    image.version = PNG_IMAGE_VERSION;
    EXPECT_NE(png_image_begin_read_from_file(&image, file.c_str()), 0) << file;
    image.format = PNG_FORMAT_RGB;
    Rgb picture{image.width, image.height, {}};
    picture.pixels.resize(std::size_t{image.width} * image.height);
    EXPECT_NE(png_image_finish_read(&image, nullptr, picture.pixels.data(), 0, nullptr), 0);
    return picture;
}

class ProbePatch : public testing::TestWithParam<const char*> {};

// The same frame with and without the probe: only a square straight ahead differs.
TEST_P(ProbePatch, IsPaintedOverWhateverTheMethodDraws) {
    const std::string method = GetParam();
    const ScratchFolder folder;
    const std::string trace = folder.file("blinded.csv");
    write_blinded_trace(trace, 2.0, {{0.5, 2.0}});
    const auto picture = [&](const std::string& command, const char* frames) {
        const std::string shots = folder.file(command + frames);
        const ProgramResult run = run_gazeloop(
            {command, "--gaze", "trace:" + trace, "--target", "headless", "--clock", "virtual",
             "--method", method, "--set", "render.scale=0.1", "--set", "vulkan.validation=true",
             "--frames", frames, "--snapshot", shots, "--quiet"});
        EXPECT_EQ(run.exit_code, 0) << run.err;
        gaze::PerEye<Rgb> both;
        both[0] = read_png(shots + "/left-" + (method == "full" ? "full" : "result") + ".png");
        both[1] = read_png(shots + "/right-" + (method == "full" ? "full" : "result") + ".png");
        return both;
    };
    for (const auto& [frames, light] : {std::pair{"20", 0}, std::pair{"60", 255}}) {
        const auto plain = picture("run", frames);
        const auto probed = picture("probe", frames);
        for (std::size_t eye = 0; eye < 2; ++eye) {
            const Rgb& a = plain[eye];
            const Rgb& b = probed[eye];
            ASSERT_EQ(a.pixels.size(), b.pixels.size());
            const std::size_t side = std::min(a.width, a.height) / 4;
            std::size_t painted = 0;
            std::size_t other = 0;
            for (std::size_t i = 0; i < a.pixels.size(); ++i) {
                const auto code = static_cast<std::uint8_t>(light);
                const bool is_patch = b.pixels[i] == std::array{code, code, code};
                painted += is_patch && a.pixels[i] != b.pixels[i] ? 1 : 0;
                other += !is_patch && a.pixels[i] != b.pixels[i] ? 1 : 0;
            }
            EXPECT_EQ(other, 0U) << method << frames << eye;
            EXPECT_GT(painted, side * side * 3 / 4) << method << frames << eye;
            EXPECT_LE(painted, (side + 2) * (side + 2)) << method << frames << eye;
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Methods, ProbePatch, testing::Values("full", "kfr", "acuity"));

TEST(ProbeVideo, EntersTheReportAsMeasured) {
    const ScratchFolder folder;
    const LampAndDisplay set_up;
    sim::Random random(11, sim::Stream::Targets);
    const Truth truth = switch_lamp(set_up, 24, random);
    const std::string frames = folder.file("frames");
    std::filesystem::create_directory(frames);
    film(frames, FrameFormat::Colour8, {.fps = 240.0, .noise = 0.01}, set_up, truth, 11);
    const std::string result = folder.file("r.json");
    const ProgramResult measured =
        run_gazeloop({"probe", "--video", frames, "--camera-fps", "240", "--lamp",
                      FrameWriter::kLamp, "--patch", FrameWriter::kPatch, "--json", result});
    ASSERT_EQ(measured.exit_code, 0) << measured.err;
    EXPECT_THAT(measured.out, HasSubstr("eye lost (eye-to-photon)       24"));
    const json read = read_json(result);
    const double mean_ms = read.at("eye_lost").at("mean_ms").get<double>();
    EXPECT_NEAR(mean_ms, truth.mean_ms(true), 500.0 / 240.0);
    EXPECT_NEAR(read.at("eye_found").at("mean_ms").get<double>(), truth.mean_ms(false),
                500.0 / 240.0);
    EXPECT_EQ(read.at("trials").size(), 48U);

    const std::string session = folder.file("s.gaze");
    ASSERT_EQ(run_gazeloop(words({"run", "--gaze", "sim", "--tracker", "vive_pro_eye", "--frames",
                                  "60", "--record", session},
                                 kVirtual))
                  .exit_code,
              0);
    const ProgramResult report = run_gazeloop({"report", session, "--probe", result});
    ASSERT_EQ(report.exit_code, 0) << report.err;
    EXPECT_THAT(report.out, HasSubstr("eye-to-photon measured by lamp and camera"));
    EXPECT_THAT(report.out, HasSubstr(fmt::format("measured    {:.1f} ms", mean_ms)));
    const ProgramResult as_json =
        run_gazeloop({"report", session, "--probe", result, "--json", "-"});
    const json probe = json::parse(as_json.out).at("probe");
    EXPECT_EQ(probe.at("measured").at("mean_ms"), mean_ms);
    EXPECT_NEAR(probe.at("longer_than_modelled_ms").get<double>(),
                mean_ms - probe.at("modelled").at("mean_ms").get<double>(), 1e-9);
    const ProgramResult wrong = run_gazeloop({"report", session, "--probe", session});
    EXPECT_EQ(wrong.exit_code, 3);
    EXPECT_THAT(wrong.err, HasSubstr("is no result of gazeloop probe --video --json"));
}

TEST(ProbeVideo, WhatIsMissingIsSaid) {
    const ScratchFolder folder;
    const ProgramResult none = run_gazeloop({"probe", "--video", folder.file("")});
    EXPECT_EQ(none.exit_code, 2);
    EXPECT_THAT(none.err, HasSubstr("--camera-fps, --lamp and --patch belong to it"));
    const auto asked = [](const std::vector<std::string>& more) {
        std::vector<std::string> words{"probe", "--video", "/nowhere"};
        words.insert(words.end(), more.begin(), more.end());
        return run_gazeloop(words);
    };
    const ProgramResult overlap =
        asked({"--camera-fps", "240", "--lamp", "0,0,8,16", "--patch", "0,0,8,16"});
    EXPECT_EQ(overlap.exit_code, 2) << overlap.err;
    EXPECT_THAT(overlap.err, HasSubstr("--lamp 0,0,8,16 and --patch 0,0,8,16 overlap"));
    const ProgramResult readout = asked({"--camera-fps", "240", "--readout-ms", "100", "--lamp",
                                         "0,0,8,16", "--patch", "8,0,8,16"});
    EXPECT_EQ(readout.exit_code, 2) << readout.err;
    EXPECT_THAT(readout.err, HasSubstr("--readout-ms 100: no camera reads a picture out"));
    const ProgramResult alone = run_gazeloop({"probe", "--camera-fps", "240"});
    EXPECT_EQ(alone.exit_code, 2);
    const ProgramResult help = run_gazeloop({"probe", "--help"});
    EXPECT_EQ(help.exit_code, 0);
    EXPECT_THAT(help.out, HasSubstr("ffmpeg -i VIDEO -fps_mode passthrough FRAMES/%06d.png"));
}

}  // namespace
}  // namespace gazeloop::tests
