#include "tests/bench/long_session.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <ranges>
#include <stdexcept>
#include <string_view>

#include "tests/support/cache_folder.h"
#include "tests/support/run_program.h"

namespace gazeloop::bench {
namespace {

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
constexpr int kHours = 4;

std::filesystem::path cached(const std::string& name) {
    return std::filesystem::path(tests::cache_folder()) / "bench" / name;
}

/// A name to write to before the file is whole; nothing of an earlier attempt is left.
std::filesystem::path unfinished(const std::string& name) {
    const std::filesystem::path file = cached("unfinished-" + name);
    std::filesystem::create_directories(file.parent_path());
    for (const char* left : {"", "-wal", "-shm"}) {
        std::filesystem::remove(file.string() + left);
    }
    return file;
}

std::string output_of(const std::vector<std::string>& command) {
    const tests::ProgramResult result =
        tests::run_program(command, {.timeout = std::chrono::seconds(600)});
    if (result.exit_code != 0) {
        throw std::runtime_error(fmt::format("{}: {}", command.front(), result.err));
    }
    return result.out;
}

std::string query(const std::filesystem::path& file, const std::string& sql) {
    return output_of({"sqlite3", file, sql});
}

bool is_read_by(const std::string& session, const std::vector<std::string>& programs) {
    return std::ranges::all_of(programs, [&](const std::string& program) {
        return tests::run_program({program, "report", session}).exit_code == 0;
    });
}

void record_hour(const std::string& program, const std::filesystem::path& session) {
    const tests::ScratchFolder folder;
    const std::string display = folder.write("tiny.toml", kDisplay);
    output_of({program,    "run",      "--gaze",    "sim",     "--set",    "sim.rate_hz=1000",
               "--target", "headless", "--clock",   "virtual", "--method", "full",
               "--spp",    kSamples,   "--display", display,   "--frames", kFramesOfAnHour,
               "--record", session,    "--quiet"});
}

/// What of a table's columns grows from one hour to the next, and by what.
struct Growing {
    std::string_view table;
    std::string_view column;
    std::string_view by;  ///< an SQL expression of the first hour
};

constexpr std::string_view kFrames = "(SELECT max(number) + 1 - min(number) FROM frame)";
constexpr std::string_view kLength_ns =
    "(SELECT max(wake_up_ns) - min(wake_up_ns) + max(period_ns) FROM frame)";
constexpr std::string_view kSequences = "(SELECT max(sequence) + 1 - min(sequence) FROM gaze)";
constexpr std::string_view kRows = "(SELECT count(*) FROM gaze)";

constexpr auto kGrowing = std::to_array<Growing>({
    {"gaze", "position", kRows},
    {"gaze", "frame", kFrames},
    {"gaze", "sequence", kSequences},
    {"gaze", "device_ns", kLength_ns},
    {"gaze", "sampled_ns", kLength_ns},
    {"gaze", "arrived_ns", kLength_ns},
    {"gaze", "ready_ns", kLength_ns},
    {"frame", "number", kFrames},
    {"frame", "wake_up_ns", kLength_ns},
    {"frame", "begin_ns", kLength_ns},
    {"frame", "latch_ns", kLength_ns},
    {"frame", "filtered_ns", kLength_ns},
    {"frame", "submit_ns", kLength_ns},
    {"frame", "end_frame_ns", kLength_ns},
    {"frame", "gpu_begin_ns", kLength_ns},
    {"frame", "gpu_end_ns", kLength_ns},
    {"frame", "display_ns", kLength_ns},
    {"frame", "fovea_latched_ns", kLength_ns},
    {"frame", "reported_gpu_begin_ns", kLength_ns},
    {"frame", "reported_gpu_end_ns", kLength_ns},
    {"frame", "scene_time_s", "(SELECT max(scene_time_s) FROM frame)"},
    {"frame", "gaze_received", "(SELECT max(gaze_received) FROM frame)"},
    {"frame", "gaze_invalid", "(SELECT max(gaze_invalid) FROM frame)"},
    {"frame", "gaze_lost", "(SELECT max(gaze_lost) FROM frame)"},
    {"frame", "gaze_out_of_order", "(SELECT max(gaze_out_of_order) FROM frame)"},
    {"view", "frame", kFrames},
    {"fovea", "frame", kFrames},
    {"fovea", "sample_sequence", kSequences},
    {"fovea", "sampled_ns", kLength_ns},
    {"fovea", "arrived_ns", kLength_ns},
    {"fovea", "ready_ns", kLength_ns},
});

/// The statement that appends the hour's rows of a table once more for each further hour.
std::string appended_hours(const std::filesystem::path& hour, std::string_view table) {
    const std::string columns =
        query(hour, fmt::format("SELECT name FROM pragma_table_info('{}')", table));
    std::string sql;
    for (int further = 1; further < kHours; ++further) {
        std::string selected;
        for (const auto& line : columns | std::views::split('\n')) {
            const std::string_view column(line.begin(), line.end());
            if (column.empty()) {
                continue;
            }
            const auto* const growing = std::ranges::find_if(kGrowing, [&](const Growing& one) {
                return one.table == table && one.column == column;
            });
            selected += selected.empty() ? "" : ", ";
            selected += growing == kGrowing.end()
                            ? std::string(column)
                            : fmt::format("{} + {} * {}", column, further,
                                          query(hour, fmt::format("SELECT {}", growing->by)));
        }
        sql += fmt::format("INSERT INTO main.{0} SELECT {1} FROM hour.{0};\n", table, selected);
    }
    return sql;
}

}  // namespace

std::filesystem::path session_of_an_hour(const std::vector<std::string>& programs) {
    const std::filesystem::path session = cached("report-1h.gaze");
    if (!std::filesystem::exists(session) || !is_read_by(session, programs)) {
        const std::filesystem::path made = unfinished("report-1h.gaze");
        record_hour(programs.back(), made);
        std::filesystem::rename(made, session);
    }
    return session;
}

std::filesystem::path session_of_four_hours(const std::filesystem::path& hour) {
    const std::filesystem::path session = cached("report-4h.gaze");
    if (std::filesystem::exists(session) &&
        std::filesystem::last_write_time(session) >= std::filesystem::last_write_time(hour)) {
        return session;
    }
    const std::filesystem::path made = unfinished("report-4h.gaze");
    std::filesystem::copy_file(hour, made);
    std::string sql = fmt::format("ATTACH '{}' AS hour; BEGIN;\n", hour.string());
    for (const std::string_view table : {"gaze", "frame", "view", "fovea"}) {
        sql += appended_hours(hour, table);
    }
    // The file is thrown away where this does not end well.
    query(made, "PRAGMA journal_mode = OFF; PRAGMA synchronous = OFF;\n" + sql + "COMMIT;");
    std::filesystem::rename(made, session);
    return session;
}

}  // namespace gazeloop::bench
