#include <fmt/core.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <stdexcept>

#include "tests/bench/bench.h"
#include "tests/bench/measured_program.h"
#include "tests/support/cache_folder.h"
#include "tests/support/run_program.h"

namespace gazeloop::bench {
namespace {

constexpr const char* kBench = "report";
constexpr const char* kCase = "1h";

constexpr const char* kDisplay = R"toml(
description = "tiny, 90 Hz"
assumed = []
width_px = 8
height_px = 8
refresh_hz = 90.0
[fov_deg]
left = [-54.0, 40.0, 42.0, -54.0]
right = [-40.0, 54.0, 42.0, -54.0]
[optics]
ipd_mm = 63.0
)toml";
constexpr const char* kSamples = "4";
constexpr const char* kFramesOfAnHour = "324000";

std::vector<std::string> report_of(const std::string& program, const std::string& session) {
    return {program, "report", session};
}

bool is_read_by(const std::string& session, const std::vector<std::string>& programs) {
    return std::ranges::all_of(programs, [&](const std::string& program) {
        return tests::run_program(report_of(program, session)).exit_code == 0;
    });
}

/// An hour of simulated gaze at 1 kHz, in virtual time.
void record_hour(const std::string& program, const std::filesystem::path& session) {
    const tests::ScratchFolder folder;
    const std::string display = folder.write("tiny.toml", kDisplay);
    const tests::ProgramResult result = tests::run_program(
        {program,    "run",      "--gaze",    "sim",     "--set",    "sim.rate_hz=1000",
         "--target", "headless", "--clock",   "virtual", "--method", "full",
         "--spp",    kSamples,   "--display", display,   "--frames", kFramesOfAnHour,
         "--record", session,    "--quiet"},
        {.timeout = std::chrono::seconds(600)});
    if (result.exit_code != 0) {
        throw std::runtime_error(result.err);
    }
}

/// The session that all of them read: the one that was kept, or a new one by the last of them.
std::string hour_for(const std::vector<std::string>& programs) {
    const auto folder = std::filesystem::path(tests::cache_folder()) / "bench";
    const auto session = folder / "report-1h.gaze";
    if (!std::filesystem::exists(session) || !is_read_by(session, programs)) {
        std::filesystem::create_directories(folder);
        const auto unfinished = folder / "report-1h.new.gaze";
        for (const char* left : {"", "-wal", "-shm"}) {
            std::filesystem::remove(unfinished.string() + left);
        }
        record_hour(programs.back(), unfinished);
        std::filesystem::rename(unfinished, session);
    }
    return session;
}

struct Medians {
    double seconds;
    double bytes;
};

Medians medians(const std::vector<MeasuredProgram>& runs) {
    std::vector<double> seconds;
    std::vector<double> bytes;
    for (const MeasuredProgram& run : runs) {
        seconds.push_back(run.seconds);
        bytes.push_back(static_cast<double>(run.peak_bytes));
    }
    return {median(seconds), median(bytes)};
}

}  // namespace

std::vector<Figure> report(const Options& options) {
    if (!options.wants(kCase)) {
        return {};
    }
    std::vector<std::string> programs{GAZELOOP_BINARY_DIR "/gazeloop"};
    if (options.against) {
        programs.push_back(std::filesystem::absolute(*options.against));
    }
    const std::string session = hour_for(programs);
    std::vector<std::vector<MeasuredProgram>> runs(programs.size());
    for (unsigned round = 0; round < options.rounds; ++round) {
        for (std::size_t i = 0; i < programs.size(); ++i) {
            runs[i].push_back(measure_program(report_of(programs[i], session)));
        }
    }
    const Medians now = medians(runs.front());
    std::vector<Figure> figures{
        {kBench, kCase, "peak memory", now.bytes / (1024.0 * 1024.0), "MiB", "lower"},
        {kBench, kCase, "time", now.seconds, "s", "lower"}};
    if (options.against) {
        const Medians before = medians(runs.back());
        figures.push_back({kBench, kCase, "memory_ratio", now.bytes / before.bytes, "x", "lower",
                           std::nullopt, 0.1});
        figures.push_back({kBench, kCase, "time_ratio", now.seconds / before.seconds, "x", "lower",
                           std::nullopt, 0.5});
    } else {
        fmt::print(stderr, "report: for ratios name a build before: --against FILE\n");
    }
    return figures;
}

}  // namespace gazeloop::bench
