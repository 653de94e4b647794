#include <fmt/core.h>

#include <filesystem>

#include "tests/bench/bench.h"
#include "tests/bench/long_session.h"
#include "tests/bench/measured_program.h"
#include "tests/support/run_program.h"

namespace gazeloop::bench {
namespace {

constexpr const char* kBench = "report";
constexpr const char* kSummary = "1h";
constexpr const char* kAllFormats = "4h";
constexpr double kMiB = 1024.0 * 1024.0;

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

/// The summary of an hour alone, by each program in turns.
void add_summary(const std::vector<std::string>& programs, const Options& options,
                 std::vector<Figure>& figures) {
    const std::string session = session_of_an_hour(programs);
    std::vector<std::vector<MeasuredProgram>> runs(programs.size());
    for (unsigned round = 0; round < options.rounds; ++round) {
        for (std::size_t i = 0; i < programs.size(); ++i) {
            runs[i].push_back(measure_program({programs[i], "report", session}));
        }
    }
    const Medians now = medians(runs.front());
    figures.push_back({kBench, kSummary, "peak memory", now.bytes / kMiB, "MiB", "lower"});
    figures.push_back({kBench, kSummary, "time", now.seconds, "s", "lower"});
    if (programs.size() == 1) {
        fmt::print(stderr, "report: for ratios name a build before: --against FILE\n");
        return;
    }
    const Medians before = medians(runs.back());
    constexpr double kLessMemory = 10.0;
    constexpr double kLessTime = 3.0;
    figures.push_back({kBench, kSummary, "memory_ratio", now.bytes / before.bytes, "x", "lower",
                       std::nullopt, 1.0 / kLessMemory});
    figures.push_back({kBench, kSummary, "time_ratio", now.seconds / before.seconds, "x", "lower",
                       std::nullopt, 1.0 / kLessTime});
}

/// Four hours in all formats, by this program alone: another one may not have them.
void add_all_formats(const std::vector<std::string>& programs, const Options& options,
                     std::vector<Figure>& figures) {
    const std::string session = session_of_four_hours(session_of_an_hour(programs));
    const tests::ScratchFolder folder;
    const auto bytes_of = [](const std::string& file) {
        return static_cast<double>(std::filesystem::file_size(file));
    };
    std::vector<MeasuredProgram> runs;
    for (unsigned round = 0; round < options.rounds; ++round) {
        runs.push_back(
            measure_program({programs.front(), "report", session, "--html", folder.file("r.html"),
                             "--json", folder.file("r.json"), "--csv", folder.file("r.csv")}));
    }
    const Medians now = medians(runs);
    const MeasuredProgram perfetto = measure_program(
        {programs.front(), "report", session, "--perfetto", folder.file("r.pftrace")});
    const auto add = [&](const char* metric, double value, const char* unit,
                         std::optional<double> target = std::nullopt) {
        figures.push_back(
            {kBench, kAllFormats, metric, value, unit, "lower", std::nullopt, target});
    };
    add("time, text HTML JSON CSV", now.seconds, "s", 10.0);
    add("peak memory", now.bytes / kMiB, "MiB", 300.0);
    add("HTML", bytes_of(folder.file("r.html")) * 1e-6, "MB", 5.0);
    add("JSON", bytes_of(folder.file("r.json")) * 1e-6, "MB");
    add("CSV", bytes_of(folder.file("r.csv")) * 1e-6, "MB");
    add("session", bytes_of(session) * 1e-6, "MB");
    add("time, Perfetto", perfetto.seconds, "s");
    add("peak memory, Perfetto", static_cast<double>(perfetto.peak_bytes) / kMiB, "MiB", 300.0);
    add("Perfetto", bytes_of(folder.file("r.pftrace")) * 1e-6, "MB");
}

}  // namespace

std::vector<Figure> report(const Options& options) {
    std::vector<std::string> programs{GAZELOOP_BINARY_DIR "/gazeloop"};
    if (options.against) {
        programs.push_back(std::filesystem::absolute(*options.against));
    }
    std::vector<Figure> figures;
    if (options.wants(kSummary)) {
        add_summary(programs, options, figures);
    }
    if (options.wants(kAllFormats)) {
        add_all_formats(programs, options, figures);
    }
    return figures;
}

}  // namespace gazeloop::bench
