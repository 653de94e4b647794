#include <fmt/format.h>
#include <time.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string>

#include "drivers/trace/native_trace.h"
#include "drivers/trace/read_trace.h"
#include "drivers/trace/text/csv_table.h"
#include "tests/bench/bench.h"
#include "tests/bench/measured_program.h"
#include "tests/support/temporary_folder.h"

namespace gazeloop::bench {
namespace {

constexpr const char* kBench = "traces";

/// CPU time of this thread, so that a busy machine changes little.
double cpu_s() {
    timespec now{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// A trace of 1 kHz with every digit that doubles have, as the program writes it.
std::string made_trace(std::size_t rows) {
    gaze::GazeTrace trace{.device = "bench"};
    for (std::size_t i = 0; i < rows; ++i) {
        gaze::GazeSample& sample = trace.samples.emplace_back();
        const auto t = static_cast<double>(i) * 1e-3;
        sample.sequence = i;
        sample.device_ns = static_cast<std::int64_t>(i) * 1'000'000;
        for (const gaze::Eye eye : gaze::kEyes) {
            gaze::EyeRay& ray = sample.eyes[gaze::index(eye)];
            const double side = eye == gaze::Eye::Left ? -1.0 : 1.0;
            ray.valid = true;
            ray.direction = glm::normalize(
                glm::dvec3{0.2 * std::sin(t) - 0.01 * side, 0.1 * std::cos(1.3 * t), -1.0});
            ray.origin_m = {0.0315 * side, 0.001 * std::sin(t), 0.0};
            ray.openness = 0.9;
            ray.confidence = 1.0;
        }
    }
    std::ostringstream out;
    drivers::write_native_trace(trace, out);
    return out.str();
}

/// What a reader does, up to a stage.
enum class Stage { Lines, Cells, Numbers, Trace };
constexpr std::array<const char*, 4> kStages{"lines", "cells", "numbers", "whole trace"};

double seconds_of(Stage stage, const std::string& text) {
    std::istringstream in(text);
    const double begin_s = cpu_s();
    double check = 0.0;
    if (stage == Stage::Lines) {
        drivers::TextLines lines(in, "bench");
        while (value_or_throw(lines.next())) {
            check += static_cast<double>(lines.text().size());
        }
    } else if (stage == Stage::Trace) {
        check =
            static_cast<double>(value_or_throw(drivers::read_trace(in, "bench")).samples.size());
    } else {
        drivers::CsvTable table = value_or_throw(drivers::CsvTable::open(in, "bench"));
        const std::size_t columns = drivers::native_trace().columns.size() - 1;
        while (value_or_throw(table.next())) {
            for (std::size_t column = 0; stage == Stage::Numbers && column < columns; ++column) {
                check += table.real(column).value_or(0.0);
            }
            check += 1.0;
        }
    }
    const double taken_s = cpu_s() - begin_s;
    if (check == 0.0) {
        throw std::runtime_error("nothing was read");
    }
    return taken_s;
}

/// What converting a trace that does not fit into the memory it is given takes for each row more,
/// bytes.
double bytes_per_row() {
    constexpr std::array<std::size_t, 2> kRows{800'000, 1'600'000};
    std::array<double, kRows.size()> peaks{};
    const tests::TemporaryFolder folder;
    const std::string in = folder / "gaze.csv";
    const std::string out = folder / "converted.csv";
    for (std::size_t i = 0; i < kRows.size(); ++i) {
        std::ofstream(in, std::ios::binary) << made_trace(kRows[i]);
        peaks[i] = static_cast<double>(
            measure_program({GAZELOOP_BINARY_DIR "/gazeloop", "convert", in, out}).peak_bytes);
    }
    return (peaks[1] - peaks[0]) / static_cast<double>(kRows[1] - kRows[0]);
}

}  // namespace

std::vector<Figure> traces(const Options& options) {
    constexpr double kTarget_MB_per_s = 200.0;
    const std::string text = made_trace(100'000);
    const double megabytes = static_cast<double>(text.size()) * 1e-6;
    std::vector<Figure> figures;
    std::array<std::vector<double>, kStages.size()> speeds;
    for (unsigned round = 0; round < options.rounds; ++round) {
        for (std::size_t stage = 0; stage < kStages.size(); ++stage) {
            speeds[stage].push_back(megabytes / seconds_of(static_cast<Stage>(stage), text));
        }
    }
    for (std::size_t stage = 0; stage < kStages.size(); ++stage) {
        const bool whole = static_cast<Stage>(stage) == Stage::Trace;
        figures.push_back({.bench = kBench,
                           .name = fmt::format("csv {:.0f} MB", megabytes),
                           .metric = kStages[stage],
                           .value = median(speeds[stage]),
                           .unit = "MB/s",
                           .bound = whole ? std::optional{median(
                                                speeds[static_cast<std::size_t>(Stage::Numbers)])}
                                          : std::nullopt,
                           .target = whole ? std::optional{kTarget_MB_per_s} : std::nullopt});
    }
    figures.push_back({.bench = kBench,
                       .name = fmt::format("csv {:.0f} MB", megabytes),
                       .metric = "convert, memory per row",
                       .value = bytes_per_row(),
                       .unit = "B",
                       .better = "lower"});
    return figures;
}

}  // namespace gazeloop::bench
