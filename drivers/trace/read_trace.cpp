#include "drivers/trace/read_trace.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cerrno>
#include <filesystem>
#include <fstream>
#include <span>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "drivers/trace/axes_correction.h"
#include "drivers/trace/bids/bids_files.h"
#include "drivers/trace/bids/read_bids.h"
#include "drivers/trace/formats/angle_table.h"
#include "drivers/trace/formats/aria.h"
#include "drivers/trace/formats/eyelink_asc.h"
#include "drivers/trace/formats/gazebase_vr.h"
#include "drivers/trace/formats/pico_neo_3.h"
#include "drivers/trace/formats/pupil_core.h"
#include "drivers/trace/formats/pupil_labs.h"
#include "drivers/trace/formats/screen_pixels.h"
#include "drivers/trace/formats/tobii_glasses_3.h"
#include "drivers/trace/formats/tobii_pro_lab.h"
#include "drivers/trace/htc_vive_pro.h"
#include "drivers/trace/native_trace.h"
#include "drivers/trace/text/csv_table.h"
#include "drivers/trace/text/text_lines.h"
#include "drivers/trace/trace_format.h"
#include "runtime/gaze/new_origins.h"

namespace gazeloop::drivers {
namespace {

constexpr std::string_view kAuto = "auto";

/// Those that are tables with a header line.
std::vector<const TraceFormat*> formats() {
    return {&native_trace(),  &htc_vive_pro(), &pico_neo_3(),  &pupil_labs(),    &pupil_core(),
            &tobii_pro_lab(), &aria(),         &gazebase_vr(), &screen_pixels(), &angle_table()};
}

std::string known_names() {
    const std::vector<std::string_view> names = trace_format_names();
    return fmt::format("{}", fmt::join(names, ", "));
}

bool is_known(std::string_view format) {
    const std::vector<std::string_view> names = trace_format_names();
    return format == kAuto || std::ranges::find(names, format) != names.end();
}

/// "'a', 'b' and 12 more"
std::string listed(const std::vector<std::string_view>& names) {
    constexpr std::size_t kMost = 8;
    const std::size_t shown = std::min(names.size(), kMost);
    std::string text;
    for (std::size_t i = 0; i < shown; ++i) {
        text += fmt::format("{}'{}'", i == 0 ? "" : ", ", names[i]);
    }
    if (names.size() > shown) {
        text += fmt::format(" and {} more", names.size() - shown);
    }
    return text;
}

/// What the table lacks of what a format needs: of alternatives, those of the nearest.
struct Lack {
    std::vector<std::string_view> columns;
    std::size_t needed = 0;

    [[nodiscard]] double share() const {
        return static_cast<double>(columns.size()) / static_cast<double>(needed);
    }
};

Lack lacking(const CsvTable& table, const TraceFormat& format) {
    Lack lack;
    for (const std::span<const ColumnNames> alternatives : format.needed) {
        std::vector<std::string_view> least;
        std::size_t needed = 0;
        for (const ColumnNames columns : alternatives) {
            std::vector<std::string_view> missing = table.missing(columns);
            if (needed == 0 || missing.size() < least.size()) {
                least = std::move(missing);
                needed = columns.size();
            }
        }
        lack.needed += needed;
        lack.columns.insert(lack.columns.end(), least.begin(), least.end());
    }
    return lack;
}

Error unknown_header(const CsvTable& table, const std::vector<const TraceFormat*>& candidates) {
    const TraceFormat* const nearest = *std::min_element(
        candidates.begin(), candidates.end(), [&](const TraceFormat* a, const TraceFormat* b) {
            return lacking(table, *a).share() < lacking(table, *b).share();
        });
    std::string message = fmt::format("{}:{}: unknown header; known formats: {}", table.name(),
                                      table.header_line(), known_names());
    const Lack lack = lacking(table, *nearest);
    if (candidates.size() == 1 || lack.share() < 1.0) {
        message += fmt::format("; for {} it lacks {}", nearest->name, listed(lack.columns));
        if (!nearest->remedy.empty()) {
            message += fmt::format(": {}", nearest->remedy);
        }
    }
    if (table.header_line() > 1) {
        message += "; the lines before it are blank, comments or 'sep='";
    }
    return {ErrorKind::BadInput, message};
}

}  // namespace

namespace {

/// What the files of a table's kind hold that are no gaze, or none that is read, by a column that
/// no trace has.
std::string other_table(const CsvTable& table) {
    struct Other {
        std::string_view column;
        std::string_view what;
    };
    for (const Other& other :
         {Other{"optical axis left x",
                "a table of eye states: optical axes are not gaze; read gaze.csv beside it"},
          Other{"quaternion w", "a table of an IMU: read gaze.csv beside it"},
          Other{"blink id", "a table of blinks: read gaze.csv beside it"},
          Other{"fixation id", "a table of fixations: read gaze.csv beside it"},
          Other{"azimuth [rad]",
                "angles in radians: write them in degrees, as 'azimuth [deg]' and "
                "'elevation [deg]'"}}) {
        if (table.has(other.column) && !table.has("gaze x [px]")) {
            return std::string{other.what};
        }
    }
    return {};
}

Expected<BuiltTrace> read_table(TextLines lines, const TraceFile& file,
                                const ReadOptions& options) {
    std::vector<const TraceFormat*> candidates = formats();
    if (options.format != kAuto) {
        std::erase_if(candidates, [&](const TraceFormat* f) { return f->name != options.format; });
    }
    Expected<CsvTable> table = CsvTable::open(std::move(lines));
    if (!table) {
        return std::unexpected(table.error());
    }
    const auto fitting =
        std::find_if(candidates.begin(), candidates.end(),
                     [&](const TraceFormat* f) { return lacking(*table, *f).columns.empty(); });
    if (fitting == candidates.end()) {
        Error error = unknown_header(*table, candidates);
        if (const std::string other = other_table(*table); !other.empty()) {
            error.message = fmt::format("{}:{}: {}", table->name(), table->header_line(), other);
        }
        return std::unexpected(std::move(error));
    }
    return (*fitting)->read(*table, file, options);
}

Expected<BuiltTrace> read_rows(std::istream& in, const std::string& name, const TraceFile& file,
                               const ReadOptions& options) {
    TextLines lines(in, name);
    const Expected<bool> any = lines.next();
    if (!any) {
        return std::unexpected(any.error());
    }
    const bool json_lines = *any && is_json_lines(lines.text());
    const bool asc = *any && is_eyelink_asc(lines.text());
    lines.hold();
    if (options.format == kTobiiGlasses3 || (options.format == kAuto && json_lines)) {
        return read_tobii_glasses_3(std::move(lines), options);
    }
    if (options.format == kEyelinkAsc || (options.format == kAuto && asc)) {
        return read_eyelink_asc(std::move(lines), file, options);
    }
    return read_table(std::move(lines), file, options);
}

/// What a format's reader made of the rows, held against what eyes and heads do.
Expected<gaze::GazeRecording> judged(Expected<BuiltTrace> trace, const ReadOptions& options) {
    if (!trace) {
        return std::unexpected(std::move(trace.error()));
    }
    if (auto held = hold_against_anatomy(*trace, options.axes, options.accept_repairs); !held) {
        return std::unexpected(std::move(held.error()));
    }
    gaze::report_new_origins(*trace->samples, trace->report);
    return gaze::GazeRecording{.file = std::move(trace->file),
                               .format = std::move(trace->format),
                               .device = std::move(trace->device),
                               .samples = std::move(trace->samples),
                               .report = std::move(trace->report)};
}

Expected<gaze::GazeTrace> all_of(Expected<gaze::GazeRecording> recording) {
    if (!recording) {
        return std::unexpected(std::move(recording.error()));
    }
    return gaze::in_memory(std::move(*recording));
}

std::unexpected<Error> unknown_format(const std::string& format) {
    return std::unexpected(Error{
        ErrorKind::Usage,
        fmt::format("unknown trace format '{}'; known: {}, {}", format, kAuto, known_names())});
}

/// A folder of a recording, whose trace is one of the files in it.
std::string trace_in(const TraceFile& folder) {
    for (const std::string_view name :
         {"gaze.csv", "gaze_positions.csv", "gazedata.gz", "general_eye_gaze.csv"}) {
        std::error_code ignored;
        if (std::filesystem::exists(folder / name, ignored)) {
            return fmt::format(": read {} in it", name);
        }
    }
    if (const TraceFile physio = bids_physio_in(folder); !physio.empty()) {
        return fmt::format(": of a BIDS data set name a recording, {}", physio.string());
    }
    return {};
}

}  // namespace

std::vector<std::string_view> trace_format_names() {
    std::vector<std::string_view> names;
    for (const TraceFormat* format : formats()) {
        names.push_back(format->name);
    }
    names.push_back(kTobiiGlasses3);
    names.push_back(kEyelinkAsc);
    names.push_back(kBids);
    return names;
}

Expected<gaze::GazeTrace> read_trace(std::istream& in, const std::string& name,
                                     const ReadOptions& options) {
    if (!is_known(options.format)) {
        return unknown_format(options.format);
    }
    if (options.format == kBids) {
        return std::unexpected(
            Error{ErrorKind::BadInput, fmt::format("{}: bids needs files, not a stream", name)});
    }
    return all_of(judged(read_rows(in, name, {}, options), options));
}

Expected<gaze::GazeRecording> read_recording(const std::string& file, const ReadOptions& options) {
    std::error_code ignored;
    if (std::filesystem::is_directory(file, ignored)) {
        return std::unexpected(
            Error{ErrorKind::BadInput,
                  fmt::format("{}: a directory, not a trace{}", file, trace_in(file))});
    }
    if (!is_known(options.format)) {
        return unknown_format(options.format);
    }
    if (options.format == kBids || (options.format == kAuto && is_bids_physio(file))) {
        return judged(read_bids(file, options), options);
    }
    errno = 0;
    std::ifstream in(file, std::ios::binary);
    if (!in) {
        return std::unexpected(Error{
            ErrorKind::BadInput,
            fmt::format("{}: cannot be opened: {}", file, std::generic_category().message(errno))});
    }
    Expected<gaze::GazeRecording> trace = judged(read_rows(in, file, file, options), options);
    if (trace && trace->format == native_trace().name) {
        Expected<std::string> device = read_native_sidecar(file);
        if (!device) {
            return std::unexpected(device.error());
        }
        if (!device->empty()) {
            trace->device = *device;
        }
    }
    return trace;
}

Expected<gaze::GazeTrace> read_trace(const std::string& file, const ReadOptions& options) {
    return all_of(read_recording(file, options));
}

}  // namespace gazeloop::drivers
